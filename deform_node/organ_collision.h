// Where the organs of a scene meet one another.
#pragma once

#include "deform_node/organ_models.h"
#include "physics/intestine/pair_memory.h"
#include "runtime/crew.h"

#include <Eigen/Geometry>

#include <limits>
#include <optional>
#include <vector>

namespace omentum::deform {

/// After all organs' steps: gathers what each lets others meet, finds the pairs of spheres of two organs that
/// overlap or nearly so, and lets both models respond. Between two organs the spheres in the common part of
/// their boxes are tried one by one; two that do not yield are left alone. The models respond in a few
/// rounds, two organs after two, each to what is lacking after the last one: how much a push moves is the
/// models' secret, and is learnt of each two from what it did. Where both models want it, a tick begins with
/// the pushes of the one before, of pairs that still meet; two of which neither has stepped since have theirs
/// already. One thread's, which shares the models' work with
/// its crew; allocates in the constructor only.
class OrganCollision {
 public:
  /// Both outlive this. Without a crew the calling thread does all.
  explicit OrganCollision(const std::vector<OrganModel*>& models, runtime::Crew* crew = nullptr);
  OrganCollision(const OrganCollision&) = delete;  // its parts refer to each other
  OrganCollision& operator=(const OrganCollision&) = delete;

  /// False when some organ met more than there is room for: the rest is left out in this tick.
  [[nodiscard]] bool run() noexcept;
  /// An organ, by its place among the models, was put elsewhere: whom it met is forgotten.
  void reset(std::size_t organ) noexcept;

  /// Two organs, by their places among the models, and where they touch.
  struct Met {
    std::size_t one = 0, other = 0;
    std::span<const physics::Touch> touches{};
  };
  static constexpr std::size_t kMostTouches = 1024;  // of two organs
  /// After run(), in each tick: takes down who touched whom in it, which has lasted `tick_s`; of two that
  /// wait for a step, in the newest one of theirs.
  void note_touches(double tick_s) noexcept;
  std::size_t couple_count() const noexcept { return couples_.size(); }
  Met met(std::size_t couple) const noexcept;

 private:
  static constexpr std::uint64_t kNever = std::numeric_limits<std::uint64_t>::max();

  struct Body {
    OrganModel* model = nullptr;
    std::span<const CollisionSphere> spheres;
    Eigen::AlignedBox3d box;
    bool yields = false;                 // some part of it
    std::uint64_t steps = kNever;        // that its model had taken in the newest tick
    bool moved = false;                  // it has stepped since the tick before, or was put elsewhere
    std::vector<OrganContact> contacts;  // of this tick; never beyond its capacity
    std::vector<double> asked;           // [spheres] of each, the sum of its contacts' shares

    const Vec3& velocity(std::int32_t sphere) const {
      return spheres[static_cast<std::size_t>(sphere)].velocity;
    }
  };

  /// Two spheres.
  struct Pair {
    std::int32_t one = 0, other = 0;
    double share_of_one = 0, share_of_other = 0;  // before they are scaled
    double weight_kg = 0;                         // of its speed among those of all pairs
    double push_m_s = 0;                          // of the last round
    double pushed = 0;                            // in this tick, with the scales of the rounds: not below 0
    Vec3 rub_m_s = Vec3::Zero(), rubbed = Vec3::Zero();  // the same across the push, where that goes on
  };

  /// How two organs answer, since they met.
  struct Learnt {
    double scale = 1;  // of their shares: what a push has to move, in masses of its sphere
    double steepest = std::numeric_limits<double>::infinity();  // what it may be
    bool is_first = true;                                       // nothing was asked of them yet
  };

  /// How hard pairs of spheres pushed and rubbed in the newest tick, kg m/s.
  struct Push {
    double along = 0;
    Vec3 across = Vec3::Zero();
  };
  using Pushes = physics::PairMemory<Push>;

  /// Two organs. What they meet of each other in this tick has one place in all three lists.
  struct Couple {
    Body *one, *other;
    double most_scale;  // as both foresee pushes
    std::span<Pair> pairs;
    std::span<OrganContact> of_one, of_other;
    bool answers = false;  // in this tick
    bool waits = false;    // its pushes still wait for a step of either
    Learnt learnt;
    std::optional<Pushes> pushes{};         // where both begin with those of the tick before
    std::vector<physics::Touch> touches{};  // as they were noted; never beyond its capacity
    double waited_s = 0;                    // since then
  };

  static void note_touches(Couple& couple, double lasted_s) noexcept;
  void gather() noexcept;
  bool collide(Couple& couple) noexcept;
  bool find_pairs(Body& one, Body& other) noexcept;
  static void share_out(Couple& couple) noexcept;
  void go_on() noexcept;
  void go_on(Couple& couple) noexcept;
  static void remember(Couple& couple) noexcept;
  static void rub(Couple& couple, std::size_t pair) noexcept;
  void part() noexcept;
  bool part(Couple& couple, bool in_any_case) noexcept;
  void respond(Couple& couple, double scale, bool goes_on) noexcept;
  static bool answered(const Couple& couple) noexcept;
  static void learn(Couple& couple, double before) noexcept;
  static double lacking(const Couple& couple, std::size_t pair) noexcept;

  runtime::Crew alone_{0};
  runtime::Crew& crew_;
  std::vector<Body> bodies_;
  std::vector<Couple> couples_;  // each two of them
  std::vector<Pair> pairs_;      // of this tick; never beyond its capacity
};

}  // namespace omentum::deform
