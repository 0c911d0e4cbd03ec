// A domain with our configuration.
#pragma once

#include "transport/bus.h"
#include "transport/settings.h"

#include <optional>
#include <string>
#include <vector>

namespace omentum::transport::cyclone {

/// Cyclone's configuration (XML) for a profile; peers and interface are used on kLan.
std::string configuration(Profile profile, const std::vector<std::string>& peers,
                          const std::optional<Interface>& interface);

/// Holds a domain with our configuration open. Cyclone has one configuration per domain and process, so that
/// the domain is shared by all participants that the process opens in it and closed with the last. It also
/// has one identity there: what the first secured participant may do, Cyclone 0.10 would let all others do.
class Domain {
 public:
  /// Throws std::runtime_error: Cyclone refused, or the process uses the domain with another profile or as
  /// another role of a key store.
  explicit Domain(const BusOptions& options);
  ~Domain();
  Domain(const Domain&) = delete;
  Domain& operator=(const Domain&) = delete;

 private:
  int id_;
};

}  // namespace omentum::transport::cyclone
