#include "render_node/scope_shape.h"

#include "render_node/shape_pieces.h"

#include <cmath>
#include <numbers>

namespace omentum::render {
namespace {

constexpr float kLens = 0.50f, kFibresFrom = 0.62f, kFibresTo = 0.86f;  // of the radius
constexpr float kProud_m = 4e-5f;  // before the tube's plane, so that it is not drawn through it

// A ring around z, on a plane across the view axis and `ahead` before the tip along it.
std::vector<Vec3f> oblique_ring(float radius, float optics_rad, float ahead) {
  std::vector<Vec3f> ring;
  for (int a = 0; a < kTurnSegments; ++a) {
    const float angle = 2 * std::numbers::pi_v<float> * static_cast<float>(a) / kTurnSegments;
    const float x = radius * std::cos(angle), y = radius * std::sin(angle);
    ring.emplace_back(x, y, -y * std::tan(optics_rad) - ahead / std::cos(optics_rad));
  }
  return ring;
}

std::vector<MeshTriangle> fan() {
  std::vector<MeshTriangle> triangles;
  for (std::uint32_t a = 1; a + 1 < kTurnSegments; ++a) triangles.push_back({0, a, a + 1});
  return triangles;
}

}  // namespace

MeshData scope_tube_mesh(float radius, float length, float optics_rad) {
  std::vector<Vec3f> end;
  for (const Vec3f& p : oblique_ring(radius, optics_rad, 0)) end.emplace_back(p.x(), p.y(), length);
  return skin_of_rings({oblique_ring(radius, optics_rad, 0), end}, fan(), fan());
}

MeshData scope_lens_mesh(float radius, float optics_rad) {
  return skin_of_rings({oblique_ring(kLens * radius, optics_rad, kProud_m),
                        oblique_ring(kLens * radius, optics_rad, -kProud_m)},
                       fan(), fan());
}

MeshData scope_fibres_mesh(float radius, float optics_rad) {
  return skin_of_rings({oblique_ring(kFibresFrom * radius, optics_rad, -kProud_m),
                        oblique_ring(kFibresFrom * radius, optics_rad, kProud_m),
                        oblique_ring(kFibresTo * radius, optics_rad, kProud_m),
                        oblique_ring(kFibresTo * radius, optics_rad, -kProud_m),
                        oblique_ring(kFibresFrom * radius, optics_rad, -kProud_m)},
                       {}, {});
}

}  // namespace omentum::render
