// What a hand feels, for one that is a mouse: a ring around the tip that tightens, and a bar that fills.
#pragma once

#include "render_node/scene_view.h"

namespace omentum::render {

/// How tight the ring is, 0 to 1, of a force that is this share of the largest one: its root. Fingers feel
/// ratios, and half of what is done to an organ is below a tenth of what a device could exert.
float tightness(double share);

/// From pale over amber to red as the ring tightens; linear.
Vec3f feel_colour(double share);

/// Ring and bar face the viewer and are drawn over the world, as large at any distance: the ring's radius is
/// kWide of half the picture's height without a force, and kTight of that at the limit. The bar, right of
/// the ring, is linear in the force. Holds the meshes that it gave the renderer.
class FeelRing {
 public:
  static constexpr float kWide = 0.085f, kTight = 0.3f;

  explicit FeelRing(Renderer& renderer);

  /// Adds what is felt at the tip of `tool`, if it is seen, to a frame. `limit_n` > 0: of the force.
  void add(const ToolNow& tool, double limit_n, Frame& frame) const;

 private:
  MeshId ring_{}, bar_{};
};

}  // namespace omentum::render
