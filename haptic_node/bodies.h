// The bodies that tools can touch, each in a place of its own.
#pragma once

#include "haptic_node/body.h"
#include "runtime/mailbox.h"

#include <memory>
#include <vector>

namespace omentum::haptic {

/// As many places as a session may ever need; some may be empty. No allocation after construction.
class Bodies {
 public:
  explicit Bodies(std::size_t places) : places_(places) {}

  BodyId place_count() const noexcept { return BodyId(places_.size()); }
  Body& operator[](BodyId place) noexcept { return *places_[static_cast<std::size_t>(place)]; }

  /// What stands in a place goes out where something else, or nothing, comes in.
  void exchange(BodyId place, std::unique_ptr<Body>& body) noexcept {
    places_[static_cast<std::size_t>(place)].swap(body);
  }

  /// visit(BodyId, Body&) for every place that is not empty, in order.
  template <class Visit>
  void for_each(Visit&& visit) {
    for (std::size_t i = 0; i < places_.size(); ++i) {
      if (places_[i]) visit(BodyId(i), *places_[i]);
    }
  }

 private:
  std::vector<std::unique_ptr<Body>> places_;
};

/// Through which an ordinary thread hands the loop a body for a place. What stood there goes back the same
/// way, and is freed by who hands over the next but one: neither waits, and the loop neither allocates nor
/// frees. An empty pointer empties the place.
using BodyDoor = runtime::Mailbox<std::unique_ptr<Body>>;

}  // namespace omentum::haptic
