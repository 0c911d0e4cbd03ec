// Somebody on the network without keys, who says in others' names that they leave (CVE-2023-50257).
#pragma once

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <cstdint>
#include <cstring>
#include <set>
#include <stdexcept>
#include <vector>

namespace omentum::test {

/// Hears the announcements on lo's multicast, which are never encrypted, and says goodbyes there (DDSI-RTPS
/// 2.3, 8.5.3.2 and 9.6.3: DATA of the participants' writer with the key alone, disposed and unregistered).
class Outsider {
 public:
  using Prefix = std::array<std::uint8_t, 12>;  // of a participant's GUID

  explicit Outsider(int domain) {
    inet_pton(AF_INET, "239.255.0.1", &group_.sin_addr);
    group_.sin_port = htons(static_cast<std::uint16_t>(7400 + 250 * domain));
    const int on = 1;
    setsockopt(socket_, SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
    ip_mreq membership{group_.sin_addr, {htonl(INADDR_LOOPBACK)}};
    if (bind(socket_, reinterpret_cast<const sockaddr*>(&group_), sizeof group_) != 0 ||
        setsockopt(socket_, IPPROTO_IP, IP_ADD_MEMBERSHIP, &membership, sizeof membership) != 0 ||
        setsockopt(socket_, IPPROTO_IP, IP_MULTICAST_IF, &membership.imr_interface, sizeof(in_addr)) != 0)
      throw std::runtime_error("no multicast on lo");
  }
  ~Outsider() { close(socket_); }
  Outsider(const Outsider&) = delete;
  Outsider& operator=(const Outsider&) = delete;

  /// Who announced himself within the time: twice the period of announcements finds all.
  std::set<Prefix> listen(std::chrono::milliseconds time) const {
    const auto end = std::chrono::steady_clock::now() + time;
    std::set<Prefix> found;
    std::array<std::uint8_t, 65536> message;
    while (std::chrono::steady_clock::now() < end) {
      constexpr int kPatience_ms = 50;
      pollfd waiting{socket_, POLLIN, 0};
      if (poll(&waiting, 1, kPatience_ms) <= 0) continue;
      const auto size = recv(socket_, message.data(), message.size(), 0);
      if (size < kHeaderBytes || std::memcmp(message.data(), "RTPS", 4) != 0) continue;
      Prefix prefix;
      std::memcpy(prefix.data(), message.data() + kPrefixAt, prefix.size());
      found.insert(prefix);
    }
    return found;
  }

  void say_goodbye_of(const Prefix& prefix) {
    const std::vector<std::uint8_t> message = goodbye(prefix);
    sendto(socket_, message.data(), message.size(), 0, reinterpret_cast<const sockaddr*>(&group_),
           sizeof group_);
  }

 private:
  static constexpr int kHeaderBytes = 20, kPrefixAt = 8;

  std::vector<std::uint8_t> goodbye(const Prefix& prefix) {
    std::vector<std::uint8_t> guid(prefix.begin(), prefix.end());
    guid.insert(guid.end(), {0x00, 0x00, 0x01, 0xc1});  // the participant itself
    std::vector<std::uint8_t> message{'R', 'T', 'P', 'S', 2, 1, 1, 15};
    const auto append = [&](std::initializer_list<std::uint8_t> bytes) {
      message.insert(message.end(), bytes);
    };
    const auto append_all = [&](const std::vector<std::uint8_t>& bytes) {
      message.insert(message.end(), bytes.begin(), bytes.end());
    };
    append_all({prefix.begin(), prefix.end()});
    append({0x15, 0x0b, 0, 0});                        // DATA: little endian, inline QoS, a key; to the end
    append({0, 0, 16, 0, 0, 0, 0, 0, 0, 1, 0, 0xc2});  // for any reader, of the participants' writer
    append({0, 0, 0, 0, ++number_, 4, 0, 0});          // its sequence number: beyond those it used
    append({0x70, 0, 16, 0});                          // the key's hash
    append_all(guid);
    append({0x71, 0, 4, 0, 0, 0, 0, 3, 1, 0, 0, 0});  // disposed, unregistered; end of the QoS
    append({0, 3, 0, 0, 0x50, 0, 16, 0});             // parameter list: the GUID
    append_all(guid);
    append({1, 0, 0, 0});
    return message;
  }

  int socket_ = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  sockaddr_in group_{.sin_family = AF_INET, .sin_port = 0, .sin_addr = {}, .sin_zero = {}};
  std::uint8_t number_ = 0;
};

}  // namespace omentum::test
