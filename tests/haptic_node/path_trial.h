// Both tools of a model along given ways, tick by tick, and what went wrong.
#pragma once

#include "air_oracle.h"
#include "hand_line.h"
#include "haptic_node/haptic_step.h"

#include <functional>
#include <memory>
#include <string>

namespace omentum::haptic_test {

/// A tool's pose at a time, s.
using Way = std::function<haptic::ToolFrame(double t_s)>;

/// What a trial found out. Energies: of the model's own wrench, by the mean of both ends of a tick; positive:
/// given to the hands.
struct Findings {
  bool finite = true;
  double air_force_n = 0;  // largest, of model or device, on a tool that was in the air for kLetGo_s
  double dragged_n = 0;    // the same where it may have dragged the surface along (see AirOracle)
  double given_j = 0;      // most that the hands together had got at any time, beyond what they had put in
  double given_in_contact_j = 0;  // the same since the tissue was last free: what it lost before is no credit
  double put_in_j = 0;            // most that they had put in
  double hand_given_j = 0;        // most that one hand got at any time through safety and its device's hold
  int altered = 0;                // answers that were not the model's own
  int unsolved = 0, ticks = 0;
  std::string air, dragged, energy, not_finite;  // where: tool, time, position, force
};

/// Whether the hands are on devices, behind force safety, or hold the model bare.
enum class Coupling { kBare, kSafe };

/// What a hand may be given beyond what it put in, J (issue 6): it lifts a handle of 50 g by 2 cm.
inline constexpr double kGivenBound_j = 10e-3;

/// A tool in the air is let go of within this, s.
inline constexpr double kLetGo_s = 0.05;

class PathTrial {
 public:
  static constexpr double kTick_s = 1e-3;

  /// One way per tool of the model, which must outlive the trial.
  PathTrial(const haptic::HapticModel& model, std::vector<Way> ways, Coupling coupling = Coupling::kBare);

  /// From 0 to `seconds`. `stalls_s`: lengths of gaps between ticks, taken in turn every half second.
  const Findings& run(double seconds, std::span<const double> stalls_s = {});

  /// Given to one hand so far, less what it put in, J: by its device where it has one.
  double given_j(std::size_t tool) const {
    return hands_.empty() ? tool_work_j_[tool] : hands_[tool]->given_j();
  }

  /// Called after every tick with its time.
  std::function<void(double t_s, std::span<const haptic::ToolOutput>, const haptic::HapticState&)> watch;

 private:
  haptic::ToolInput input_of(std::size_t tool, double t_s);
  void step(double t_s);
  void account(double t_s);
  void look_for_air(double t_s);
  std::string describe(std::size_t tool, double t_s) const;

  const haptic::HapticModel& model_;
  std::vector<Way> ways_;
  haptic::HapticState state_;
  haptic::HapticWorkspace work_;
  std::vector<haptic::ToolInput> inputs_;
  std::vector<haptic::ToolOutput> outputs_, before_;
  std::vector<haptic::ToolFrame> frames_;
  std::vector<std::unique_ptr<HandLine>> hands_;  // none where they are bare
  std::vector<AirOracle> air_;
  std::vector<double> in_air_since_s_, off_tissue_since_s_;
  std::vector<double> tool_work_j_;
  double work_j_ = 0, work_when_free_j_ = 0;
  Findings findings_;
};

}  // namespace omentum::haptic_test
