// Recorded hands: CSV files of poses.
#pragma once

#include "device_bridge/device.h"
#include "runtime/sample_log.h"

#include <filesystem>
#include <map>
#include <vector>

namespace omentum::device {

/// One pose of a recorded hand.
struct TracePoint {
  double t_s = 0;
  Vec3 position = Vec3::Zero();         // p_WT, m
  Quat orientation = Quat::Identity();  // q_WT, unit
  double grip = 0;                      // rad
  std::uint32_t buttons = 0;            // bit i: button i is pressed, from here to the next point
};

/// In order of time, at least one point.
using Trace = std::vector<TracePoint>;

/// Reads `t_s,px,py,pz,qw,qx,qy,qz,grip`, with a header line that names the columns (in any order) and
/// optional columns `tool` (else 0; a trace per tool) and `buttons` (else none pressed). Empty lines, lines
/// that begin with # and a byte order mark are passed over. Throws std::runtime_error "FILE:LINE: found ...,
/// expected ..." for a file of another kind (compressed, UTF-16 ...), a wrong header, a field that is no
/// number, times that do not grow, or an orientation whose length is not 1 within 1e-3.
std::map<std::uint32_t, Trace> read_trace(const std::filesystem::path& file);

/// Where the hand is at time `t_s`: on the straight line between two points, turning evenly between their
/// orientations (slerp); at rest at the first point before it and at the last one after it. Velocities are
/// those of this motion. Buttons are pressed from point to point, and by nobody after the last one. The
/// result is valid; when it was measured is for the caller to say.
Measurement trace_at(const Trace& trace, double t_s) noexcept;

/// Writes valid poses as a trace that read_trace reads, with tool and buttons; times count from the first
/// pose. A measurement that was sent again is written once. Where poses begin to be invalid all buttons are
/// let go: what is pressed is pressed until the next point.
class TraceLog : public runtime::SampleLog<msg::ToolPose> {
 public:
  /// Throws std::runtime_error when `file` cannot be written.
  explicit TraceLog(const std::filesystem::path& file);
};

}  // namespace omentum::device
