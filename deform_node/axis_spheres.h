// The spheres of an intestine: what other organs meet of it, and what that does to its masses.
#pragma once

#include "deform_node/organ_contact.h"
#include "geometry/gut_shape.h"

#include <span>
#include <vector>

namespace omentum::deform {

/// Along the axis, about a radius of the tube apart, each with its share of the gut's mass; one between two
/// held masses does not yield. Takes its memory when it is made; one thread.
class AxisSpheres {
 public:
  /// `masses_kg`: [masses].
  AxisSpheres(const geometry::GutShape& shape, std::span<const double> masses_kg);

  std::size_t count() const noexcept { return places_.size(); }
  /// With the masses at `x`, m, going by `v`, m/s, both [masses]; valid until the next call.
  std::span<const CollisionSphere> follow(std::span<const geometry::Vec3> x,
                                          std::span<const geometry::Vec3> v) noexcept;
  /// What they met since follow(), added to the masses' impulses, [masses], N s.
  void push(std::span<const OrganContact> contacts, std::span<geometry::Vec3> impulses) const noexcept;

 private:
  struct Place {
    std::size_t segment = 0;  // of the axis
    double at = 0;            // along it, 0 to 1
  };

  std::vector<Place> places_;           // [spheres]
  std::vector<CollisionSphere> shown_;  // [spheres]
};

}  // namespace omentum::deform
