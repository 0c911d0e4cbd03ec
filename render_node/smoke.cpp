#include "render_node/smoke.h"

#include "render_node/chance.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace omentum::render {
namespace {

const Vec3f kGrey{0.80f, 0.81f, 0.83f};

}  // namespace

void Smoke::advance(std::span<const std::optional<Vec3f>> burning, double dt_s) {
  for (Puff& puff : puffs_) puff.age_s += dt_s;
  to_next_s_.resize(burning.size(), 0.0);
  for (std::size_t t = 0; t < burning.size(); ++t) {
    if (!burning[t]) {
      to_next_s_[t] = 0;
      continue;
    }
    double left_s = std::min(dt_s, kLife_s);  // what came out before that is gone
    for (; to_next_s_[t] <= left_s; to_next_s_[t] += kPeriod_s) {
      const float turn = 2 * std::numbers::pi_v<float> * chance(number_, 0);
      const Vec3f aside(std::cos(turn), std::sin(turn), 0);
      puffs_.push_back(
          {*burning[t], kDrift_m_s * (0.4f + chance(number_, 1)) * aside, left_s - to_next_s_[t]});
      number_ = mixed(number_);
    }
    to_next_s_[t] -= left_s;
  }
  std::erase_if(puffs_, [](const Puff& puff) { return puff.age_s >= kLife_s; });
}

Vec3f Smoke::place(const Puff& puff) const {
  const auto age = static_cast<float>(puff.age_s);
  return puff.from + Vec3f(0, 0, kFirst_m + kRise_m_s * age) + age * puff.drift;
}

void Smoke::draw(const Vec3f& eye, MeshId square, std::vector<DrawItem>& items) const {
  const std::size_t first = items.size();
  for (const Puff& puff : puffs_) {
    const auto old = static_cast<float>(puff.age_s / kLife_s);
    const Vec3f middle = place(puff), towards = (eye - middle).normalized();
    const Vec3f right = towards.unitOrthogonal(), up = towards.cross(right);
    const float radius_m = std::lerp(kFirst_m, kLast_m, std::sqrt(old));
    DrawItem& item = items.emplace_back(DrawItem{square, Look::kSmoke, Mat4f::Identity(), {kGrey, 0, 1}});
    item.W_from_mesh.topLeftCorner<3, 3>() << radius_m * right, radius_m * up, towards;
    item.W_from_mesh.topRightCorner<3, 1>() = middle;
    item.material.opacity = kThickest * (1 - old);
  }
  std::sort(items.begin() + static_cast<std::ptrdiff_t>(first), items.end(),
            [&](const DrawItem& a, const DrawItem& b) {
              const auto away = [&](const DrawItem& item) {
                return (item.W_from_mesh.topRightCorner<3, 1>() - eye).squaredNorm();
              };
              return away(a) > away(b);
            });
}

MeshData Smoke::square() {
  MeshData mesh;
  for (const auto& [x, y] : {std::pair{-1.0f, -1.0f}, {1.0f, -1.0f}, {1.0f, 1.0f}, {-1.0f, 1.0f}}) {
    Vertex& vertex = mesh.vertices.emplace_back();
    vertex.position = vertex.rest = {x, y, 0};
    vertex.normal = Vec3f::UnitZ();
  }
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  return mesh;
}

}  // namespace omentum::render
