// Smoke where a hot edge burns tissue.
#pragma once

#include "render_node/renderer.h"

#include <optional>

namespace omentum::render {

/// Puffs that come out at even times while an edge burns, rise, widen, drift and fade. Which way a puff
/// drifts follows from its number alone; who joins late sees the puffs from then on, and after kLife_s the
/// same ones in number and age. One thread.
class Smoke {
 public:
  static constexpr double kPeriod_s = 0.09, kLife_s = 1.5;
  static constexpr float kRise_m_s = 0.035f, kDrift_m_s = 0.008f;
  static constexpr float kFirst_m = 0.0045f, kLast_m = 0.022f;  // radii when it comes out and when it is gone
  static constexpr float kThickest = 0.5f;                      // of what is behind is hidden by a young puff

  /// `dt_s` go by, in which the edges of the tools burn at these places, W, m; none: that one does not.
  void advance(std::span<const std::optional<Vec3f>> burning, double dt_s);
  /// Discs that face the eye, the farthest first: their mesh is a square from -1 to 1 across z.
  void draw(const Vec3f& eye, MeshId square, std::vector<DrawItem>& items) const;
  std::size_t puff_count() const { return puffs_.size(); }

  static MeshData square();

 private:
  struct Puff {
    Vec3f from, drift;  // m, m/s
    double age_s = 0;
  };
  Vec3f place(const Puff& puff) const;

  std::vector<Puff> puffs_;        // at most kLife_s / kPeriod_s of each tool
  std::vector<double> to_next_s_;  // of each tool
  std::uint64_t number_ = 0;
};

}  // namespace omentum::render
