#include "transport/fast/membership.h"

#include <exception>
#include <stdexcept>

namespace omentum::transport::fast {

Membership::Membership(const BusOptions& options)
    : options_(options), entities_(std::make_unique<Entities>(options)) {}

void Membership::add(Endpoint& endpoint) {
  const std::lock_guard lock(mutex_);
  if (!entities_) throw std::runtime_error("Fast DDS refused to join the domain again");
  endpoint.join(*entities_);
  endpoints_.push_back(&endpoint);
}

void Membership::remove(Endpoint& endpoint) {
  const std::lock_guard lock(mutex_);
  if (entities_) endpoint.leave(*entities_);
  std::erase(endpoints_, &endpoint);
}

bool Membership::renew() noexcept {
  const std::lock_guard lock(mutex_);
  try {
    if (entities_) {
      for (Endpoint* endpoint : endpoints_) endpoint->leave(*entities_);
      entities_.reset();
    }
    entities_ = std::make_unique<Entities>(options_);
    for (Endpoint* endpoint : endpoints_) endpoint->join(*entities_);
    return true;
  } catch (const std::exception&) {
    return false;
  }
}

}  // namespace omentum::transport::fast
