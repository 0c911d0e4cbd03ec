// An intestine and its mesentery as deform_node moves them (Raghupathi 2004).
#pragma once

#include "deform_node/gut_compliance.h"
#include "deform_node/gut_meeting.h"
#include "deform_node/gut_presses.h"
#include "deform_node/organ_models.h"
#include "deform_node/patch_choice.h"
#include "physics/intestine/gut_system.h"

namespace omentum::deform {

/// What an intestine consists of. `felt` is the same gut in steps that a hand feels one of: it says what
/// yields within it. `ahead` looks that far ahead, in the gut's own steps or no longer ones than a pile lies
/// still in: it would be foreseen as moving. None where `felt` has such steps.
struct GutPhysics {
  std::unique_ptr<physics::GutSystem> system, felt, ahead{};
  std::vector<physics::GutObstacle> obstacles{};
  double wall_m_n = 1.0 / 300;  // what a place of the skin yields to a force, beside the masses, m/N
};

/// Steps of its own fixed length as the clock goes on. A press is imposed as a place along the pattern of its
/// forces (physics/dynamics/imposed_press.h): the step is made under the hand's forces, and what it then
/// lacks, or has too much, is made up by what the gut yields to them; collisions have the last word. At rest
/// nothing is left to make up, so that the force is that of the springs, the walls and what the gut lies on,
/// whatever the step. Its state is the masses' places.
class GutModel final : public OrganModel {
 public:
  /// Nodes of one patch: as many as a LAN carries.
  static constexpr std::size_t kPatchNodes = 24;

  explicit GutModel(GutPhysics parts);

  ModelSizes sizes() const override;
  void step(const TickLoads& loads, double dt_s) noexcept override;
  void reset() noexcept override;
  OrganView view() const noexcept override;
  ModelStatus status() const noexcept override { return status_; }
  bool local_model(const PatchPlace& place, LocalPatch& patch) const noexcept override;
  std::unique_ptr<StrainGauge> strain_gauge() const override;
  std::span<const CollisionSphere> collidable() const noexcept override;
  void respond(std::span<const OrganContact> contacts) noexcept override;

  std::size_t touches_itself(std::span<physics::Touch> found) const noexcept override {
    return system_->touches(found);
  }

  const physics::GutReport& report() const noexcept { return system_->report(); }

 private:
  void advance() noexcept;
  void note_collisions(const physics::GutCollisionReport& before) noexcept;
  std::span<const double> strengths_on(const physics::GutSystem& gut) noexcept;
  void impose() noexcept;
  void press_ahead() noexcept;
  void hold(double tick_s) noexcept;
  double run_ahead(double seconds) const noexcept;
  physics::GutLoads loads() const noexcept;
  std::span<const Vec3> forces() const noexcept;
  void show() noexcept;
  void look() const noexcept;
  double coming_tick_s() const noexcept;
  void foresee() const noexcept;
  void look_ahead() const noexcept;

  std::unique_ptr<physics::GutSystem> system_, felt_, ahead_;
  std::vector<physics::GutObstacle> obstacles_;
  geometry::GutSkin skin_;
  GutPresses presses_;
  physics::ImposedPress imposed_;
  physics::GutState wanted_;              // workspace: where presses want the masses
  double ahead_s_ = 0;                    // of the clock's time, not yet stepped
  double until_felt_s_ = 0;               // strengths hold so long where steps are shorter
  std::array<double, 2> last_ticks_s_{};  // how much they lived through
  ModelStatus status_;
  std::vector<float> values_;  // [3 masses]
  // workspace of local_model()
  struct Felt {
    Felt(const geometry::GutSkin& skin, std::size_t masses, double wall_m_n);
    // [nodes of the skin] now, with the dents that tools press, and a felt step later under the same forces
    std::vector<Vec3> places, dented, next;
    bool is_seen = false, is_foreseen = false, is_next_seen = false;
    std::vector<Vec3> ahead;   // [masses] velocities on the way there, m/s
    std::vector<Vec3> wanted;  // [masses] places there, m
    std::vector<Vec3> forces;  // [masses] of tools and other organs, N
    PatchChoice choice;
    GutCompliance compliance;
  };
  std::unique_ptr<Felt> look_;
  std::unique_ptr<GutMeeting> meeting_;
};

}  // namespace omentum::deform
