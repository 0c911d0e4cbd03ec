// Where the organs of a scene meet one another.
#pragma once

#include "deform_node/organ_models.h"

#include <Eigen/Geometry>

#include <limits>
#include <vector>

namespace omentum::deform {

/// After all organs' steps: gathers what each lets others meet, finds the pairs of spheres of two organs that
/// overlap or nearly so, and lets both models respond. Between two organs the spheres in the common part of
/// their boxes are tried one by one; two that do not yield are left alone. The models respond in a few
/// rounds, two organs after two, each to what is lacking after the last one: how much a push moves is the
/// models' secret, and is learnt of each two from what it did. One thread; allocates in the constructor only.
class OrganCollision {
 public:
  /// The models outlive this.
  explicit OrganCollision(const std::vector<OrganModel*>& models);
  OrganCollision(const OrganCollision&) = delete;  // its parts refer to each other
  OrganCollision& operator=(const OrganCollision&) = delete;

  /// False when some organ met more than there is room for: the rest is left out in this tick.
  [[nodiscard]] bool run() noexcept;
  /// An organ, by its place among the models, was put elsewhere: whom it met is forgotten.
  void reset(std::size_t organ) noexcept;

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

  /// Two spheres.
  struct Pair {
    double share_of_one = 0, share_of_other = 0;  // before they are scaled
    double weight_kg = 0;                         // of its speed among those of all pairs
    double push_m_s = 0;                          // of the last round
    double pushed = 0;                            // in this tick, with the scales of the rounds: not below 0
  };

  /// How two organs answer, since they met.
  struct Learnt {
    double scale = 1;  // of their shares: what a push has to move, in masses of its sphere
    double steepest = std::numeric_limits<double>::infinity();  // what it may be
    bool is_first = true;                                       // nothing was asked of them yet
  };

  /// Two organs. What they meet of each other in this tick has one place in all three lists.
  struct Couple {
    Body *one, *other;
    double most_scale;  // as both foresee pushes
    std::span<Pair> pairs;
    std::span<OrganContact> of_one, of_other;
    bool answers = false;  // in this tick
    Learnt learnt;
  };

  void gather() noexcept;
  bool collide(Couple& couple) noexcept;
  bool find_pairs(Body& one, Body& other) noexcept;
  static void share_out(Couple& couple) noexcept;
  void part() noexcept;
  static bool part(Couple& couple, bool in_any_case) noexcept;
  static void respond(Couple& couple) noexcept;
  static bool answered(const Couple& couple) noexcept;
  static void learn(Couple& couple, double before) noexcept;
  static double lacking(const Couple& couple, std::size_t pair) noexcept;

  std::vector<Body> bodies_;
  std::vector<Couple> couples_;  // each two of them
  std::vector<Pair> pairs_;      // of this tick; never beyond its capacity
};

}  // namespace omentum::deform
