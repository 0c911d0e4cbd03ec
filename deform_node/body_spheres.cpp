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
               std::span<const double> mass) {
  double yield = 0;  // of the centre to an impulse, 1/kg
  for (std::size_t c = 0; c < 4; ++c) {
    // what is precomputed has no mass, and yields to nobody but its own tools
    const double kg = mass[static_cast<std::size_t>(nodes[c])];
    if (kg == 0) return std::numeric_limits<double>::infinity();
    const double weight = weights[static_cast<Eigen::Index>(c)];
    yield += weight * weight / kg;
  }
  return 1 / yield;
}

struct Tie {
  geometry::Tetrahedron nodes;
  Eigen::Vector4d weights;
};

// To the tetrahedron around it; or, since nodes inside a precomputed part are not known, to the face above.
Tie tie_of(const CoverSphere& sphere, const geometry::TetraMesh& mesh, const geometry::Surface& surface,
           const physics::Inertia& inertia) {
  const geometry::Tetrahedron& around = mesh.tetrahedra[sphere.tetrahedron];
  if (std::ranges::all_of(around, [&](NodeId n) { return inertia.mass[n] > 0; }))
    return {around, sphere.weights};
  const geometry::Triangle& above = surface.triangles[sphere.below];
  const auto node = [&](std::size_t i) { return surface.node[above[i]]; };
  return {{node(0), node(1), node(2), node(0)}, {sphere.place[0], sphere.place[1], sphere.place[2], 0}};
}

}  // namespace

BodySpheres::BodySpheres(const geometry::TetraMesh& mesh, const physics::Inertia& inertia) {
  const geometry::Surface surface = geometry::extract_surface(mesh, {});
  const geometry::SphereCover cover = cover_with_spheres(mesh, surface);
  for (const CoverSphere& sphere : cover.spheres) {
    const auto [nodes, weights] = tie_of(sphere, mesh, surface, inertia);
    all_.push_back({.tetrahedron = sphere.tetrahedron,
                    .nodes = nodes,
                    .weights = weights,
                    .rest = sphere.centre,
                    .radius_m = sphere.radius_m,
                    .is_held = std::ranges::any_of(nodes, [&](NodeId n) { return inertia.fixed[n] != 0; }),
                    .mass_kg = std::numeric_limits<double>::infinity()});
  }
  left_.reserve(all_.size());
  shown_.reserve(all_.size());
}

void BodySpheres::part(const geometry::MeshEditor& editor, std::span<const double> mass) noexcept {
  left_.clear();
  for (std::size_t i = 0; i < all_.size(); ++i) {
    Tied& tied = all_[i];
    if (editor.is_removed(tied.tetrahedron)) continue;
    left_.push_back(i);
    if (!tied.is_held) tied.mass_kg = mass_at(tied.nodes, tied.weights, mass);
  }
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
