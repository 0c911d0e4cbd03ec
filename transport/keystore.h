// DDS Security: what a participant shows of itself, from a key store (launch_scripts/make_keystore).
#pragma once

#include "transport/bus.h"

#include <filesystem>
#include <string>

namespace omentum::transport {

/// Files in PEM, and signed documents (S/MIME), all by absolute path.
struct Credentials {
  // of the whole store
  std::filesystem::path identity_authority, permissions_authority, governance;
  // of one vendor and role
  std::filesystem::path certificate, key, permissions;
};

/// Those of `role`, the name with which a program joins. A key store has them apart for both vendors, whose
/// names let the right one begin (see subject_of in launch_scripts/launcher/keystore.py).
/// Throws std::runtime_error: no key store, no such role in it, a file that cannot be read, or a key that
/// everybody on the machine may read.
Credentials find_credentials(const std::filesystem::path& keystore, Vendor vendor, const std::string& role);

}  // namespace omentum::transport
