#include "render_node/organ_skin.h"

#include "geometry/precondition.h"
#include "render_node/surface_shading.h"

#include <Eigen/Geometry>

namespace omentum::render {
namespace {

constexpr float kHorizon_m = 0.018f;  // the width of a dent that a tool presses into soft tissue

}  // namespace

OrganSkin::OrganSkin(const geometry::Surface& surface, std::span<const geometry::Vec3> rest)
    : triangles_(surface.triangles),
      normals_(rest.size(), Vec3f::UnitZ()),
      openness_(rest.size(), 1.0f),
      refinement_(triangles_, static_cast<std::int32_t>(rest.size()), refinement_level(triangles_.size())) {
  Eigen::AlignedBox3d box;
  for (const auto& p : rest) {
    rest_.push_back(p.cast<float>());
    box.extend(p);
  }
  extent_m_ = box.isEmpty() ? 0 : box.sizes().maxCoeff();
  positions_ = rest_;

  mesh_.triangles = refinement_.triangles();
  mesh_.vertices.resize(refinement_.vertex_count());
  smooth_normals(triangles_, rest_, normals_);
  rest_normals_ = normals_;
  std::vector<Vec3f> refined_rest(mesh_.vertices.size());
  refinement_.curve(rest_, normals_, refined_rest);
  for (std::size_t i = 0; i < refined_rest.size(); ++i) mesh_.vertices[i].rest = refined_rest[i];
  deform(std::vector<float>(3 * rest_.size(), 0.0f));
}

void OrganSkin::deform(std::span<const float> displacements) {
  geometry::require(displacements.size() == 3 * rest_.size(), "three values for each node");
  float largest_squared = 0;
  for (std::size_t s = 0; s < rest_.size(); ++s) {
    const Vec3f u(displacements[3 * s], displacements[3 * s + 1], displacements[3 * s + 2]);
    positions_[s] = rest_[s] + u;
    largest_squared = std::max(largest_squared, u.squaredNorm());
  }
  largest_displacement_m_ = std::sqrt(largest_squared);
  smooth_normals(triangles_, positions_, normals_);
  openness_of(triangles_, positions_, normals_, kHorizon_m, openness_);
  refinement_.apply(positions_, normals_, openness_, mesh_.vertices);
}

}  // namespace omentum::render
