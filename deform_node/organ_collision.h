// Where the organs of a scene meet one another.
#pragma once

#include "deform_node/organ_models.h"

#include <Eigen/Geometry>

#include <vector>

namespace omentum::deform {

/// After all organs' steps: gathers what each lets others meet, finds the pairs of spheres of two organs that
/// overlap or nearly so, and lets both models respond. Between two organs the spheres in the common part of
/// their boxes are tried one by one; two that do not yield are left alone. The models respond in a few
/// rounds, each to what is lacking after the last one: how much a push moves is the model's secret, and is
/// learnt from what it did. One thread; allocates in the constructor only.
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
    bool yields = false;                 // some part of it
    std::vector<OrganContact> contacts;  // of this tick; never beyond its capacity
    std::vector<double> asked;           // [spheres] of each, the sum of its contacts' shares

    const Vec3& velocity(std::int32_t sphere) const {
      return spheres[static_cast<std::size_t>(sphere)].velocity;
    }
  };

  /// Both organs' sides of one contact, by their places in `contacts`.
  struct Pair {
    Body *one, *other;
    std::size_t at_one, at_other;
    double share_of_one = 0, share_of_other = 0;  // before they are scaled
    double weight_kg = 0;                         // of its speed among those of all pairs
    double push_m_s = 0;                          // of the last round
    double pushed = 0;                            // in this tick, with the scales of the rounds: not below 0
  };

  bool gather() noexcept;
  bool collide() noexcept;
  bool collide(Body& one, Body& other) noexcept;
  void share_out() noexcept;
  void part() noexcept;
  void respond() noexcept;
  void refresh(Pair& pair) noexcept;
  double lacking(const Pair& pair) const noexcept;

  std::vector<Body> bodies_;
  std::vector<Pair> pairs_;  // of this tick; never beyond its capacity
  double scale_ = 1;         // of all shares: how much more than a sphere's own mass a push has to move
  double steepest_ = 1;      // what it may be, by what organs answered since they met
};

}  // namespace omentum::deform
