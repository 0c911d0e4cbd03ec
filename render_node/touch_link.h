// Which parts of the organs touch, as deform_node tells those who ask.
#pragma once

#include "runtime/clock.h"
#include "runtime/faults.h"
#include "runtime/mailbox.h"
#include "transport/bus.h"
#include "transport/messages.h"

#include <memory>
#include <vector>

namespace omentum::render {

/// The pairs of one moment, as TouchingPairs has them, and when they came (the link's clock).
struct TouchesHeard {
  std::uint64_t seq = 0;
  std::uint32_t touching = 0;  // with those that found no room in the message
  std::int64_t arrived_ns = 0;
  std::vector<msg::TouchingPair> pairs;
};

/// Whether a block may be drawn: parts of a size, within the room, of organs of the scene.
bool is_plausible(const msg::TouchingPairs& block, std::size_t organ_count);

/// A subscription while somebody looks. Public calls are for the drawing thread, none waits.
class TouchLink {
 public:
  /// All outlive this.
  TouchLink(transport::Bus& bus, std::size_t organ_count, const runtime::Clock& clock,
            runtime::FaultList& faults)
      : bus_(bus), organ_count_(organ_count), clock_(clock), faults_(faults) {}

  /// Whether the topic is read from now on.
  void read(bool on);
  /// The newest moment, if one came since the last call. Of one whose blocks were not all heard before the
  /// next one began: those that were.
  const TouchesHeard* fetch();

 private:
  void take(const msg::TouchingPairs& block);
  void post();

  transport::Bus& bus_;
  std::size_t organ_count_;
  const runtime::Clock& clock_;
  runtime::FaultList& faults_;
  // the callback's: the moment that comes in
  TouchesHeard coming_;
  std::vector<bool> missing_;  // its blocks
  runtime::Mailbox<TouchesHeard> newest_;
  std::unique_ptr<transport::Reader<msg::TouchingPairs>> reader_;  // last: its callback uses what is above
};

}  // namespace omentum::render
