#include "render_node/contact_pressure.h"

#include "geometry/precondition.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>

namespace omentum::render {

namespace {

// At most 96 of a tool: comparing all with all is nothing.
float spread_reach(const Press& press, std::span<const Press> presses) {
  float nearest_m = ContactPressure::kMostReach_m;
  for (const Press& other : presses)
    if (&other != &press) nearest_m = std::min(nearest_m, (other.place - press.place).norm());
  return presses.size() > 1 ? std::max(ContactPressure::kReach_m, nearest_m) : ContactPressure::kReach_m;
}

}  // namespace

Press press_of(const Vec3f& place, const Vec3f& outward, const Vec3f& force_n) {
  return {place, outward, std::max(0.0f, -force_n.dot(outward))};
}

ContactPressure::ContactPressure(const MeshData& mesh)
    : area_m2_(mesh.vertices.size(), 0.0f), pressure_pa_(mesh.vertices.size(), 0.0f) {
  for (const auto& [a, b, c] : mesh.triangles) {
    const Vec3f ab = mesh.vertices[b].rest - mesh.vertices[a].rest;
    const Vec3f ac = mesh.vertices[c].rest - mesh.vertices[a].rest;
    const float third = ab.cross(ac).norm() / 6;
    for (const std::uint32_t v : {a, b, c}) area_m2_[v] += third;
  }
  for (std::size_t v = 0; v < area_m2_.size(); ++v)
    if (area_m2_[v] > 0) all_.push_back(v);
}

std::span<const float> ContactPressure::under(std::span<const Press> presses,
                                              std::span<const Vertex> vertices) {
  geometry::require(vertices.size() == area_m2_.size(), "the mesh's vertices");
  std::ranges::fill(pressure_pa_, 0.0f);
  find_near(presses, vertices);
  for (const Press& press : presses)
    if (press.force_n > 0) spread(press, spread_reach(press, presses), vertices);
  return pressure_pa_;
}

// One pass over the whole surface, however many presses there are.
void ContactPressure::find_near(std::span<const Press> presses, std::span<const Vertex> vertices) {
  near_.clear();
  Eigen::AlignedBox3f box;
  for (const Press& press : presses) box.extend(press.place);
  if (box.isEmpty()) return;
  box.min().array() -= kMostReach_m;
  box.max().array() += kMostReach_m;
  for (const std::size_t v : all_)
    if (box.contains(vertices[v].position)) near_.push_back(v);
}

void ContactPressure::spread(const Press& press, float reach_m, std::span<const Vertex> vertices) {
  const auto squared = [&](std::size_t v) { return (vertices[v].position - press.place).squaredNorm(); };
  float reach_squared = reach_m * reach_m, nearest = std::numeric_limits<float>::infinity();
  for (const std::size_t v : near_)
    if (faces(press, v, vertices)) nearest = std::min(nearest, squared(v));
  const bool coarse = nearest >= reach_squared;
  const std::vector<std::size_t>& among = coarse ? all_ : near_;
  if (coarse) {
    for (const std::size_t v : all_)
      if (faces(press, v, vertices)) nearest = std::min(nearest, squared(v));
    reach_squared = kCoarseReach * kCoarseReach * nearest;
  }
  weight_.assign(among.size(), 0.0f);
  float whole_m2 = 0;
  for (std::size_t i = 0; i < among.size(); ++i) {
    const float away = squared(among[i]);
    if (away >= reach_squared || !faces(press, among[i], vertices)) continue;
    const float inside = 1 - away / reach_squared;
    weight_[i] = inside * inside;
    whole_m2 += weight_[i] * area_m2_[among[i]];
  }
  if (!(whole_m2 > 0)) return;  // no surface faces it
  for (std::size_t i = 0; i < among.size(); ++i)
    pressure_pa_[among[i]] += press.force_n * weight_[i] / whole_m2;
}

}  // namespace omentum::render
