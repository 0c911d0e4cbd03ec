#include "haptic_node/tool_line.h"

#include "haptic_node/jaws.h"
#include "node_common/vectors.h"

#include <algorithm>
#include <cstdio>

namespace omentum::haptic {

using node::to_message;
using node::to_vector;

namespace {

// Less of the model's force than this is a source that somebody should know of; a few per cent are what a
// sampled contact gives.
constexpr double kCutShare = 0.5;
constexpr double kBelievedIntervals = 2;
static_assert(kLongestStale_s == 1 / 40.0, "the fault says 40 times a second");
static_assert(kLongestStale_s == node::kYoungAtMost_s, "a hand-over waits for the last force");

// What a device says in degrees or counts must not be booked as work of jaws that cannot open as far.
double opening_of(const msg::ToolPose& pose) {
  return std::clamp(pose.grip, 0.0, kWidest_rad);
}

}  // namespace

ToolFrame frame_of(const msg::ToolPose& pose) noexcept {
  const msg::Quat& q = pose.orientation;
  return {to_vector(pose.position), Eigen::Quaterniond(q.w, q.x, q.y, q.z).normalized()};
}

ToolLine::ToolLine(std::uint32_t id, const ForceLimits& limits, runtime::FaultList& faults,
                   std::string device)
    : id_(id),
      limits_(limits),
      faults_(faults),
      holder_(node::hand_over_ns(limits.decay_s)),
      named_(std::move(device)),
      safety_(limits) {
  const std::string tool = "tool " + std::to_string(id) + ": ";
  for (int v = 0; v < kPoseVerdicts; ++v) {
    refusals_[v] = tool + "pose refused: " + describe(static_cast<PoseVerdict>(v));
  }
  force_fault_ = tool + "force is not finite, held at zero until the fault is cleared";
  slow_fault_ = tool + "poses come less than 40 times a second, too seldom for a force";
  source_fault_ = tool + "contact feeds the hand, its force is cut";
}

// A pose that is none by itself neither takes a tool nor keeps it.
PoseVerdict ToolLine::judge(const msg::ToolPose& pose, std::int64_t now_ns,
                            const transport::ParticipantId& who) noexcept {
  if (forget_.exchange(false, std::memory_order_acquire)) guard_.forget();
  const PoseVerdict form = PoseGuard::form(pose);
  if (form != PoseVerdict::kAccepted) return form;
  known_.fetch();
  switch (holder_.judge(who, now_ns, known_.value())) {
    case node::PoseRight::kRefused:
      return PoseVerdict::kForeign;
    case node::PoseRight::kWaits:
      return PoseVerdict::kHandedOver;
    case node::PoseRight::kTakes:
      guard_.forget();
      if (holder_.last().count > 0) handed_.post(holder_.last());
      break;
    case node::PoseRight::kHolds:
      break;
  }
  const PoseVerdict verdict = guard_.judge(pose, now_ns);
  if (verdict != PoseVerdict::kSameMeasurement) holder_.heard(now_ns);
  return verdict;
}

bool ToolLine::hear(const msg::ToolPose& pose, std::int64_t now_ns,
                    const transport::ParticipantId& who) noexcept {
  const PoseVerdict verdict = judge(pose, now_ns, who);
  lost_.store(guard_.lost(), std::memory_order_relaxed);
  if (!is_accepted(verdict)) {
    refused_.fetch_add(1, std::memory_order_relaxed);
    if (is_fault(verdict)) faults_.raise(refusals_[static_cast<std::size_t>(verdict)]);
    return false;
  }
  accepted_.fetch_add(1, std::memory_order_relaxed);
  if (verdict == PoseVerdict::kReconnected) {
    ++connections_;
    interval_.restart(now_ns);
  } else {
    interval_.add(now_ns);
    if (interval_.is_settled() && interval_.seconds() > kLongestInterval_s) faults_.raise(slow_fault_);
  }
  poses_.post({pose, now_ns, connections_, interval_.seconds()});
  return true;
}

void ToolLine::hear(const msg::DeviceInfo& info, const transport::WriterId& writer) noexcept {
  for (const RefusedLimit& refused : devices_.hear(info, writer)) tell(refused);
  device_.post(devices_.limits());
  named_.hear(info, writer);
  known_.post(named_.known());
  described_.post(named_.known());
}

void ToolLine::gone(const transport::WriterId& writer) noexcept {
  devices_.gone(writer);
  device_.post(devices_.limits());
  named_.gone(writer);
  known_.post(named_.known());
  described_.post(named_.known());
}

void ToolLine::tell(const RefusedLimit& refused) noexcept {
  DeviceFault& text = device_faults_[refused.field];
  if (text[0] == 0) {
    std::snprintf(text.data(), text.size(),
                  "tool %u: DeviceInfo.%s = %g, expected %g to %g; the last one holds", id_,
                  describe(refused.field), refused.value, refused.expected.least, refused.expected.most);
  }
  faults_.raise(text.data());
}

PoseCounts ToolLine::counts() const noexcept {
  return {accepted_.load(std::memory_order_relaxed), refused_.load(std::memory_order_relaxed),
          lost_.load(std::memory_order_relaxed)};
}

bool ToolLine::listen(std::int64_t now_ns, ToolInput& input) noexcept {
  if (device_.fetch()) {
    safety_.set_device(device_.value());
    max_stiffness_n_m_ = device_.value().max_stiffness_n_m;
  }
  const bool fresh = poses_.fetch();
  const HeardPose& heard = poses_.value();
  const std::int64_t silence = silence_ns(heard), came_after_ns = heard.arrival_ns - taken_arrival_ns_;
  const bool same_hand = heard.connection > 0 && heard.connection == connection_;
  // a loop that stood still did not see the silence, but it was one
  reconnected_ = heard.connection != connection_ || (fresh && came_after_ns > silence);
  way_s_ = 0;
  if (fresh) take(heard);
  const std::int64_t age_ns = now_ns - heard.arrival_ns;
  engaged_ = heard.connection > 0 && age_ns < silence;
  told_ = heard.connection > 0 && age_ns < kForget_ns;
  if (reconnected_) lead_.restart();
  // a tool that appears lets go first: in the dent of its own last force it would seem to be outside
  const bool silent = same_hand && !engaged_ && age_ns < kHoldSilence_ns;
  const bool again = same_hand && engaged_ && reconnected_ && came_after_ns < kHoldSilence_ns;
  input = {.engaged = engaged_ && !reconnected_,
           .relocated = reconnected_,
           .silent = silent,
           .heard_again = again,
           .frame = lead_.ahead(frame_of(heard.pose), fresh),
           .grip = opening_of(heard.pose),
           .max_stiffness_n_m = max_stiffness_n_m_,
           .covered_j = safety_.covered_j()};
  return fresh;
}

// From when on nothing is left of a force: the pose was stale and the decay is over.
std::int64_t ToolLine::silence_ns(const HeardPose& heard) const noexcept {
  return static_cast<std::int64_t>(1e9 * (stale_after(heard.interval_s, limits_) + limits_.decay_s));
}

// How long the way from the pose before took: a burst arrives faster than it was measured; the longer one
// makes the hand slow rather than fast. Stamps may be in any unit, so that they are believed up to twice the
// usual.
void ToolLine::take(const HeardPose& heard) noexcept {
  if (!reconnected_) {
    const double arrived_s = 1e-9 * static_cast<double>(heard.arrival_ns - taken_arrival_ns_);
    const double measured_s = 1e-9 * static_cast<double>(stamp_difference_ns(stamp_ns_, heard.pose.stamp_ns));
    const double most_s = heard.interval_s > 0 ? kBelievedIntervals * heard.interval_s : measured_s;
    way_s_ = std::max(arrived_s, std::min(measured_s, most_s));
  }
  connection_ = heard.connection;
  stamp_ns_ = heard.pose.stamp_ns;
  taken_arrival_ns_ = heard.arrival_ns;
}

const msg::ToolForce& ToolLine::answer(const ToolOutput& output, std::int64_t now_ns, double dt_s,
                                       bool paused) noexcept {
  SafetyInput input = known(output, now_ns, dt_s);
  input.paused = paused;
  const SafeForce safe = pass(input);

  const HeardPose& heard = poses_.value();
  force_.tool = id_;
  force_.echo_seq = heard.pose.seq;
  force_.echo_stamp_ns = heard.pose.stamp_ns;
  force_.force = to_message(safe.wrench.force);
  force_.torque = to_message(safe.wrench.torque);
  force_.grip_torque = safe.wrench.grip_torque;
  force_.valid_for_s = stale_after(heard.interval_s, limits_);
  force_.state = safe.state;
  return force_;
}

SafetyInput ToolLine::known(const ToolOutput& output, std::int64_t now_ns, double dt_s) const noexcept {
  const HeardPose& heard = poses_.value();
  const ToolFrame frame = frame_of(heard.pose);
  SafetyInput input;
  input.model = {output.force, output.torque, output.grip_torque};
  input.stored_j = output.stored_j;
  input.tip = frame.p_WT;
  input.orientation = frame.q_WT;
  input.grip = opening_of(heard.pose);
  input.pose_age_s = 1e-9 * static_cast<double>(now_ns - heard.arrival_ns);
  input.pose_interval_s = heard.interval_s;
  input.way_s = way_s_;
  input.dt_s = dt_s;
  input.engaged = engaged_;
  input.reconnected = reconnected_;
  input.written = written_;
  return input;
}

// Through the exit; what changed for the worse is a fault, once for each time.
SafeForce ToolLine::pass(const SafetyInput& input) noexcept {
  const bool faulted_before = safety_.faulted();
  SafeForce safe = safety_.pass(input);
  written_ = false;
  if (safety_.faulted() && !faulted_before) faults_.raise(force_fault_);
  if (safety_.share() < kCutShare && !fed_) faults_.raise(source_fault_);
  fed_ = safety_.share() < kCutShare || (fed_ && safety_.share() < 1);
  return safe;
}

const msg::ToolForce& ToolLine::to_send(std::uint64_t tick) noexcept {
  ++force_.seq;
  force_.tick = tick;
  return force_;
}

void ToolLine::restart() noexcept {
  safety_.restart();
  lead_.restart();
}

msg::Echo ToolLine::echo() const noexcept {
  const HeardPose& heard = poses_.value();
  return {.tool = id_, .seq = heard.pose.seq, .stamp_ns = heard.pose.stamp_ns};
}

}  // namespace omentum::haptic
