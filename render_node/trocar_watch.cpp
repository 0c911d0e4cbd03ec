#include "render_node/trocar_watch.h"

#include "geometry/trocar.h"

#include <algorithm>

namespace omentum::render {

Eigen::Quaterniond TrocarWatch::follow(const geometry::Vec3& p_WT, const Eigen::Quaterniond& q_WT) {
  if (!trocar_) return q_WT;
  miss_m_ = geometry::trocar_miss_m(p_WT, q_WT, *trocar_);
  largest_m_ = std::max(miss_m_, largest_m_.value_or(0));
  return geometry::through_trocar(p_WT, q_WT, *trocar_);
}

}  // namespace omentum::render
