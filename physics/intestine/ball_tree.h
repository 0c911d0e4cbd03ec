// Balls around parts, and around groups of them: what of a gut can be near a segment.
#pragma once

#include "physics/intestine/gut_parts.h"

namespace omentum::physics {

/// Groups of kGroup parts that follow each other, groups of such groups, and so on: parts that follow each
/// other lie beside each other, in any pose. No allocation after construction.
class BallTree {
 public:
  static constexpr std::int32_t kGroup = 16;

  explicit BallTree(std::int32_t parts);

  /// Where the parts are now, each with what it may need around it, m.
  void place(const GutParts& parts, std::span<const geometry::Vec3> x,
             std::span<const double> around_m) noexcept;

  /// Calls visit(part, lower) for every part that may be within `around_m` of the segment p -> q, in the
  /// order of parts from `first` on; `lower`: a lower bound of what separates the part, with what it needs
  /// around it, from the segment, m (below around_m).
  template <class Visit>
  void visit_near(const geometry::Vec3& p, const geometry::Vec3& q, double around_m, std::int32_t first,
                  const Visit& visit) const {
    const Line line(p, q);
    const auto top = levels_.size() - 1;
    descend(top, 0, static_cast<std::int32_t>(levels_[top].size()), line, around_m, first, visit);
  }

 private:
  struct Node {
    geometry::Vec3 centre;
    double radius_m;
  };
  // A segment, ready to be asked for distances.
  struct Line {
    geometry::Vec3 start, along;
    double per_length;  // 1 / length^2, 0 without length
    Line(const geometry::Vec3& p, const geometry::Vec3& q)
        : start(p), along(q - p), per_length(along.squaredNorm() > 0 ? 1 / along.squaredNorm() : 0) {}
    double squared_distance(const geometry::Vec3& to) const {
      const geometry::Vec3 r = to - start;
      const double t = std::clamp(r.dot(along) * per_length, 0.0, 1.0);
      return (r - t * along).squaredNorm();
    }
  };
  std::vector<std::vector<Node>> levels_;  // [0]: of the parts

  template <class Visit>
  void descend(std::size_t level, std::int32_t begin, std::int32_t end, const Line& line, double around_m,
               std::int32_t first, const Visit& visit) const {
    for (std::int32_t i = begin; i < end; ++i) {
      const Node& node = levels_[level][static_cast<std::size_t>(i)];
      const double far = node.radius_m + around_m, squared = line.squared_distance(node.centre);
      if (squared > far * far) continue;
      if (level == 0) {
        if (i >= first) visit(i, std::sqrt(squared) - node.radius_m);
        continue;
      }
      const auto below = static_cast<std::int32_t>(levels_[level - 1].size());
      descend(level - 1, i * kGroup, std::min((i + 1) * kGroup, below), line, around_m, first, visit);
    }
  }
};

}  // namespace omentum::physics
