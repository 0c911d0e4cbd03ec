#include "transport/keystore.h"

#include <fstream>
#include <stdexcept>

namespace omentum::transport {

namespace fs = std::filesystem;

namespace {

[[noreturn]] void refuse(const fs::path& keystore, const std::string& why) {
  throw std::runtime_error("key store '" + keystore.string() + "': " + why);
}

fs::path readable(const fs::path& keystore, const fs::path& file) {
  std::error_code error;
  if (!fs::is_regular_file(keystore / file, error) || !std::ifstream(keystore / file))
    refuse(keystore,
           file.string() + " is not there, or may not be read; launch_scripts/make_keystore writes it");
  return fs::absolute(keystore / file);
}

}  // namespace

Credentials find_credentials(const fs::path& keystore, Vendor vendor, const std::string& role) {
  std::error_code error;
  if (!fs::is_directory(keystore, error))
    refuse(keystore, "expected a folder that launch_scripts/make_keystore made");
  const fs::path own = fs::path(vendor == Vendor::kFast ? "fast" : "cyclone") / role;
  if (role.empty() || !fs::is_directory(keystore / own, error))
    refuse(keystore, "has no keys of '" + role + "', expected them in " + own.string());
  Credentials found{.identity_authority = readable(keystore, "identity_ca.pem"),
                    .permissions_authority = readable(keystore, "permissions_ca.pem"),
                    .governance = readable(keystore, "governance.p7s"),
                    .certificate = readable(keystore, own / "cert.pem"),
                    .key = readable(keystore, own / "key.pem"),
                    .permissions = readable(keystore, own / "permissions.p7s")};
  if ((fs::status(found.key).permissions() & fs::perms::others_all) != fs::perms::none)
    refuse(keystore, (own / "key.pem").string() + " is open to every user of this machine: chmod 600 it");
  return found;
}

}  // namespace omentum::transport
