#include "transport/settings.h"

#include <arpa/inet.h>
#include <ifaddrs.h>

#include <array>
#include <cstdlib>
#include <fstream>
#include <memory>
#include <sstream>
#include <stdexcept>

namespace omentum::transport {

std::vector<std::string> peers_from_environment() {
  const char* list = std::getenv("OMENTUM_DDS_PEERS");
  return list ? parse_peers(list) : std::vector<std::string>{};
}

std::vector<std::string> parse_peers(const std::string& list) {
  std::vector<std::string> peers;
  std::istringstream words(list);
  for (std::string word; std::getline(words, word, ',');) {
    in_addr address;
    if (inet_pton(AF_INET, word.c_str(), &address) != 1)
      throw std::runtime_error("OMENTUM_DDS_PEERS: found '" + word +
                               "', expected IPv4 addresses separated by commas");
    peers.push_back(word);
  }
  return peers;
}

std::vector<Interface> interfaces_of_this_machine() {
  ifaddrs* first = nullptr;
  if (getifaddrs(&first) != 0) return {};
  const std::unique_ptr<ifaddrs, decltype(&freeifaddrs)> owner(first, freeifaddrs);
  std::vector<Interface> interfaces;
  for (const ifaddrs* one = first; one; one = one->ifa_next) {
    if (!one->ifa_addr || one->ifa_addr->sa_family != AF_INET) continue;
    std::array<char, INET_ADDRSTRLEN> text{};
    const auto* address = reinterpret_cast<const sockaddr_in*>(one->ifa_addr);
    inet_ntop(AF_INET, &address->sin_addr, text.data(), text.size());
    interfaces.push_back({one->ifa_name, text.data()});
  }
  return interfaces;
}

std::optional<Interface> interface_from_environment() {
  const char* wanted = std::getenv("OMENTUM_DDS_INTERFACE");
  return choose_interface(wanted ? wanted : "", interfaces_of_this_machine());
}

std::optional<Interface> choose_interface(const std::string& wanted, const std::vector<Interface>& present) {
  if (wanted.empty()) return std::nullopt;
  std::string known;
  for (const Interface& one : present) {
    if (wanted == one.name || wanted == one.address) return one;
    known += (known.empty() ? "" : ", ") + one.name + " " + one.address;
  }
  throw std::runtime_error("OMENTUM_DDS_INTERFACE: found '" + wanted +
                           "', expected the name or IPv4 address of an interface of this machine: " + known);
}

std::string receive_buffer_warning(long rmem_max_bytes) {
  if (rmem_max_bytes < 0 || rmem_max_bytes >= kSocketBufferBytes) return {};
  return "net.core.rmem_max is " + std::to_string(rmem_max_bytes) +
         " bytes, so large samples (organ states) will be lost; as root: sysctl -w net.core.rmem_max=" +
         std::to_string(kSocketBufferBytes);
}

long kernel_receive_buffer_limit() {
  std::ifstream file("/proc/sys/net/core/rmem_max");
  long bytes = -1;
  return file >> bytes ? bytes : -1;
}

}  // namespace omentum::transport
