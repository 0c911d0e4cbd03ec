// device_check: does a device's bridge do what docs/devices.md asks of it? Stands in haptic_node's place,
// answers its poses, and says of each requirement whether it is met.
#include "node_common/node_identity.h"
#include "runtime/clock.h"
#include "runtime/command_line.h"
#include "runtime/report.h"
#include "runtime/signals.h"
#include "session_tools/answer_trial.h"
#include "session_tools/pose_record.h"
#include "transport/bus.h"
#include "transport/refused_writers.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <mutex>
#include <stdexcept>
#include <thread>

namespace {

using namespace omentum;
using session::Verdict;

/// A process that leaves says so; one that was killed is missed only when its lease is over (2 s and more).
constexpr double kLeavesWithin_s = 1;
/// Of the hand's force: enough to be exerted, too little to hurt.
constexpr double kMostForce_n = 2;

struct Options {
  transport::BusOptions bus;
  int tool = 0;
  session::TrialTimes times;
  double patience_s = 30;  // for the first pose, and for the bridge's end
  bool stays = false;
  std::filesystem::path report;
};

/// One bridge, from its first pose until it left.
class Check {
 public:
  explicit Check(const Options& options)
      : tool_(static_cast<std::uint32_t>(options.tool)),
        trial_(options.times),
        bus_(transport::Bus::open(options.bus)),
        forces_(bus_->writer<msg::ToolForce>()),
        infos_(bus_->reader<msg::DeviceInfo>(transport::ByWriter<msg::DeviceInfo>{
            [this](const msg::DeviceInfo& info, const transport::WriterId&) {
              const std::lock_guard lock(mutex_);
              if (info.tool == tool_) record_.take(info);
            },
            {},
            [this](transport::QosPolicy policy) { refuse<msg::DeviceInfo>("device_info", policy); }})),
        statuses_(bus_->reader<msg::NodeStatus>(
            [this](const msg::NodeStatus& status) { rival_ = rival_ || status.kind == msg::NODE_HAPTIC; })),
        poses_(bus_->reader<msg::ToolPose>(transport::ByWriter<msg::ToolPose>{
            [this](const msg::ToolPose& pose, const transport::WriterId& writer) { take(pose, writer); },
            [this](const transport::WriterId& writer) { miss(writer); },
            [this](transport::QosPolicy policy) { refuse<msg::ToolPose>("tool_pose", policy); }})) {}

  /// Throws std::runtime_error where somebody else answers.
  void require_alone() const {
    if (rival_)
      throw std::runtime_error(
          "a haptic_node answers in this domain, expected the bridge alone: end it, or give "
          "both another --domain");
    if (crowd_)
      throw std::runtime_error("two devices move tool " + std::to_string(tool_) +
                               " in this domain, expected one: end the other");
  }
  bool begun() const {
    const std::lock_guard lock(mutex_);
    return record_.poses() > 0;
  }
  /// Empty: what it writes is heard.
  std::vector<Verdict> refusals() const {
    const std::lock_guard lock(mutex_);
    return record_.refused() ? std::vector{record_.offered()} : std::vector<Verdict>{};
  }
  bool over() const {
    const std::lock_guard lock(mutex_);
    return trial_.over(runtime::steady_now_ns());
  }
  bool left() const {
    const std::lock_guard lock(mutex_);
    return gone_ns_ > 0;
  }
  std::vector<Verdict> verdicts() const {
    const std::lock_guard lock(mutex_);
    std::vector<Verdict> all = record_.verdicts();
    for (Verdict& one : trial_.verdicts(record_.median_gap_s())) all.push_back(std::move(one));
    all.push_back(leave());
    return all;
  }

 private:
  void take(const msg::ToolPose& pose, const transport::WriterId& writer) {
    if (pose.tool != tool_) return;
    const std::int64_t now_ns = runtime::steady_now_ns();
    std::vector<msg::ToolForce> answers;
    {
      const std::lock_guard lock(mutex_);
      crowd_ = crowd_ || (newest_ns_ > 0 && writer != writer_);
      writer_ = writer;
      if (!trial_.over(now_ns)) record_.take(pose, now_ns);
      newest_ns_ = now_ns;
      answers = trial_.take(pose, now_ns);
    }
    for (const msg::ToolForce& answer : answers) forces_->write(answer);
  }

  template <class M>
  void refuse(const char* topic, transport::QosPolicy policy) {
    const transport::TopicSpec spec = transport::requested(transport::kTopicSpec<M>, true);
    const std::lock_guard lock(mutex_);
    record_.refuse(topic, transport::what_to_offer(spec, policy));
  }

  void miss(const transport::WriterId& writer) {
    const std::lock_guard lock(mutex_);
    if (writer == writer_) gone_ns_ = runtime::steady_now_ns();
  }

  Verdict leave() const {
    const std::string requirement = "it leaves cleanly";
    if (gone_ns_ == 0) return session::unseen(requirement, "it is still there");
    const double after_s = 1e-9 * static_cast<double>(gone_ns_ - newest_ns_);
    return session::verdict(
        requirement, after_s <= kLeavesWithin_s,
        session::text("missed %.2f s after its last pose (expected at most %.0f; across vendors it takes 2)",
                      after_s, kLeavesWithin_s));
  }

  const std::uint32_t tool_;
  mutable std::mutex mutex_;
  session::PoseRecord record_;
  session::AnswerTrial trial_;
  transport::WriterId writer_{};
  std::int64_t newest_ns_ = 0, gone_ns_ = 0;
  std::atomic<bool> rival_{false}, crowd_{false};

  // declared last: callbacks end before what they touch
  std::unique_ptr<transport::Bus> bus_;
  std::unique_ptr<transport::Writer<msg::ToolForce>> forces_;
  std::unique_ptr<transport::Reader<msg::DeviceInfo>> infos_;
  std::unique_ptr<transport::Reader<msg::NodeStatus>> statuses_;
  std::unique_ptr<transport::Reader<msg::ToolPose>> poses_;
};

void say(const std::string& line) {
  std::puts(line.c_str());
  std::fflush(stdout);
}

const char* word(Verdict::Outcome outcome) {
  switch (outcome) {
    case Verdict::Outcome::kPassed:
      return "pass";
    case Verdict::Outcome::kFailed:
      return "FAIL";
    case Verdict::Outcome::kUnseen:
      break;
  }
  return "not seen";
}

void tell(const std::vector<Verdict>& verdicts) {
  for (const Verdict& one : verdicts)
    std::printf("%-9s %-54s %s\n", word(one.outcome), one.requirement.c_str(), one.detail.c_str());
  std::fflush(stdout);
}

nlohmann::json to_json(const std::vector<Verdict>& verdicts) {
  nlohmann::json list = nlohmann::json::array();
  for (const Verdict& one : verdicts)
    list.push_back(
        {{"requirement", one.requirement}, {"outcome", word(one.outcome)}, {"detail", one.detail}});
  return {{"requirements", list}};
}

template <class Condition>
bool wait_for(double patience_s, const std::atomic<bool>& stopped, Condition&& condition) {
  const std::int64_t begin_ns = runtime::steady_now_ns();
  while (!condition()) {
    if (stopped || 1e-9 * static_cast<double>(runtime::steady_now_ns() - begin_ns) > patience_s) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return true;
}

/// Whether none failed.
bool conclude(const std::vector<Verdict>& verdicts, const Options& options) {
  tell(verdicts);
  if (!options.report.empty()) runtime::write_report(to_json(verdicts), options.report);
  return std::none_of(verdicts.begin(), verdicts.end(),
                      [](const Verdict& one) { return one.outcome == Verdict::Outcome::kFailed; });
}

bool run(const Options& options) {
  std::atomic<bool> stopped{false};
  const runtime::StopSignal stop([&] { stopped = true; });
  Check check(options);
  say("device_check: waiting for poses of tool " + std::to_string(options.tool));
  const bool begun = wait_for(options.patience_s, stopped, [&] { return check.begun(); });
  if (const std::vector<Verdict> refusals = check.refusals(); !begun && !refusals.empty())
    return conclude(refusals, options);
  if (!begun)
    throw std::runtime_error("no pose of tool " + std::to_string(options.tool) +
                             " came; is the bridge in this domain, with this profile?");
  say("device_check: move and turn the tool; it then feels a small force upwards, let go of for half a "
      "second");
  wait_for(options.times.total_s() + options.patience_s, stopped, [&] {
    check.require_alone();
    return check.over() || check.left();
  });
  if (!options.stays && !stopped && !check.left()) {
    say("device_check: now end the bridge");
    wait_for(options.patience_s, stopped, [&] { return check.left(); });
  }
  return conclude(check.verdicts(), options);
}

}  // namespace

int main(int argc, char** argv) {
  runtime::CommandLine line(
      "device_check",
      "Tries a device's bridge from haptic_node's place and says of each requirement of docs/devices.md "
      "whether "
      "it is met. Start it and the bridge alone in a domain. Exit code 0: none failed; 1: some did.");
  Options options;
  runtime::LinkOptions link;
  runtime::add_link_options(line, link);
  line.option("--tool", options.tool, "the bridge's tool").between(0, 7).show_default();
  line.option("--listen", options.times.listening_s, "time to move and turn the tool, s")
      .between(0.5, 600.0)
      .show_default();
  line.option("--force", options.times.force_n, "what the hand feels, N")
      .between(0.0, kMostForce_n)
      .show_default();
  line.option("--patience", options.patience_s, "how long the first pose, and the end, are waited for, s")
      .between(1.0, 3600.0)
      .show_default();
  line.flag("--stays", options.stays, "do not wait for the bridge's end");
  line.option("--report", options.report, "also write the verdicts as JSON").type_name("FILE").writes_file();
  bool passed = false;
  const int code = line.run(argc, argv, [&] {
    // of a key store's roles it plays the one that writes forces
    options.bus = node::bus_options(link, link.keystore.empty() ? "device_check" : "haptic_node");
    passed = run(options);
  });
  return code != 0 ? code : passed ? 0 : 1;
}
