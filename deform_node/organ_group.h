// The organs of a scene, moved together.
#pragma once

#include "deform_node/organ_collision.h"
#include "deform_node/organ_cuts.h"
#include "deform_node/served_organ.h"
#include "runtime/crew.h"
#include "runtime/faults.h"

#include <vector>

namespace omentum::deform {

/// Steps each organ's model under what the tools do to it, then lets the organs meet one another. What a
/// model says is wrong becomes a fault; one that diverged goes back to rest. Where several organs cost, they
/// are stepped at the same time, which changes nothing of what they do. One thread's; step() and reset()
/// allocate nothing.
class OrganGroup {
 public:
  /// `faults` outlives this. `most_threads`: at most so many step organs, the calling one counted.
  OrganGroup(std::vector<ServedOrgan> organs, runtime::FaultList& faults,
             std::size_t most_threads = std::thread::hardware_concurrency());

  /// `book` has advanced to this moment, and learns the versions that the organs are at.
  void step(ContactBook& book, double dt_s) noexcept;
  void reset(ContactBook& book) noexcept;
  /// Goes on with what another deform_node left of each organ: at rest, in the same version, or in a later
  /// one where this node has used it for another set. Not in a step: a large cut takes as long as it took to
  /// make.
  void take_up(const std::vector<OrganCuts>& cuts, ContactBook& book) noexcept;

  const std::vector<ServedOrgan>& organs() const { return organs_; }
  const OrganCollision& collision() const noexcept { return collision_; }
  /// Over all organs.
  std::uint64_t steps() const;
  std::uint32_t removed_tetrahedra() const;
  std::uint32_t repaired_tetrahedra() const;
  CutAccount cuts() const;
  std::optional<CollisionAccount> collisions() const;  // of those that look for them
  /// What the slowest organ lived through, s; 0 where none has a time of its own.
  double simulated_s() const;

 private:
  void reset(std::uint32_t organ, ContactBook& book) noexcept;
  void heed(std::uint32_t organ, ContactBook& book) noexcept;

  std::vector<ServedOrgan> organs_;
  runtime::FaultList& faults_;
  runtime::Crew crew_;
  OrganCollision collision_;
};

}  // namespace omentum::deform
