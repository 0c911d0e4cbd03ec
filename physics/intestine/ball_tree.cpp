#include "physics/intestine/ball_tree.h"

namespace omentum::physics {

using geometry::Vec3;

BallTree::BallTree(std::int32_t parts) {
  auto size = static_cast<std::size_t>(parts);
  levels_.emplace_back(size, 1);
  while (size > kGroup) {
    size = (size + kGroup - 1) / kGroup;
    levels_.emplace_back(size, levels_.back().span * kGroup);
  }
}

void BallTree::Level::set(std::size_t ball, const Vec3& centre, double radius_m) {
  x[ball] = centre.x();
  y[ball] = centre.y();
  z[ball] = centre.z();
  radius[ball] = radius_m;
}

void BallTree::place(const GutParts& parts, std::span<const Vec3> x,
                     std::span<const double> around_m) noexcept {
  for (std::int32_t part = 0; part < parts.count(); ++part) {
    const auto p = static_cast<std::size_t>(part);
    const Ball ball = parts.ball_around(part, x);
    levels_[0].set(p, ball.centre, ball.radius_m + around_m[p]);
  }
  for (std::size_t level = 1; level < levels_.size(); ++level) {
    const Level& below = levels_[level - 1];
    for (std::size_t i = 0; i < levels_[level].size(); ++i) {
      const std::size_t begin = i * kGroup, end = std::min(begin + kGroup, below.size());
      Vec3 low = below.centre(begin), high = low;
      for (std::size_t k = begin; k < end; ++k) {
        low = low.cwiseMin(below.centre(k));
        high = high.cwiseMax(below.centre(k));
      }
      const Vec3 centre = (low + high) / 2;
      double radius_m = 0;
      for (std::size_t k = begin; k < end; ++k)
        radius_m = std::max(radius_m, (below.centre(k) - centre).norm() + below.radius[k]);
      levels_[level].set(i, centre, radius_m);
    }
  }
}

}  // namespace omentum::physics
