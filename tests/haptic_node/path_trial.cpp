#include "path_trial.h"

#include "haptic_node/device_limits.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace omentum::haptic_test {
namespace {

using geometry::Vec3;

// How often it is asked where the air is, s: at 0.4 m/s a tool goes 4 mm, so that one which is farther than 5
// mm from the tissue both times met none in between.
constexpr double kLook_s = 0.01;
constexpr double kStallEvery_s = 0.5;
constexpr double kNever_s = std::numeric_limits<double>::infinity();

// On a clock that began before the trial.
std::int64_t ns_of(double t_s) {
  return 1'000'000'000 + static_cast<std::int64_t>(std::llround(1e9 * t_s));
}

Eigen::IOFormat row() {
  return {4, Eigen::DontAlignCols, ", ", ", ", "", "", "(", ")"};
}

}  // namespace

PathTrial::PathTrial(const haptic::HapticModel& model, std::vector<Way> ways, Coupling coupling)
    : model_(model),
      ways_(std::move(ways)),
      state_(model),
      work_(model),
      inputs_(ways_.size()),
      outputs_(ways_.size()),
      before_(ways_.size()),
      frames_(ways_.size()),
      in_air_since_s_(ways_.size(), kNever_s),
      off_tissue_since_s_(ways_.size(), kNever_s),
      tool_work_j_(ways_.size()) {
  for (std::size_t i = 0; i < ways_.size(); ++i) {
    air_.emplace_back(model.organs.front(), static_cast<std::int32_t>(i));
    if (coupling == Coupling::kSafe)
      hands_.push_back(std::make_unique<HandLine>(static_cast<std::uint32_t>(i), 1 / kTick_s));
  }
}

const Findings& PathTrial::run(double seconds, std::span<const double> stalls_s) {
  step(0);
  double look_s = 0, stall_s = kStallEvery_s;
  std::size_t stall = 0;
  for (double t = kTick_s; t <= seconds && findings_.finite; t += kTick_s) {
    if (!stalls_s.empty() && t > stall_s) {
      t += stalls_s[stall++ % stalls_s.size()];
      stall_s = t + kStallEvery_s;
    }
    step(t);
    account(t);
    if (watch) watch(t, outputs_, state_);
    if (t < look_s) continue;
    look_for_air(t);
    look_s = t + kLook_s;
  }
  for (const auto& hand : hands_) {
    findings_.hand_given_j = std::max(findings_.hand_given_j, hand->most_given_j());
    findings_.altered += hand->altered();
  }
  return findings_;
}

haptic::ToolInput PathTrial::input_of(std::size_t i, double t_s) {
  haptic::ToolInput input;
  input.frame = ways_[i](t_s);
  input.engaged = true;
  input.max_stiffness_n_m = haptic::kUsualStiffness_n_m;
  if (hands_.empty()) return input;
  const auto& trocar = model_.tools[i].trocar;
  hands_[i]->exert(ns_of(t_s));
  return hands_[i]->hear(trocar ? haptic::through_trocar(input.frame, *trocar) : input.frame, ns_of(t_s));
}

void PathTrial::step(double t_s) {
  for (std::size_t i = 0; i < ways_.size(); ++i) {
    inputs_[i] = input_of(i, t_s);
    frames_[i] = state_.tools[i].frame;
  }
  before_ = outputs_;
  const haptic::StepResult result = haptic::haptic_step(model_, inputs_, state_, work_, outputs_);
  for (std::size_t i = 0; i < hands_.size(); ++i) hands_[i]->answer(outputs_[i], ns_of(t_s));
  ++findings_.ticks;
  findings_.unsolved += result.status != physics::ContactStatus::kConverged;
}

void PathTrial::account(double t_s) {
  bool free = true;
  for (std::size_t i = 0; i < ways_.size(); ++i) {
    const haptic::ToolOutput &was = before_[i], &is = outputs_[i];
    if (!is.force.allFinite() || !is.torque.allFinite() || !std::isfinite(is.stored_j)) {
      findings_.finite = false;
      findings_.not_finite = describe(i, t_s);
      return;
    }
    const haptic::ToolFrame& now = state_.tools[i].frame;
    const double work_j =
        0.5 * (was.force + is.force).dot(now.p_WT - frames_[i].p_WT) +
        0.5 * (was.torque + is.torque).dot(haptic::rotation_between(frames_[i].q_WT, now.q_WT));
    tool_work_j_[i] += work_j;
    work_j_ += work_j;
    free = free && is.force.isZero(0);
  }
  findings_.given_j = std::max(findings_.given_j, work_j_);
  findings_.put_in_j = std::max(findings_.put_in_j, -work_j_);
  if (work_j_ - work_when_free_j_ > findings_.given_in_contact_j) {
    findings_.given_in_contact_j = work_j_ - work_when_free_j_;
    findings_.energy.clear();
    for (std::size_t i = 0; i < ways_.size(); ++i) findings_.energy += describe(i, t_s);
  }
  if (free) work_when_free_j_ = work_j_;
}

void PathTrial::look_for_air(double t_s) {
  for (std::size_t i = 0; i < ways_.size(); ++i) {
    const double model_n = outputs_[i].force.norm();
    const double force_n = hands_.empty() ? model_n : std::max(model_n, hands_[i]->exerted().force.norm());
    const AirOracle::Place place = air_[i].look(state_, model_n > 0);
    const auto judge = [&](bool off, double& since_s, double& worst_n, std::string& where) {
      since_s = off ? std::min(since_s, t_s) : kNever_s;
      if (t_s - since_s < kLetGo_s || force_n <= worst_n) return;
      worst_n = force_n;
      where = describe(i, t_s);
    };
    judge(place == AirOracle::Place::kAir, in_air_since_s_[i], findings_.air_force_n, findings_.air);
    judge(place != AirOracle::Place::kTissue, off_tissue_since_s_[i], findings_.dragged_n, findings_.dragged);
  }
}

std::string PathTrial::describe(std::size_t tool, double t_s) const {
  std::ostringstream text;
  text << "\n  at " << t_s << " s tool " << tool << " at "
       << (1e3 * state_.tools[tool].frame.p_WT).transpose().format(row()) << " mm feels "
       << outputs_[tool].force.transpose().format(row()) << " N, stored " << 1e3 * outputs_[tool].stored_j
       << " mJ, hands given " << 1e3 * work_j_ << " mJ";
  for (int c = 0; c < state_.contact_count; ++c) {
    const haptic::ToolContact& contact = state_.contacts[c];
    if (contact.tool != static_cast<std::int32_t>(tool) || !contact.touches()) continue;
    text << "; point " << contact.point << " holds triangle " << contact.held.triangle << " with "
         << contact.force.norm() << " N along " << contact.place.normal.transpose().format(row());
  }
  return text.str();
}

}  // namespace omentum::haptic_test
