// Balls around parts, and around groups of them: what of a gut can be near a segment.
#pragma once

#include "physics/intestine/gut_parts.h"
#include "physics/intestine/pair_kernels.h"

#include <bit>

namespace omentum::physics {

/// Groups of kGroup parts that follow each other, groups of such groups, and so on: parts that follow each
/// other lie beside each other, in any pose. No allocation after construction.
class BallTree {
 public:
  static constexpr std::int32_t kGroup = kernels::kMostBalls;

  explicit BallTree(std::int32_t parts);

  /// Where the parts are now, each with what it may need around it, m.
  void place(const GutParts& parts, std::span<const geometry::Vec3> x,
             std::span<const double> around_m) noexcept;

  /// Calls visit(part, lower) for every part that may be within `around_m` of the segment p -> q, in the
  /// order of parts from `first` on; `lower`: a lower bound of what separates the part, with what it needs
  /// around it, from the segment, m (not above around_m).
  template <class Visit>
  void visit_near(const geometry::Vec3& p, const geometry::Vec3& q, double around_m, std::int32_t first,
                  const Visit& visit) const {
    const geometry::Vec3 along = q - p;
    const double squared = along.squaredNorm();
    const kernels::BallLine line{
        {p.x(), p.y(), p.z()}, {along.x(), along.y(), along.z()}, squared > 0 ? 1 / squared : 0};
    descend(levels_.size() - 1, 0, line, around_m, first, visit);
  }

 private:
  // Balls by components: a group of them is asked for at once.
  struct Level {
    std::vector<double> x, y, z, radius;  // [balls], m
    std::int32_t span = 1;                // parts of each ball
    explicit Level(std::size_t size, std::int32_t parts_each)
        : x(size), y(size), z(size), radius(size), span(parts_each) {}
    std::size_t size() const { return radius.size(); }
    geometry::Vec3 centre(std::size_t ball) const { return {x[ball], y[ball], z[ball]}; }
    void set(std::size_t ball, const geometry::Vec3& centre, double radius_m);
  };
  std::vector<Level> levels_;  // [0]: of the parts; the last one is one group at most

  template <class Visit>
  void descend(std::size_t level, std::size_t begin, const kernels::BallLine& line, double around_m,
               std::int32_t first, const Visit& visit) const {
    const Level& balls = levels_[level];
    const std::size_t count = std::min(balls.size() - begin, std::size_t{kGroup});
    double separation_m[kGroup];
    std::uint32_t near = kernels::find_near_balls(
        count, {&balls.x[begin], &balls.y[begin], &balls.z[begin], &balls.radius[begin]}, line, around_m,
        separation_m);
    for (; near != 0; near &= near - 1) {
      const auto i = static_cast<std::size_t>(std::countr_zero(near));
      const auto ball = static_cast<std::int32_t>(begin + i);
      if ((ball + 1) * balls.span <= first) continue;
      if (level == 0) {
        visit(ball, separation_m[i]);
      } else {
        descend(level - 1, (begin + i) * kGroup, line, around_m, first, visit);
      }
    }
  }
};

}  // namespace omentum::physics
