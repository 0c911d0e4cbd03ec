#include "render_node/sight_line.h"

#include <Eigen/LU>

namespace omentum::render {
namespace {

// Moeller and Trumbore 1997: x = eye + t way = a + u (b - a) + v (c - a), all of 0 < t < 1, u, v >= 0,
// u + v <= 1.
bool crosses(const Vec3f& eye, const Vec3f& way, const Vec3f& a, const Vec3f& b, const Vec3f& c) {
  const Vec3f ab = b - a, ac = c - a, across = way.cross(ac);
  const float volume = ab.dot(across);
  if (volume == 0) return false;
  const Vec3f from_a = eye - a, turned = from_a.cross(ab);
  const float u = from_a.dot(across) / volume, v = way.dot(turned) / volume, t = ac.dot(turned) / volume;
  return u >= 0 && v >= 0 && u + v <= 1 && t > 0 && t < 1;
}

}  // namespace

bool hides(const MeshData& mesh, const Mat4f& W_from_mesh, const geometry::Vec3& eye,
           const geometry::Vec3& target, double margin_m) {
  const geometry::Vec3 whole = target - eye;
  const double length_m = whole.norm();
  if (length_m <= margin_m) return false;
  // in the mesh's own frame, where its corners lie as they are
  const Mat4f mesh_from_W = W_from_mesh.inverse();
  const geometry::Vec3 end = eye + (1 - margin_m / length_m) * whole;
  const Vec3f from = (mesh_from_W * eye.cast<float>().homogeneous()).head<3>();
  const Vec3f way = (mesh_from_W * end.cast<float>().homogeneous()).head<3>() - from;
  for (const auto& [a, b, c] : mesh.triangles) {
    if (crosses(from, way, mesh.vertices[a].position, mesh.vertices[b].position, mesh.vertices[c].position))
      return true;
  }
  return false;
}

}  // namespace omentum::render
