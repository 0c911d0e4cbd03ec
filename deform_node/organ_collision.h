// Where the organs of a scene meet one another.
#pragma once

#include "deform_node/organ_models.h"

#include <Eigen/Geometry>

#include <vector>

namespace omentum::deform {

/// After all organs' steps: gathers what each lets others meet, finds the pairs of spheres of two organs that
/// overlap, and lets both models respond. Between two organs the spheres in the common part of their boxes
/// are tried one by one. One thread; allocates in the constructor only.
class OrganCollision {
 public:
  /// The models outlive this.
  explicit OrganCollision(const std::vector<OrganModel*>& models);

  /// False when some organ met more than there is room for: the rest is left out in this tick.
  [[nodiscard]] bool run() noexcept;

 private:
  struct Body {
    OrganModel* model = nullptr;
    std::span<const CollisionSphere> spheres;
    Eigen::AlignedBox3d box;
    std::vector<OrganContact> contacts;  // of this tick; never beyond its capacity
  };

  bool gather() noexcept;
  bool collide() noexcept;
  static bool collide(Body& one, Body& other) noexcept;
  void respond() noexcept;

  std::vector<Body> bodies_;
};

}  // namespace omentum::deform
