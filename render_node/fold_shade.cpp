#include "render_node/fold_shade.h"

#include "render_node/surface_shading.h"

#include <algorithm>
#include <cmath>

namespace omentum::render {
namespace {

constexpr float kSight = 4;  // radii: a ball farther away hides less than a sixteenth of the sky

}  // namespace

void FoldShade::set(std::span<const geometry::TubeFrame> sections) {
  balls_.clear();
  for (std::size_t j = 0; j < sections.size(); j += kStride) {
    const std::size_t next = std::min(j + kStride, sections.size() - 1);
    const double length = (sections[next].origin - sections[j].origin).norm();
    const double share = length / (2 * static_cast<double>(radius_m_));
    balls_.push_back({sections[j].origin.cast<float>(), static_cast<float>(std::min(1.0, share))});
  }
}

void FoldShade::stand_at(const Vec3f& place) {
  const float sight = kSight * radius_m_;
  near_.clear();
  std::copy_if(balls_.begin(), balls_.end(), std::back_inserter(near_),
               [&](const Ball& ball) { return (ball.place - place).squaredNorm() < sight * sight; });
}

float FoldShade::openness(const Vec3f& place, const Vec3f& normal) const {
  const float squared_radius = radius_m_ * radius_m_;
  float hidden = 0;
  for (const auto& [centre, weight] : near_) {
    const Vec3f to = centre - place;
    const float facing = normal.dot(to), squared = std::max(to.squaredNorm(), squared_radius);
    if (facing > 0) hidden += weight * squared_radius * facing / (squared * std::sqrt(squared));
  }
  return std::max(kDeepestOpenness, std::exp(-hidden));
}

}  // namespace omentum::render
