#include "render_node/fold_shade.h"

#include "render_node/surface_shading.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace omentum::render {
namespace {

constexpr float kSight = 4;  // radii: a ball farther away hides less than a sixteenth of the sky

}  // namespace

void FoldShade::set(std::span<const geometry::TubeFrame> sections, std::size_t stride) {
  balls_.clear();
  for (std::size_t j = 0; j < sections.size(); j += stride) {
    const std::size_t next = std::min(j + stride, sections.size() - 1);
    const double length = (sections[next].origin - sections[j].origin).norm();
    const double share = length / (2 * static_cast<double>(radius_m_));
    balls_.push_back({sections[j].origin.cast<float>(), static_cast<float>(std::min(1.0, share))});
  }
  near_.resize(balls_.size());
  near_count_ = 0;
  find_rows();
}

void FoldShade::find_rows() {
  rows_.clear();
  for (std::size_t first = 0; first < balls_.size(); first += kRow) {
    const auto row = std::span(balls_).subspan(first, std::min(kRow, balls_.size() - first));
    Row& around = rows_.emplace_back(Row{row[row.size() / 2].place, 0});
    for (const Ball& ball : row) around.reach = std::max(around.reach, (ball.place - around.centre).norm());
  }
}

void FoldShade::stand_at(const Vec3f& place) {
  const float sight = kSight * radius_m_;
  near_count_ = 0;
  for (std::size_t r = 0; r < rows_.size(); ++r) {
    const float reach = sight + rows_[r].reach;
    if ((rows_[r].centre - place).squaredNorm() > reach * reach) continue;
    const std::size_t end = std::min((r + 1) * kRow, balls_.size());
    // kept or written over by the next one: a jump that nobody foretells costs more than a copy
    for (std::size_t i = r * kRow; i < end; ++i) {
      near_[near_count_] = balls_[i];
      near_count_ += (balls_[i].place - place).squaredNorm() < sight * sight ? 1 : 0;
    }
  }
}

float FoldShade::openness(const Vec3f& place, const Vec3f& normal) const {
  const float squared_radius = radius_m_ * radius_m_;
  float hidden = 0;
  for (const auto& [centre, weight] : near()) {
    const Vec3f to = centre - place;
    const float facing = normal.dot(to), squared = std::max(to.squaredNorm(), squared_radius);
    if (facing > 0) hidden += weight * squared_radius * facing / (squared * std::sqrt(squared));
  }
  return std::max(kDeepestOpenness, std::exp(-hidden));
}

std::array<float, SkinFrame::kDirections> FoldShade::around(const Vec3f& axis, const Vec3f& k,
                                                            const Vec3f& b) const {
  using Directions = Eigen::Array<float, SkinFrame::kDirections, 1>;
  static const Directions angle = Directions::LinSpaced(
      0, 2 * std::numbers::pi_v<float> * (1 - 1.0f / static_cast<float>(SkinFrame::kDirections)));
  static const Directions cosine = angle.cos(), sine = angle.sin();
  const float squared_radius = radius_m_ * radius_m_;
  Directions hidden = Directions::Zero();
  for (const auto& [centre, weight] : near()) {
    const Vec3f to = centre - axis;
    // within the tube's own width no wall faces it: of a straight piece's balls none is looked at
    const float along_k = to.dot(k), along_b = to.dot(b);
    if (along_k * along_k + along_b * along_b <= squared_radius) continue;
    const Directions facing = along_k * cosine + along_b * sine - radius_m_;
    const Directions squared =
        (to.squaredNorm() - squared_radius - 2 * radius_m_ * facing).max(squared_radius);
    hidden += weight * squared_radius * facing.max(0.0f) / (squared * squared.sqrt());
  }
  std::array<float, SkinFrame::kDirections> open;
  Eigen::Map<Directions>(open.data()) = (-hidden).exp().max(kDeepestOpenness);
  return open;
}

}  // namespace omentum::render
