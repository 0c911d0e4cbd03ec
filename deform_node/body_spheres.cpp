#include "deform_node/body_spheres.h"

#include "geometry/surface.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace omentum::deform {

using geometry::CoverSphere;
using geometry::NodeId;
using geometry::Vec3;

namespace {

double mass_at(const geometry::Tetrahedron& nodes, const Eigen::Vector4d& weights,
               const physics::Inertia& inertia) {
  double yield = 0;  // of the centre to an impulse, 1/kg
  for (std::size_t c = 0; c < 4; ++c) {
    // of a precomputed part that nothing but its own tools moves
    if (inertia.fixed[nodes[c]] != 0 || inertia.mass[nodes[c]] == 0)
      return std::numeric_limits<double>::infinity();
    const double weight = weights[static_cast<Eigen::Index>(c)];
    yield += weight * weight / inertia.mass[nodes[c]];
  }
  return 1 / yield;
}

}  // namespace

BodySpheres::BodySpheres(const geometry::TetraMesh& mesh, const physics::Inertia& inertia) {
  const geometry::SphereCover cover = cover_with_spheres(mesh, geometry::extract_surface(mesh, {}));
  for (const CoverSphere& sphere : cover.spheres) {
    const geometry::Tetrahedron& nodes = mesh.tetrahedra[sphere.tetrahedron];
    all_.push_back({.tetrahedron = sphere.tetrahedron,
                    .nodes = nodes,
                    .weights = sphere.weights,
                    .rest = sphere.centre,
                    .radius_m = sphere.radius_m,
                    .mass_kg = mass_at(nodes, sphere.weights, inertia)});
  }
  left_.reserve(all_.size());
  shown_.reserve(all_.size());
}

void BodySpheres::part(const geometry::MeshEditor& editor) noexcept {
  left_.clear();
  for (std::size_t i = 0; i < all_.size(); ++i)
    if (!editor.is_removed(all_[i].tetrahedron)) left_.push_back(i);
}

Vec3 BodySpheres::mean(const Tied& tied, std::span<const double> components) const noexcept {
  Vec3 sum = Vec3::Zero();
  for (std::size_t c = 0; c < 4; ++c)
    sum += tied.weights[static_cast<Eigen::Index>(c)] *
           Eigen::Map<const Vec3>(components.data() + 3 * tied.nodes[c]);
  return sum;
}

std::span<const CollisionSphere> BodySpheres::follow(const physics::BodyState& state,
                                                     std::span<const double> velocities) noexcept {
  shown_.clear();
  for (const std::size_t i : left_) {
    const Tied& tied = all_[i];
    shown_.push_back({.centre = tied.rest + mean(tied, state.u),
                      .velocity = mean(tied, velocities),
                      .radius_m = tied.radius_m,
                      .mass_kg = tied.mass_kg});
  }
  return shown_;
}

void BodySpheres::push(std::span<const OrganContact> contacts, std::span<double> impulses) const noexcept {
  for (const OrganContact& contact : contacts) {
    const auto i = static_cast<std::size_t>(contact.sphere);
    const Tied& tied = all_[left_[i]];
    if (std::isinf(tied.mass_kg)) continue;
    const Vec3 impulse = tied.mass_kg * answer(contact, shown_[i].velocity);
    for (std::size_t c = 0; c < 4; ++c)
      Vec3::Map(&impulses[3 * tied.nodes[c]]) += tied.weights[static_cast<Eigen::Index>(c)] * impulse;
  }
}

}  // namespace omentum::deform
