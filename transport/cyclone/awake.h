// Cyclone's receiving threads, while they shall end.
#pragma once

#include <thread>

namespace omentum::transport::cyclone {

/// As long as it lives, whoever waits for multicast of the domain hears a datagram of one byte often.
/// Cyclone ends a receiving thread by a message that it sends to itself; where its interface is down or gone
/// that message goes nowhere, and the end of the domain would wait for ever. These go through lo.
class Awake {
 public:
  explicit Awake(int domain);

 private:
  std::jthread thread_;
};

}  // namespace omentum::transport::cyclone
