// An intestine among other organs: where its next step would take it, and what they do to that.
#pragma once

#include "deform_node/axis_spheres.h"
#include "physics/intestine/gut_system.h"

namespace omentum::deform {

using geometry::Vec3;

/// As BodyMeeting: organs that touch are pushed apart by the velocities that the next step would end with.
/// Among bodies of another kind how these answer to a push is what a step of the springs says, collisions of
/// its own left aside. Among guts alone, which are many spheres and each costs as much, pushes go on from
/// tick to tick (OrganCollision): what rests on them is at rest, so that the velocities are those the gut
/// has, and what comes on top changes them as the constant matrix of its step says. The pushes themselves,
/// opposite and equal on both sides, load the next steps as they are: momentum stays, whatever was foreseen.
/// Takes its memory when it is made. One thread.
class GutMeeting {
 public:
  /// `felt`, whose steps it foresees, outlives it.
  explicit GutMeeting(const physics::GutSystem& felt);
  GutMeeting(const GutMeeting&) = delete;  // its parts refer to each other
  GutMeeting& operator=(const GutMeeting&) = delete;

  std::size_t most_spheres() const noexcept { return spheres_.count(); }
  /// Whether the velocities that count are those at the end of a whole step: who met no body lately saves it.
  bool foresees() const noexcept { return meets_body_ || met_body_; }
  /// `ahead`: [masses] the velocities at the end of a whole step, if it foresees one.
  std::span<const CollisionSphere> collidable(const physics::GutState& state,
                                              std::span<const Vec3> ahead) noexcept;
  /// `forces_n`: [masses] of all but other organs and weight; `ahead`: as above, which the pushes change.
  void respond(std::span<const OrganContact> contacts, const physics::GutState& state,
               std::span<const Vec3> forces_n, std::span<Vec3> ahead) noexcept;
  /// Whether these contacts are with a body of another kind.
  static bool is_with_body(std::span<const OrganContact> contacts) noexcept {
    return !contacts.empty() && !contacts.front().rubs_on;
  }
  /// Before steps that take so long: the pushes become forces, until put_down().
  void act(double seconds) noexcept;
  /// The same for a look ahead, from which they are still pushes.
  void lend(double seconds) noexcept;
  void put_down() noexcept;
  /// [masses], N; empty: nobody pushes.
  std::span<const Vec3> forces() const noexcept;
  void reset() noexcept;

 private:
  void step_springs(const physics::GutState& state, std::span<const Vec3> forces_n) noexcept;
  void foresee_pushes(const physics::GutState& state, std::span<const Vec3> forces_n,
                      std::span<Vec3> ahead) noexcept;
  void look_ahead() noexcept;

  const physics::GutSystem& felt_;
  physics::GutBand band_;
  physics::GutProjective springs_;
  AxisSpheres spheres_;
  bool meets_ = false;                          // since the last step
  bool meets_body_ = false, met_body_ = false;  // since then, before it
  bool is_unpushed_ = false;                    // unpushed_ is of this state
  bool acts_ = false;
  std::vector<Vec3> impulses_, latest_;  // [masses] of all contacts since then, and of the last call, N s
  std::vector<Vec3> forces_;             // [masses] N
  std::vector<Vec3> unpushed_;           // [masses] where a step without them would end, m
  std::vector<Vec3> ahead_of_none_;      // [masses] the velocities that were foreseen without them, m/s
  std::vector<Vec3> near_;               // [masses] velocities among guts alone, m/s
  physics::GutState moved_;              // workspace
};

}  // namespace omentum::deform
