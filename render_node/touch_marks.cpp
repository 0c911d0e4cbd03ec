#include "render_node/touch_marks.h"

#include <Eigen/Geometry>

#include <algorithm>

namespace omentum::render {
namespace {

// Of the thinner part's radius: a dot is seen from afar, and does not hide the next one.
constexpr float kDotRadius = 0.2f, kRodRadius = 0.07f;
// Of the way from the place to both middles: rods of neighbours stay apart in the thick of a loop.
constexpr float kRodShare = 0.6f;

Vec3f one_of(const msg::TouchingPair& pair) {
  return {pair.one_x, pair.one_y, pair.one_z};
}

Vec3f other_of(const msg::TouchingPair& pair) {
  return {pair.other_x, pair.other_y, pair.other_z};
}

// From other to one; of two with one middle any will do.
Vec3f towards_one(const msg::TouchingPair& pair) {
  const Vec3f way = one_of(pair) - other_of(pair);
  const float length = way.norm();
  return length > 0 ? Vec3f(way / length) : Vec3f::UnitZ();
}

// An octahedron about `middle` with these half axes.
void add_octahedron(const Vec3f& middle, const std::array<Vec3f, 3>& axes, MeshData& mesh) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  for (const Vec3f& axis : axes)
    for (const float sign : {1.0f, -1.0f})
      mesh.vertices.push_back(
          {.position = middle + sign * axis, .normal = sign * axis.normalized(), .rest = Vec3f::Zero()});
  for (std::uint32_t octant = 0; octant < 8; ++octant) {
    const std::uint32_t x = octant & 1, y = octant >> 1 & 1, z = octant >> 2;
    const std::uint32_t a = first + x, b = first + 2 + y, c = first + 4 + z;
    // counter-clockwise from outside, whatever was mirrored
    mesh.triangles.push_back((x + y + z) % 2 == 0 ? MeshTriangle{a, b, c} : MeshTriangle{a, c, b});
  }
}

void add_mark(const msg::TouchingPair& pair, MeshData& mesh) {
  const Vec3f n = towards_one(pair), place = touch_place(pair);
  const Vec3f u = n.unitOrthogonal(), v = n.cross(u);
  const float thin = std::min(pair.radius_one, pair.radius_other);
  const float dot = kDotRadius * thin, rod = kRodRadius * thin;
  add_octahedron(place, {dot * n, dot * u, dot * v}, mesh);
  const Vec3f from = place + kRodShare * (other_of(pair) - place),
              to = place + kRodShare * (one_of(pair) - place);
  const float half = std::max(dot, (to - from).norm() / 2);
  add_octahedron((from + to) / 2, {half * n, rod * u, rod * v}, mesh);
}

}  // namespace

std::size_t touch_band(float push_n) {
  return static_cast<std::size_t>(std::ranges::upper_bound(kTouchLimits_n, push_n) - kTouchLimits_n.begin());
}

const std::array<Vec3f, kTouchBands>& touch_colours() {
  static const std::array<Vec3f, kTouchBands> colours{
      {{0.03f, 0.12f, 0.42f}, {0.02f, 0.45f, 0.55f}, {0.25f, 0.75f, 0.15f}, {1.0f, 0.85f, 0.10f}}};
  return colours;
}

Vec3f touch_place(const msg::TouchingPair& pair) {
  const float overlap = pair.radius_one + pair.radius_other - (one_of(pair) - other_of(pair)).norm();
  return other_of(pair) + (pair.radius_other - overlap / 2) * towards_one(pair);
}

void TouchMarks::show(std::span<const msg::TouchingPair> pairs) {
  std::array<MeshData, kTouchBands> meshes;
  for (const msg::TouchingPair& pair : pairs) add_mark(pair, meshes[touch_band(pair.push)]);
  for (std::size_t b = 0; b < kTouchBands; ++b) {
    bands_[b].is_empty = meshes[b].triangles.empty();
    if (bands_[b].is_empty) continue;
    if (bands_[b].mesh) renderer_.replace_mesh(*bands_[b].mesh, meshes[b]);
    if (!bands_[b].mesh) bands_[b].mesh = renderer_.add_mesh(meshes[b]);
  }
}

void TouchMarks::draw(std::vector<DrawItem>& items) const {
  for (std::size_t b = 0; b < kTouchBands; ++b)
    if (!bands_[b].is_empty)
      items.push_back({*bands_[b].mesh, Look::kSignal, Mat4f::Identity(), {touch_colours()[b], 0, 1}});
}

}  // namespace omentum::render
