// An organ with masses that swings, is cut and tears (Cotin 1998, section 5).
#pragma once

#include "deform_node/body_loads.h"
#include "deform_node/body_meeting.h"
#include "deform_node/body_stepper.h"
#include "deform_node/cut_queue.h"
#include "deform_node/organ_models.h"
#include "deform_node/parted_tissue.h"
#include "deform_node/patch_gatherer.h"
#include "physics/dynamics/energy_watch.h"
#include "physics/dynamics/swept_cut.h"
#include "physics/dynamics/tearing.h"
#include "physics/nodal_stress.h"

#include <functional>

namespace omentum::deform {

/// What a dynamic organ consists of.
struct DynamicParts {
  SteppedBody body;                        // its mesh and material outlive the model
  std::span<const NodeId> uncut_surface;   // in the organ file's order; read at construction alone
  std::unique_ptr<BodyStepper> stepper{};  // of the same body
  double energy_margin = 2;                // of a sound integration by it (physics/dynamics/energy_watch.h)
  Vec3 gravity_m_s2 = Vec3::Zero();
  std::vector<physics::TearLimits> tears{};  // [T]
  double cut_delay_s = 0, cut_rate_per_s = 1;
  double smallest_piece_m3 = 0;
  std::span<const geometry::CoveredFace> covered{};  // no surface as yet; read at construction alone
  std::vector<std::uint8_t> precomputed{};  // [T] other than 0: nothing takes it away; empty: none is
  physics::StressLaw stress = physics::StressLaw::kNone;  // what its law says of it
  // Always in equilibrium: it weighs nothing that could swing, and for other organs it is a wall that moves.
  // What supports do not hold is dropped as it is cut off; or has masses from then on, and this gravity,
  // where the stepper lets pieces fall.
  bool is_static = false;
  // [T] other than 0: precomputed, and cut all the same; nodes that nothing else is around have no masses. A
  // piece with such tissue that supports do not hold is dropped or has masses, likewise. Empty: none, or all.
  std::vector<std::uint8_t> massless{};
  std::optional<Vec3> piece_gravity_m_s2{};
  std::function<std::unique_ptr<StrainGauge>()> gauge{};  // of another kind than a body's; or empty
};

/// Steps of its own fixed length as the clock goes on; strokes burn through, what is loaded too much tears, a
/// piece that falls out of reach is dropped. Every removal is a new topology version, and every reset of an
/// organ that was cut. What its energy may be is what was done to it: more says that it diverges.
class DynamicModel final : public OrganModel {
 public:
  explicit DynamicModel(DynamicParts parts);

  ModelSizes sizes() const override;
  void step(const TickLoads& loads, double dt_s) noexcept override;
  void reset() noexcept override;
  /// What hung and was repaired is not told apart from the rest: it counts as none.
  void take_up(std::span<const std::uint8_t> removed_bits, std::span<const std::uint8_t> burnt_bits,
               std::uint64_t version) noexcept override;
  OrganView view() const noexcept override;
  ModelStatus status() const noexcept override { return status_; }
  bool local_model(const PatchPlace& place, LocalPatch& patch) const noexcept override;
  std::unique_ptr<StrainGauge> strain_gauge() const override;
  std::span<const CollisionSphere> collidable() const noexcept override;
  void respond(std::span<const OrganContact> contacts) noexcept override;

 private:
  void cut(std::span<const CutStroke> strokes, double dt_s) noexcept;
  void put_back_precomputed() noexcept;
  bool can_go(geometry::TetId t) const noexcept { return precomputed_.empty() || precomputed_[t] == 0; }
  std::span<const geometry::TetId> those_that_can_go(std::span<const geometry::TetId> met) noexcept;
  void check(double dt_s) noexcept;
  void drop_what_fell() noexcept;
  /// Those that are there, and what then has to go. Returns them all.
  std::span<const geometry::TetId> remove(std::span<const geometry::TetId> tetrahedra) noexcept;
  void add_gone(const geometry::Removal& removal) noexcept;
  void part_unheld() noexcept;
  std::span<const geometry::TetId> off_supports(std::span<const geometry::TetId> pieces) noexcept;
  void let_go(std::span<const geometry::TetId> pieces) noexcept;
  /// What the editor took, `gone_`, goes off the body.
  void forgo_gone() noexcept;
  void list_removed() noexcept;
  void advance(int steps) noexcept;
  using Step = decltype(&BodyStepper::step);
  /// False: the energy afterwards cannot be.
  bool run(int steps, Step step) noexcept;
  bool run_again(int steps) noexcept;
  double energy_j() noexcept;
  void show() noexcept;
  void look_ahead() const noexcept;

  const geometry::TetraMesh& mesh_;
  const physics::MaterialMap& material_;
  physics::StressLaw stress_;
  std::function<std::unique_ptr<StrainGauge>()> gauge_;
  geometry::MeshEditor editor_;
  BodyLoads loads_;
  physics::BodyState state_, before_;  // now, and when this tick began
  std::unique_ptr<BodyStepper> stepper_;
  physics::EnergyWatch watch_;
  physics::SweptCut swept_;
  std::vector<std::uint8_t> precomputed_;  // [T] or empty
  CutQueue burning_;
  physics::Tearing tearing_;
  bool is_static_;
  std::unique_ptr<PartedTissue> parted_;  // null: all of it has masses, and what floats falls
  std::optional<Vec3> piece_gravity_;     // none: what is parted is dropped
  double reach_m_;                        // farther nothing falls
  double ahead_s_ = 0;                    // of the clock's time, not yet stepped
  double until_check_s_ = 0;              // of tearing
  std::uint64_t version_ = 0;
  ModelStatus status_;
  std::vector<geometry::TetId> gone_, fallen_, met_;  // workspace, capacity T
  std::vector<std::uint8_t> burnt_;                   // bits, of what edges burnt away
  std::vector<float> values_;                         // [3N], of them 3 for each node of the surface
  // workspace of local_model()
  struct Felt {
    std::vector<float> compliance;  // [3 kPatchNodes squared]
    std::vector<double> ahead;      // [3N] velocities, m/s, of one more step under the same forces ...
    bool is_foreseen = false;       // ... from where the body is now
  };
  std::unique_ptr<PatchGatherer> gatherer_;
  std::unique_ptr<Felt> felt_;
  std::unique_ptr<BodyMeeting> meeting_;  // as other organs ask for it: alone in a scene, none does
};

}  // namespace omentum::deform
