// All that an intestine meets in a step: itself, its mesentery, walls and balls.
#pragma once

#include "physics/intestine/gut_carry.h"
#include "physics/intestine/gut_obstacle.h"
#include "physics/intestine/gut_response.h"
#include "physics/intestine/gut_spheres.h"
#include "physics/intestine/gut_state.h"
#include "physics/intestine/pair_finder.h"
#include "physics/intestine/pair_memory.h"
#include "physics/touch.h"

#include <memory>

namespace omentum::physics {

enum class GutPairMethod : std::uint8_t {
  kComplete,    // every near pair, no miss: nothing ever passes through anything
  kStochastic,  // the paper's active pairs: what it has not found yet is not held apart
};

struct GutCollisionSettings {
  GutPairMethod method = GutPairMethod::kComplete;
  std::int32_t passes = 6;         // of the response, >= 1
  double friction = 0.1;           // Coulomb's coefficient, >= 0: serosa is wet
  std::int32_t random_pairs = 32;  // new ones per step, kStochastic
  std::uint64_t seed = 1;          // of these
  std::int32_t most_spheres = 64;  // in one step; what comes beyond is left out
};

/// Room for contacts of each kind: what one does not use the next ones may, and none can take another's.
struct ContactRoom {
  std::size_t pairs = 0, spheres = 0, walls = 0;
  std::size_t with_spheres() const { return pairs + spheres; }
  std::size_t all() const { return pairs + spheres + walls; }
};

struct GutCollisionReport {
  std::int32_t contacts = 0;        // that pushed in the newest step
  std::int64_t pairs_tracked = 0;   // now
  std::int64_t distance_tests = 0;  // in the newest step
  std::int64_t bound_acted = 0;     // masses held back by the bound, once a step each, since the start
  std::int64_t left_out = 0;        // contacts and spheres that found no room, since the start
  double deepest_m = 0;             // the largest overlap left in the newest step
};

/// The third part of a gut's step: from where the springs want the masses to go to where they get. One thread
/// at a time; no allocation after construction; the same calls give the same results bit for bit.
class GutCollisions {
 public:
  /// Contacts that the passes may close are watched from this part of the least reach on.
  static constexpr double kWatched = 0.02;

  /// `masses_kg`: [masses], > 0 but for held ones (GutLayout), which never move. Throws std::invalid_argument
  /// where a number is out of its range, in words.
  GutCollisions(const geometry::GutShape& shape, std::span<const double> masses_kg, double step_s,
                const GutCollisionSettings& settings = {});

  /// `before`: [masses], in W, m, at the start of the step; `state`: what the springs predict for its end, on
  /// return what it is. Positions that overlapped are apart by the end, but never by more than
  /// kShareOfGap of what was free: whatever the prediction, no axis crosses another nor the mesentery, and
  /// no sphere's centre crosses either (its `reached` may stay behind what it asked for).
  /// With `yield`, contacts that go on begin with the impulse that they gave before, and springs that are
  /// stiff for the step carry it on (gut_carry.h). `carried`: [masses], m/s, the velocity that `state` has
  /// beside its way from `before`, where that way is no step but a correction; or empty: none.
  void resolve(std::span<const geometry::Vec3> before, GutState& state,
               std::span<const GutObstacle> obstacles, std::span<const MovingSphere> spheres,
               GutYield* yield = nullptr, std::span<const geometry::Vec3> carried = {}) noexcept;

  /// Of the newest step: one for each sphere given, up to most_spheres.
  std::span<const SphereOutcome> outcomes() const noexcept { return outcomes_; }
  /// Pairs of the newest step that were nearer than their reach at its start, or could be at its end.
  std::span<const NearPair> near_pairs() const noexcept { return near_.pairs; }
  /// Of the newest step: each place where the gut pushed itself apart, or still overlaps, up to as many as
  /// `found` has; how many. `x`: [masses], in W, m, at its end.
  std::size_t touches(std::span<const geometry::Vec3> x, std::span<Touch> found) const noexcept;
  const GutCollisionReport& report() const noexcept { return report_; }
  const GutParts& parts() const noexcept { return parts_; }
  /// Forgets all that was.
  void reset() noexcept;
  /// The same, but for how hard contacts of `other` push, a gut of the same shape and settings in steps of
  /// any length: what lies still goes on lying still.
  void take_up(const GutCollisions& other) noexcept;

 private:
  struct Push {
    geometry::Vec3 impulse = geometry::Vec3::Zero();  // N s, in W
  };

  GutParts parts_;
  double step_s_;
  GutCollisionSettings settings_;
  std::unique_ptr<PairFinder> finder_;
  GutSpheres spheres_;
  GutResponse response_;
  NearPairs near_;
  ContactRoom room_;
  std::vector<GutContact> contacts_;  // of all kinds, for the response
  std::vector<ContactKey> keys_;      // of contacts_
  std::vector<geometry::Vec3> warm_;  // of contacts_: what each gave in the step before, N s in W
  PairMemory<Push> pushes_;           // the same by keys
  bool is_carried_ = false;           // pushes_ has those of the newest step
  GutCarry carry_;
  std::vector<double> inverse_mass_;            // [masses + spheres], 1/kg
  std::vector<geometry::Vec3> before_, x_, v_;  // [masses + spheres]
  std::vector<double> way_;                     // [masses], m: in this step, at most
  std::vector<double> gap_;                     // [masses + spheres], m
  std::vector<std::uint8_t> held_;              // [masses + spheres], 1: by the bound, in this step
  std::vector<SphereOutcome> outcomes_;
  GutCollisionReport report_;

  double watched_m() const noexcept;
  double push_of(std::size_t contact) const noexcept;
  void recall_pushes() noexcept;
  void remember_pushes() noexcept;
  void take_in(std::span<const geometry::Vec3> before, const GutState& state,
               std::span<const MovingSphere> spheres) noexcept;
  void find_pairs(std::span<const geometry::Vec3> before) noexcept;
  void hold_back(std::size_t count, std::span<const geometry::Vec3> carried) noexcept;
  void limit_forces(std::span<const MovingSphere> spheres) noexcept;
  void gather_pairs(std::span<const geometry::Vec3> before) noexcept;
  void gather_spheres(std::span<const MovingSphere> spheres) noexcept;
  void gather_walls(std::span<const GutObstacle> obstacles) noexcept;
  void gather_faces(const GutObstacle& obstacle, geometry::MassId m, std::int32_t key) noexcept;
  void gather(std::span<const geometry::Vec3> before, const GutState& state,
              std::span<const GutObstacle> obstacles, std::span<const MovingSphere> spheres,
              std::span<const geometry::Vec3> carried) noexcept;
  void tell(const MovingMasses& masses) noexcept;
  void tell_spheres(std::size_t count) noexcept;
};

}  // namespace omentum::physics
