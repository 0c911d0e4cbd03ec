// Parts of the organs that touch, as something to draw: a rod between both and a dot where they meet.
#pragma once

#include "render_node/renderer.h"
#include "transport/messages.h"

#include <array>
#include <optional>
#include <span>

namespace omentum::render {

/// Marks are coloured by how hard the pair is pushed apart, a band for each tenfold: a loop of gut weighs
/// some tenths of a newton, and lies on many places at once. Below kTouchLimits_n[i], N: band i.
inline constexpr std::size_t kTouchBands = 4;
inline constexpr std::array<float, kTouchBands - 1> kTouchLimits_n{0.01f, 0.1f, 1.0f};
std::size_t touch_band(float push_n);
/// Of each band, linear: the harder the lighter and the warmer.
const std::array<Vec3f, kTouchBands>& touch_colours();

/// Where both skins meet: in the middle of what they share, or of the gap, in W.
Vec3f touch_place(const msg::TouchingPair& pair);

/// Drawn over the world, since what touches hides the place. Holds a mesh of the renderer's for each band
/// that was ever of use. One thread, the renderer's.
class TouchMarks {
 public:
  explicit TouchMarks(Renderer& renderer) : renderer_(renderer) {}

  /// From now on these.
  void show(std::span<const msg::TouchingPair> pairs);
  void draw(std::vector<DrawItem>& items) const;

 private:
  struct Band {
    std::optional<MeshId> mesh{};
    bool is_empty = true;
  };
  Renderer& renderer_;
  std::array<Band, kTouchBands> bands_;
};

}  // namespace omentum::render
