#include "physics/intestine/ball_tree.h"

namespace omentum::physics {

using geometry::Vec3;

BallTree::BallTree(std::int32_t parts) {
  auto size = static_cast<std::size_t>(parts);
  levels_.emplace_back(size);
  while (size > kGroup) {
    size = (size + kGroup - 1) / kGroup;
    levels_.emplace_back(size);
  }
}

void BallTree::place(const GutParts& parts, std::span<const Vec3> x,
                     std::span<const double> around_m) noexcept {
  for (std::int32_t part = 0; part < parts.count(); ++part) {
    const auto p = static_cast<std::size_t>(part);
    const Ball ball = parts.ball_around(part, x);
    levels_[0][p] = {ball.centre, ball.radius_m + around_m[p]};
  }
  for (std::size_t level = 1; level < levels_.size(); ++level) {
    for (std::size_t i = 0; i < levels_[level].size(); ++i) {
      const std::size_t begin = i * kGroup, end = std::min(begin + kGroup, levels_[level - 1].size());
      const std::span<const Node> group = std::span(levels_[level - 1]).subspan(begin, end - begin);
      Vec3 low = group[0].centre, high = low;
      for (const Node& node : group) {
        low = low.cwiseMin(node.centre);
        high = high.cwiseMax(node.centre);
      }
      Node& around = levels_[level][i];
      around = {(low + high) / 2, 0};
      for (const Node& node : group)
        around.radius_m = std::max(around.radius_m, (node.centre - around.centre).norm() + node.radius_m);
    }
  }
}

}  // namespace omentum::physics
