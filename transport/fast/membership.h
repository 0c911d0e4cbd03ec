// A participant that can be left and joined anew under the endpoints that live on it.
#pragma once

#include "transport/fast/entities.h"

#include <memory>
#include <mutex>
#include <vector>

namespace omentum::transport::fast {

/// A reader or writer as its membership sees it. Calls come one at a time.
class Endpoint {
 public:
  virtual ~Endpoint() = default;
  /// Makes the vendor's part of it. Throws std::runtime_error when that is refused.
  virtual void join(Entities& entities) = 0;
  /// Deletes the vendor's part, if there is one. Waits for a running callback.
  virtual void leave(Entities& entities) = 0;
};

/// One participant after the other, and the endpoints that move from one to the next. Any thread, but not
/// from a reader's callback: leaving waits for those.
class Membership {
 public:
  /// Throws std::runtime_error when Fast DDS refuses.
  explicit Membership(const BusOptions& options);

  Profile profile() const { return options_.profile; }

  /// Joins the endpoint; it must be removed before it ends. Throws what join() throws.
  void add(Endpoint& endpoint);
  void remove(Endpoint& endpoint);

  /// Leaves the domain and joins it as a new participant with the same endpoints, unknown to everyone and
  /// therefore told everything. False when Fast DDS refused: then the endpoints are silent until the next
  /// attempt.
  bool renew() noexcept;

 private:
  BusOptions options_;
  std::mutex mutex_;  // guards the rest, also while endpoints join and leave
  std::unique_ptr<Entities> entities_;
  std::vector<Endpoint*> endpoints_;
};

}  // namespace omentum::transport::fast
