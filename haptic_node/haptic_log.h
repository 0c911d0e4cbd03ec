// What each hand did and felt, tick by tick, as lines of a file (haptic_node --log).
#pragma once

#include "runtime/loop_log.h"
#include "transport/messages.h"

#include <array>
#include <cstdint>
#include <filesystem>
#include <vector>

namespace omentum::haptic {

/// One tool in one tick: the newest pose that counts, and the force that left or would have left for it.
struct ToolSample {
  std::uint64_t seq = 0;      // of the pose; 0: none came yet
  std::int64_t stamp_ns = 0;  // of the pose, on the device's clock
  msg::Vec3 position{};       // of the tip, in W, m
  msg::Quat orientation{};
  msg::Vec3 force{};        // on the hand at the tip, in W, N
  msg::Vec3 torque{};       // on the hand about the tip, in W, N m
  std::uint32_t state = 0;  // FORCE_* bits
};

/// A line for each tick: the columns of runtime::LoopLog, then for each tool N of the scene toolN_seq,
/// _stamp_ns, _x_m, _y_m, _z_m, _qw, _qx, _qy, _qz, _fx_n, _fy_n, _fz_n, _tx_nm, _ty_nm, _tz_nm, _state. The
/// loop fills tool() during its tick; the tick's end pushes them. Nothing waits or allocates in it.
class HapticLog : public runtime::LoopObserver {
 public:
  /// `tools`: the scene's, in the order of tool(). Throws std::runtime_error when `file` cannot be written.
  HapticLog(const std::filesystem::path& file, const std::vector<std::uint32_t>& tools);

  /// The loop's thread.
  ToolSample& tool(std::size_t i) noexcept { return draft_.tools[i]; }
  void push(const runtime::LoopSample& sample) noexcept override {
    draft_.tick = sample;
    samples_.push(draft_);
  }
  /// SampleLog::finish.
  void finish() { samples_.finish(); }

 private:
  struct Sample {
    runtime::LoopSample tick;
    std::array<ToolSample, msg::MAX_TOOLS> tools{};
  };
  static constexpr std::uint64_t kWaiting = 1 << 13;  // 8 s at 1 kHz, in 10 MB

  Sample draft_;
  runtime::SampleLog<Sample> samples_;
};

}  // namespace omentum::haptic
