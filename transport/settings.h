// What both vendors need to know of the machine and the user's wishes.
#pragma once

#include "transport/bus.h"

#include <optional>
#include <string>
#include <vector>

namespace omentum::transport {

// Holds a 3 MB OrganState that arrives at once, with room for the other topics.
inline constexpr int kSocketBufferBytes = 4 * 1024 * 1024;

// A participant is forgotten when it was not heard of for its lease. Fast DDS' is longer than Cyclone's: of
// two that lose each other for a while, the Fast one then forgets first or alone, and Cyclone tells it
// everything anew. The other way round they never meet again: a Fast participant that forgot nothing does not
// announce its endpoints twice. 10 s: what stops a process for seconds (a debugger, a busy disk) is outlived.
inline constexpr int kCycloneLease_ms = 2000;
inline constexpr int kFastLease_ms = 10000;
inline constexpr int kAnnouncementPeriod_ms = 500;

/// Largest domain whose ports stay below 65536 with some participants in it (7400 + 250 * domain).
inline constexpr int kMaxDomain = 230;

/// IP addresses from OMENTUM_DDS_PEERS ("ip,ip"); none when unset. Throws std::runtime_error for a word
/// that is no IPv4 address.
std::vector<std::string> peers_from_environment();
std::vector<std::string> parse_peers(const std::string& list);

/// A network interface of this machine, by its IPv4 address; one that has several is listed with each.
struct Interface {
  std::string name;
  std::string address;
};
std::vector<Interface> interfaces_of_this_machine();

/// The interface that OMENTUM_DDS_INTERFACE names, by name or address: profile lan then uses no other; none
/// when unset. Throws std::runtime_error for one that this machine does not have.
std::optional<Interface> interface_from_environment();
std::optional<Interface> choose_interface(const std::string& wanted, const std::vector<Interface>& present);

/// Warns when the kernel's limit of receive buffers (net.core.rmem_max, bytes) is below what large
/// samples need; empty when it is not. A limit below 0 is unknown and not warned of.
std::string receive_buffer_warning(long rmem_max_bytes);
/// net.core.rmem_max in bytes, -1 where it cannot be read.
long kernel_receive_buffer_limit();

}  // namespace omentum::transport
