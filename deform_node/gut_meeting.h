// An intestine among other organs: where its next step would take it, and what they do to that.
#pragma once

#include "deform_node/gut_spheres.h"
#include "physics/intestine/gut_system.h"

namespace omentum::deform {

using geometry::Vec3;

/// As BodyMeeting: organs that touch are pushed apart by the velocities that the next step would end with.
/// How these answer to a push is what a step of the springs says, collisions of its own left aside. The
/// pushes themselves, opposite and equal on both sides, load the next steps as they are: momentum stays,
/// whatever was foreseen. Takes its memory when it is made. One thread.
class GutMeeting {
 public:
  /// `felt`, whose steps it foresees, outlives it.
  explicit GutMeeting(const physics::GutSystem& felt);
  GutMeeting(const GutMeeting&) = delete;  // its parts refer to each other
  GutMeeting& operator=(const GutMeeting&) = delete;

  std::size_t most_spheres() const noexcept { return spheres_.count(); }
  /// Whether the velocities that count are those at the end of the next step: who met nobody lately saves it.
  bool looks_ahead() const noexcept { return meets_ || has_met_; }
  /// `x`, `v`: [masses], m and m/s.
  std::span<const CollisionSphere> collidable(std::span<const Vec3> x, std::span<const Vec3> v) noexcept {
    return spheres_.follow(x, v);
  }
  /// `forces_n`: [masses] of all but other organs and weight; `ahead`: [masses] the velocities at the end of
  /// the next step from `state`, m/s, which the pushes change.
  void respond(std::span<const OrganContact> contacts, const physics::GutState& state,
               std::span<const Vec3> forces_n, std::span<Vec3> ahead) noexcept;
  /// Before steps that take so long: the pushes become forces, until put_down().
  void act(double seconds) noexcept;
  void put_down() noexcept;
  /// [masses], N; empty: nobody pushes.
  std::span<const Vec3> forces() const noexcept;
  void reset() noexcept;

 private:
  void step_springs(const physics::GutState& state, std::span<const Vec3> forces_n) noexcept;

  const physics::GutSystem& felt_;
  physics::GutBand band_;
  physics::GutProjective springs_;
  GutSpheres spheres_;
  bool meets_ = false, has_met_ = false;  // since the last step, before it
  bool acts_ = false;
  std::vector<Vec3> impulses_;       // [masses] of all contacts since the last step, N s
  std::vector<Vec3> forces_;         // [masses] N
  std::vector<Vec3> unpushed_;       // [masses] where a step without them would end, m
  std::vector<Vec3> ahead_of_none_;  // [masses] the velocities that were foreseen without them, m/s
  physics::GutState moved_;          // workspace
};

}  // namespace omentum::deform
