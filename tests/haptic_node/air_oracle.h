// Whether a tool is in the air: brute force over all triangles, with nothing of DeformedSurface in it.
#pragma once

#include "haptic_node/haptic_model.h"

namespace omentum::haptic_test {

/// The surface under given forces, x = X + sum_k C_:k f_k, and what can be asked of it.
class PlainSurface {
 public:
  explicit PlainSurface(const haptic::ElasticSurface& organ) : organ_(organ), x_(organ.rest) {}

  /// Under the forces of all tools but `without` (-1: of all).
  void deform(std::span<const haptic::NodeForce> forces, std::int32_t without = -1);

  /// Whether every one of the points is outside, and farther than `margin_m` from every triangle. The points
  /// are closer together than twice the margin.
  bool clear_of(std::span<const geometry::Vec3> points, double margin_m) const;
  /// Whether the straight way from a to b meets no triangle.
  bool clear_way(const geometry::Vec3& a, const geometry::Vec3& b) const;

 private:
  bool outside(const geometry::Vec3& p) const;

  const haptic::ElasticSurface& organ_;
  std::vector<geometry::Vec3> x_;
};

/// Follows one tool at one organ and says whether tissue can have anything to do with it.
///
/// A contact drags the surface to its tool: under a force that should not be there the deformed surface is
/// where the tool is, and a tool that it holds would never be in the air. So a tool is in the air when it is
/// clear of the surface that the *others'* forces deform, and either of the one that its own force deforms
/// too, or of the straight way back to where it last was free. In that second case its force has dragged the
/// surface to it: all of it is wrong where a tool only passed an organ, but a tool that hooked a border and
/// carries it along for a while looks like that, too.
class AirOracle {
 public:
  static constexpr double kMargin_m = 5e-3;

  AirOracle(const haptic::ElasticSurface& organ, std::int32_t tool)
      : tool_(tool), with_(organ), without_(organ) {}

  enum class Place { kTissue, kDragged, kAir };
  Place look(const haptic::HapticState& state, bool feels);
  bool in_air(const haptic::HapticState& state, bool feels) { return look(state, feels) != Place::kTissue; }

 private:
  std::int32_t tool_;
  PlainSurface with_, without_;  // its own force
  std::optional<geometry::Vec3> free_;
};

}  // namespace omentum::haptic_test
