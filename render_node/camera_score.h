// The training score of who holds the camera: how well the target is kept centred, level and in sight.
#pragma once

#include "render_node/camera.h"

#include <nlohmann/json_fwd.hpp>

#include <numbers>
#include <optional>

namespace omentum::render {

/// One moment (docs/score.md).
struct CameraMoment {
  double off_centre_rad = 0;       // between the view axis and the way from the lens to the target
  std::optional<double> roll_rad;  // of the picture against W's upright; none where it looks straight up or
                                   // down, and nothing is level
  bool in_sight = false;           // within the lens' round field, and nothing stands in front of it
};

/// What the camera's place and the target's make of it; `hidden`: something stands in front of the target.
CameraMoment camera_moment(const Camera& camera, const Vec3& target, bool hidden);

/// Over a session. Moments count by how long they lasted.
class CameraScore {
 public:
  explicit CameraScore(double within_deg) : within_rad_(within_deg * std::numbers::pi / 180) {}

  /// What was seen from `now_s` on, until the next call, but not longer than kLongest_s: a picture that came
  /// late is no long look. Times must not go back.
  void add(double now_s, const CameraMoment& moment);
  /// Nobody holds the camera, or there is no target: that time does not count.
  void skip(double now_s);
  const std::optional<CameraMoment>& newest() const { return before_; }

  /// {"seconds", "mean_deg", "largest_deg", "within_share", "roll_mean_deg", "roll_largest_deg",
  /// "in_sight_share"}; null but for the seconds where no time counted, the roll's where nothing was level.
  nlohmann::json report() const;

  static constexpr double kLongest_s = 0.25;

 private:
  void count(double now_s);

  double within_rad_;
  double before_s_ = 0;
  std::optional<CameraMoment> before_;
  double seconds_ = 0, off_rad_s_ = 0, within_s_ = 0, in_sight_s_ = 0, rolled_s_ = 0, roll_rad_s_ = 0;
  double largest_off_rad_ = 0, largest_roll_rad_ = 0;
};

}  // namespace omentum::render
