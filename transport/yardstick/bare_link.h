// The vendors' own interfaces with nothing of ours between, to measure Bus against
// (benchmarks/round_trip_bench).
#pragma once

#include "transport/bus.h"

namespace omentum::transport::yardstick {

/// One end of a ping-pong of raw ToolPose structs: two best-effort topics, keep last 1, a listener, the
/// vendor's defaults otherwise, but on lo, where by default neither finds the other vendor. Both vendors'
/// ends understand each other.
class BareLink {
 public:
  enum class End { kPing, kPong };
  using OnSample = std::function<void(const msg::ToolPose&)>;

  /// on_sample runs on the vendor's thread. Throws std::runtime_error.
  static std::unique_ptr<BareLink> open(Vendor vendor, int domain, End end, OnSample on_sample);
  virtual ~BareLink() = default;
  virtual void send(const msg::ToolPose& pose) = 0;
};

std::unique_ptr<BareLink> open_bare_fast(int domain, BareLink::End end, BareLink::OnSample on_sample);
std::unique_ptr<BareLink> open_bare_cyclone(int domain, BareLink::End end, BareLink::OnSample on_sample);

}  // namespace omentum::transport::yardstick
