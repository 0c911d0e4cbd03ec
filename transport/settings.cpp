#include "transport/settings.h"

#include <arpa/inet.h>

#include <cstdlib>
#include <fstream>
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
