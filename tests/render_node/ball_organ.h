// An organ for the tests: a ball of triangles, and dents in it.
#pragma once

#include "geometry/rotation.h"
#include "render_node/scene_view.h"

#include <cmath>
#include <map>

namespace omentum::render::test {

using geometry::SurfaceId;
using geometry::Triangle;

/// An octahedron, each triangle split into four `splits` times, on a sphere of that radius about the origin.
/// Node s is file node s + kFirstFileNode, so that mixed-up numbers show.
inline constexpr std::int32_t kFirstFileNode = 5;
inline OrganShape ball_organ(double radius_m, int splits) {
  OrganShape shape;
  for (const Vec3& p :
       {Vec3(1, 0, 0), Vec3(-1, 0, 0), Vec3(0, 1, 0), Vec3(0, -1, 0), Vec3(0, 0, 1), Vec3(0, 0, -1)}) {
    shape.rest.push_back(radius_m * p);
  }
  const auto id = [](int i) { return SurfaceId(i); };
  std::vector<Triangle> triangles;
  for (const int up : {4, 5}) {
    for (const auto& [a, b] : {std::pair{0, 2}, {2, 1}, {1, 3}, {3, 0}}) {
      triangles.push_back(up == 4 ? Triangle{id(a), id(b), id(up)} : Triangle{id(b), id(a), id(up)});
    }
  }
  for (int s = 0; s < splits; ++s) {
    std::map<std::pair<int, int>, SurfaceId> middles;
    const auto middle = [&](SurfaceId a, SurfaceId b) {
      const auto [place, fresh] = middles.try_emplace(std::minmax<int>(a, b), SurfaceId(shape.rest.size()));
      if (fresh) shape.rest.push_back(radius_m * (shape.rest[a] + shape.rest[b]).normalized());
      return place->second;
    };
    std::vector<Triangle> finer;
    for (const auto& [a, b, c] : triangles) {
      const SurfaceId ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      for (const Triangle& t : {Triangle{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}})
        finer.push_back(t);
    }
    triangles = finer;
  }
  shape.surface.triangles = triangles;
  shape.surface.mobile_count = static_cast<std::int32_t>(shape.rest.size());
  shape.surface_of_file_node.assign(kFirstFileNode, SurfaceId());
  for (std::size_t n = 0; n < shape.rest.size(); ++n) {
    shape.surface.node.push_back(geometry::NodeId(n));
    shape.surface_of_file_node.push_back(SurfaceId(n));
  }
  return shape;
}

/// Pushes inwards at `where`; nothing is left of it a few widths away.
inline std::vector<float> dent(const OrganShape& shape, const Vec3& where, double depth_m, double width_m) {
  std::vector<float> displacements;
  for (const Vec3& p : shape.rest) {
    const double fade = std::exp(-(p - where).squaredNorm() / (width_m * width_m));
    const Vec3 u = -depth_m * fade * where.normalized();
    for (int c = 0; c < 3; ++c) displacements.push_back(static_cast<float>(u[c]));
  }
  return displacements;
}

inline scene::Scene scene_with(std::initializer_list<const char*> shapes) {
  scene::Scene scene;
  scene.name = "a ball";
  for (const char* shape : shapes) {
    scene::ToolSpec& tool = scene.tools.emplace_back();
    tool.id = static_cast<std::uint32_t>(scene.tools.size() - 1);
    tool.name = tool.shape = shape;
  }
  return scene;
}

/// A tool that stands on the ball's point `where`, its shaft pointing away from it.
inline ToolNow tool_at(const Vec3& where, const Vec3& force_n) {
  ToolNow tool;
  tool.seen = true;
  tool.p_WT = where;
  tool.q_WT = geometry::rotation_onto(Vec3::UnitZ(), where);
  tool.force_n = force_n;
  return tool;
}

}  // namespace omentum::render::test
