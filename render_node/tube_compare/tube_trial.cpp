#include "render_node/tube_compare/tube_trial.h"

#include "render_node/tube_cylinder.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace omentum::render::trial {
namespace {

constexpr std::size_t kLeg = 8;  // masses
constexpr std::size_t kAround = TubeCylinder::kAround;
constexpr double kSpacing_m = 2 * kRadius_m;
constexpr double kMostSwing_rad = 0.4 * std::numbers::pi;  // of a leg from the row: folds turn by twice that
constexpr double kLift_m = 0.3 * kRadius_m;  // per mass, of every other leg: legs lie over each other, not in

// The direction from mass i to the next one: -1 or 1, and 0 in the middle of a soft fold.
double side_of(std::size_t i) {
  const std::size_t leg = i / kLeg, at = i % kLeg;
  const double side = leg % 2 == 0 ? 1 : -1;
  const bool soft_end = leg % 2 == 1, soft_begin = leg % 2 == 0 && leg > 0;
  if (soft_end && at == kLeg - 1) return side / 3;
  if (soft_begin && at == 0) return side / 3;
  return side;
}

}  // namespace

std::vector<geometry::Vec3> folding_axis(std::size_t masses, double folded) {
  std::vector<geometry::Vec3> axis{geometry::Vec3::Zero()};
  for (std::size_t i = 1; i < masses; ++i) {
    const double angle = folded * kMostSwing_rad * side_of(i - 1);
    const double lift = folded * kLift_m * ((i - 1) / kLeg % 2 == 0 ? 1 : -1);
    axis.push_back(axis.back() + kSpacing_m * geometry::Vec3(std::cos(angle), std::sin(angle), 0) +
                   geometry::Vec3(0, 0, lift));
  }
  return axis;
}

BruteSweep::BruteSweep(std::size_t masses, std::size_t sections_of_segment)
    : axis_(masses), u_(sections_of_segment * (masses - 1) + 1), frames_(u_.size()) {
  for (std::size_t j = 0; j < u_.size(); ++j)
    u_[j] = std::min(axis_.end(), static_cast<double>(j) / static_cast<double>(sections_of_segment));
  mesh_.vertices.resize(kAround * u_.size());
  const auto vertex = [](std::size_t section, std::size_t a) {
    return static_cast<std::uint32_t>(section * kAround + a % kAround);
  };
  for (std::size_t j = 0; j + 1 < u_.size(); ++j) {
    for (std::size_t a = 0; a < kAround; ++a) {
      mesh_.triangles.push_back({vertex(j, a), vertex(j, a + 1), vertex(j + 1, a + 1)});
      mesh_.triangles.push_back({vertex(j, a), vertex(j + 1, a + 1), vertex(j + 1, a)});
    }
  }
}

void BruteSweep::deform(std::span<const geometry::Vec3> masses) {
  axis_.set(masses);
  geometry::carry_frames(axis_, u_, frames_.front(), frames_);
  for (std::size_t j = 0; j < frames_.size(); ++j) {
    const Vec3f origin = frames_[j].origin.cast<float>();
    const Vec3f k = frames_[j].k.cast<float>(), b = frames_[j].b.cast<float>();
    for (std::size_t a = 0; a < kAround; ++a) {
      const float angle = 2 * std::numbers::pi_v<float> * static_cast<float>(a) / kAround;
      Vertex& vertex = mesh_.vertices[j * kAround + a];
      vertex.normal = std::cos(angle) * k + std::sin(angle) * b;
      vertex.position = origin + static_cast<float>(kRadius_m) * vertex.normal;
      vertex.rest = {static_cast<float>(kSpacing_m * u_[j]), static_cast<float>(kRadius_m) * std::cos(angle),
                     static_cast<float>(kRadius_m) * std::sin(angle)};
    }
  }
}

void BruteSweep::shade(FoldShade shade) {
  for (std::size_t v = 0; v < mesh_.vertices.size(); ++v) {
    Vertex& vertex = mesh_.vertices[v];
    if (v % kAround == 0) shade.stand_at(frames_[v / kAround].origin.cast<float>());
    vertex.openness = shade.openness(vertex.position, vertex.normal);
  }
}

std::size_t turned_inside_out(const MeshData& mesh) {
  constexpr float kNoArea_m2 = 1e-10f;
  const auto is_turned = [&](const MeshTriangle& triangle) {
    const Vec3f& p = mesh.vertices[triangle[0]].position;
    const Vec3f area =
        (mesh.vertices[triangle[1]].position - p).cross(mesh.vertices[triangle[2]].position - p);
    if (!(area.norm() > kNoArea_m2)) return false;
    return std::ranges::any_of(triangle,
                               [&](std::uint32_t v) { return area.dot(mesh.vertices[v].normal) < 0; });
  };
  return static_cast<std::size_t>(std::ranges::count_if(mesh.triangles, is_turned));
}

}  // namespace omentum::render::trial
