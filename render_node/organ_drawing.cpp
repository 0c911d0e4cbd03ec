#include "render_node/organ_drawing.h"

#include <stdexcept>

namespace omentum::render {
namespace {

double area_of(std::span<const geometry::Triangle> triangles, std::span<const geometry::Vec3> p) {
  double area = 0;
  for (const auto& [a, b, c] : triangles) area += 0.5 * (p[b] - p[a]).cross(p[c] - p[a]).norm();
  return area;
}

/// The boundary of a tetrahedral mesh; states are displacements of its nodes.
class SurfaceDrawing final : public OrganDrawing {
 public:
  explicit SurfaceDrawing(const OrganShape& shape)
      : surface_{{shape.surface, shape.rest}, shape.surface_of_file_node},
        outline_{shape.rest, {}, area_of(shape.surface.triangles, shape.rest)},
        material_(shape.material) {
    for (std::int32_t s = 0; s < surface_.skin.node_count(); ++s)
      outline_.normals.push_back(surface_.skin.rest_normal(geometry::SurfaceId(s)));
  }

  RestOutline rest_outline() const override { return outline_; }
  void deform(std::span<const float> values) override { surface_.skin.deform(values); }
  const MeshData& mesh() const override { return surface_.skin.mesh(); }
  Material material() const override { return material_; }
  const PressedSurface* surface() const override { return &surface_; }

 private:
  PressedSurface surface_;
  RestOutline outline_;
  Material material_;
};

}  // namespace

std::unique_ptr<OrganDrawing> make_drawing(const OrganShape& shape) {
  switch (shape.kind) {
    case scene::OrganKind::kTetrahedralMesh:
      return std::make_unique<SurfaceDrawing>(shape);
  }
  throw std::invalid_argument("an organ of a kind that nobody draws");
}

}  // namespace omentum::render
