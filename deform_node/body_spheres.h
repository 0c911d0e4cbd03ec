// The spheres of an organ with masses: what other organs meet of it, and what that does to its nodes.
#pragma once

#include "deform_node/organ_contact.h"
#include "geometry/mesh_editor.h"
#include "geometry/sphere_cover.h"
#include "physics/dynamics/body_state.h"

#include <span>
#include <vector>

namespace omentum::deform {

/// Each sphere of the cover moves with its tetrahedron's nodes, pushes them by their shares, and goes when
/// the tetrahedron does: both sides of a slit keep their own, and a loose piece takes its along. One with a
/// held node does not yield. Takes its memory when it is made; one thread.
class BodySpheres {
 public:
  /// `inertia`: of the uncut body, where nodes without a mass never have one. `mesh` outlives this.
  BodySpheres(const geometry::TetraMesh& mesh, const physics::Inertia& inertia);

  std::size_t most() const noexcept { return all_.size(); }
  /// What is left of the mesh from now on, and what each node carries of it, [N], kg; those of a node that
  /// carries nothing do not yield.
  void part(const geometry::MeshEditor& editor, std::span<const double> mass) noexcept;
  /// Where they are, going by these velocities, [3N]; valid until the next call.
  std::span<const CollisionSphere> follow(const physics::BodyState& state,
                                          std::span<const double> velocities) noexcept;
  /// What they met since follow(), added to the nodes' impulses, [3N], N s.
  void push(std::span<const OrganContact> contacts, std::span<double> impulses) const noexcept;

 private:
  struct Tied {
    geometry::TetId tetrahedron{};
    geometry::Tetrahedron nodes;
    Eigen::Vector4d weights;
    geometry::Vec3 rest;  // its centre, m
    double radius_m;
    bool is_held;    // one of its nodes is
    double mass_kg;  // that its centre has for a push; infinite: it does not yield
  };

  geometry::Vec3 mean(const Tied& tied, std::span<const double> components) const noexcept;

  std::vector<Tied> all_;
  std::vector<std::size_t> left_;       // of all_
  std::vector<CollisionSphere> shown_;  // as left_
};

}  // namespace omentum::deform
