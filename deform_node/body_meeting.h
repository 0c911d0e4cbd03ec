// An organ with masses among others: where its next step would take it, and what they do to that.
#pragma once

#include "deform_node/body_spheres.h"
#include "deform_node/body_stepper.h"

#include <optional>

namespace omentum::deform {

/// Organs that touch are pushed apart by the velocities that the next step would end with, and by how these
/// answer to a push: the body's own weight is then carried within the step that it acts in, and a push counts
/// for as much of the body as it reaches within a step. The pushes themselves, opposite and equal on both
/// sides, load that step as they are: momentum stays, whatever was foreseen. Costs a solve in each tick
/// with a contact and one for each round of OrganCollision; takes its memory when it is made. One thread.
class BodyMeeting {
 public:
  /// What was cut of the body.
  struct Cut {
    const geometry::MeshEditor& editor;
    std::uint64_t version;
  };

  /// As BodySpheres'.
  BodyMeeting(const geometry::TetraMesh& mesh, const physics::Inertia& inertia);

  std::size_t most_spheres() const noexcept { return spheres_.most(); }
  /// `external`: forces on all nodes but those of other organs, [3N], N.
  std::span<const CollisionSphere> collidable(const Cut& cut, const physics::BodyState& state,
                                              BodyStepper& stepper,
                                              std::span<const double> external) noexcept;
  void respond(std::span<const OrganContact> contacts, const physics::BodyState& state, BodyStepper& stepper,
               std::span<const double> external) noexcept;
  /// Since the last step somebody pushed: the velocities that the next one would end with, [3N], m/s. Else
  /// empty.
  std::span<const double> ahead() const noexcept {
    return meets_ ? std::span(ahead_) : std::span<const double>();
  }
  /// Before steps that take so long: `loads` carry the pushes.
  void act(double seconds, const geometry::MeshEditor& editor, BodyLoads& loads) noexcept;
  void reset() noexcept;

 private:
  void look_ahead(const physics::BodyState& state, BodyStepper& stepper,
                  std::span<const double> external) noexcept;

  BodySpheres spheres_;
  std::optional<std::uint64_t> version_;   // of the topology that the spheres are of
  bool meets_ = false, has_met_ = false;   // since the last step, before it
  bool is_ahead_ = false;                  // ahead_ is of this state
  std::vector<double> ahead_, places_;     // [3N] velocities at the end of the next step, m/s; m
  std::vector<double> impulses_, latest_;  // [3N] of all contacts, and of the last call, N s
};

}  // namespace omentum::deform
