#include "transport/cyclone/awake.h"

#include <arpa/inet.h>
#include <net/if.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <mutex>

namespace omentum::transport::cyclone {

namespace {

// where RTPS receives multicast: announcements of participants at the first port of a domain, data at the
// next
constexpr const char* kGroup = "239.255.0.1";
constexpr int kFirstPort = 7400, kPortsOfADomain = 250;
constexpr char kNothing = 0;  // no message; an empty datagram would be complained of
using Addresses = std::array<sockaddr_in, 2>;
// A domain ends within this in most cases, and then no datagram is sent.
constexpr std::chrono::milliseconds kPause{200};

Addresses multicast_of(int domain) {
  Addresses addresses{};
  int port = kFirstPort + kPortsOfADomain * domain;
  for (sockaddr_in& address : addresses) {
    address.sin_family = AF_INET;
    address.sin_port = htons(static_cast<std::uint16_t>(port++));
    inet_pton(AF_INET, kGroup, &address.sin_addr);
  }
  return addresses;
}

void send_until(const std::stop_token& stop, const Addresses& addresses) {
  const int sender = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  // lo delivers what somebody on it has joined; who bound the port then hears it whatever he joined himself
  const ip_mreqn lo{addresses.front().sin_addr, {}, static_cast<int>(if_nametoindex("lo"))};
  setsockopt(sender, IPPROTO_IP, IP_ADD_MEMBERSHIP, &lo, sizeof lo);
  setsockopt(sender, IPPROTO_IP, IP_MULTICAST_IF, &lo, sizeof lo);
  std::mutex mutex;  // nobody else's: a condition wants one
  std::unique_lock lock(mutex);
  std::condition_variable_any wait;
  while (!wait.wait_for(lock, stop, kPause, [&] { return stop.stop_requested(); }))
    for (const sockaddr_in& to : addresses)
      sendto(sender, &kNothing, sizeof kNothing, MSG_DONTWAIT, reinterpret_cast<const sockaddr*>(&to),
             sizeof to);
  close(sender);
}

}  // namespace

Awake::Awake(int domain)
    : thread_([to = multicast_of(domain)](const std::stop_token& stop) { send_until(stop, to); }) {}

}  // namespace omentum::transport::cyclone
