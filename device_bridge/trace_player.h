// A recorded hand that moves again, whatever it feels.
#pragma once

#include "device_bridge/trace.h"

namespace omentum::device {

/// Plays a trace from its first point at the rate of the loop, then rests at its last one. Pauses at once;
/// restart() goes back to the first point.
class TracePlayer : public Device {
 public:
  TracePlayer(std::uint32_t tool, Trace trace, double rate_hz);

  msg::DeviceInfo info() const override;
  void command(const Wrench& wrench) noexcept override;
  Measurement measure(std::int64_t now_ns) noexcept override;
  void pause(bool paused) noexcept override { paused_ = paused; }
  void restart() noexcept override { played_ = 0; }
  /// {"peak_force_n"}.
  nlohmann::json report() const override;

 private:
  std::uint32_t tool_;
  Trace trace_;
  double period_s_;
  std::uint64_t played_ = 0;  // periods
  bool paused_ = false;
  double peak_force_n_ = 0;
};

}  // namespace omentum::device
