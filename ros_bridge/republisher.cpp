#include "ros_bridge/republisher.h"

#include "node_common/node_identity.h"

#include <algorithm>
#include <mutex>
#include <utility>
#include <vector>

namespace omentum::ros {
namespace {

constexpr auto kFresh_ns = static_cast<std::int64_t>(1e9 * kFresh_s);
constexpr std::int64_t kCopyAfter_ns = 200'000'000;  // as omentum_session does
constexpr std::size_t kMostCommands = 8;             // that wait for the next tick; people give no more

}  // namespace

struct Republisher::Tool {
  std::unique_ptr<Publisher<PoseStamped>> pose;
  std::unique_ptr<Publisher<CartesianState>> state;
  std::unique_ptr<Publisher<WrenchStamped>> force;
  std::unique_ptr<Publisher<OperatingState>> operating;
  std::optional<Operating> told;
  bool told_homed = false;
  std::mutex mutex;  // guards asked, which comes on a vendor's thread
  std::vector<std::string> asked;
  std::unique_ptr<Subscription> commands;  // last: its callback uses what is above
};

Republisher::Republisher(RepublisherOptions options, transport::Bus& bus, RosPort& port,
                         const runtime::Clock& clock)
    : options_(std::move(options)),
      port_(port),
      clock_(clock),
      orders_(clock.now_ns()),
      sender_(node::introduce(msg::NODE_LAUNCHER, 0).instance),
      commands_(options_.obeys ? bus.writer<msg::SessionCommand>() : nullptr),
      poses_(bus, {}, [&clock] { return clock.now_ns(); }),
      forces_(bus, {}, [&clock] { return clock.now_ns(); }),
      statuses_(bus.reader<msg::NodeStatus>(
          [this](const msg::NodeStatus& status) { orders_.hear(status, clock_.now_ns()); })) {}

Republisher::~Republisher() = default;

bool Republisher::has_tools() const {
  return std::ranges::any_of(tools_, [](const auto& tool) { return tool != nullptr; });
}

std::unique_ptr<Republisher::Tool> Republisher::begin(std::uint32_t id) {
  const std::string space = "rt/" + options_.names[id] + "/";
  auto tool = std::make_unique<Tool>();
  tool->pose = port_.publisher<PoseStamped>({space + "measured_cp"});
  tool->state = port_.publisher<CartesianState>({space + "measured_cs"});
  tool->force = port_.publisher<WrenchStamped>({space + "spatial/servo_cf"});
  tool->operating = port_.publisher<OperatingState>({space + "operating_state", true});
  if (!options_.obeys) return tool;
  tool->commands = port_.subscription<StringStamped>(
      {space + "state_command"}, [&asked = tool->asked, &mutex = tool->mutex](const StringStamped& command) {
        const std::lock_guard lock(mutex);
        if (command.string_ && asked.size() < kMostCommands) asked.emplace_back(command.string_);
      });
  return tool;
}

void Republisher::tick(std::int64_t wall_ns) {
  for (std::uint32_t id = 0; id < tools_.size(); ++id) {
    const ToolNow tool = now(id, wall_ns);
    if (!tools_[id] && !tool.pose && !tool.force) continue;
    if (!tools_[id]) tools_[id] = begin(id);
    publish(*tools_[id], tool, wall_ns);
    obey(*tools_[id]);
  }
  send_copy();
}

ToolNow Republisher::now(std::uint32_t id, std::int64_t wall_ns) {
  const std::int64_t now_ns = clock_.now_ns();
  ToolNow tool;
  if (poses_.load(id, pose_) && pose_.age_ns(now_ns) <= kFresh_ns) {
    tool.pose = &pose_.sample;
    tool.pose_ns = wall_ns - pose_.age_ns(now_ns);
  }
  if (forces_.load(id, force_) && force_.age_ns(now_ns) <= kFresh_ns) {
    tool.force = &force_.sample;
    tool.force_ns = wall_ns - force_.age_ns(now_ns);
  }
  return tool;
}

void Republisher::publish(Tool& tool, const ToolNow& now, std::int64_t wall_ns) {
  const auto count = [this](bool sent) { refused_ += sent ? 0 : 1; };
  count(tool.pose->publish(measured_cp(now, options_.frame)));
  count(tool.state->publish(measured_cs(now, options_.frame)));
  count(tool.force->publish(servo_cf(now, options_.frame)));
  const Operating state = operating(now);
  const bool homed = now.pose != nullptr && now.pose->valid;
  if (tool.told == state && tool.told_homed == homed) return;
  const bool sent = tool.operating->publish(operating_state(state, homed, wall_ns, options_.frame));
  count(sent);
  if (!sent) return;
  tool.told = state;
  tool.told_homed = homed;
}

void Republisher::obey(Tool& tool) {
  std::vector<std::string> asked;
  {
    const std::lock_guard lock(tool.mutex);
    asked.swap(tool.asked);
  }
  for (const std::string& words : asked) {
    const auto command = command_of(words, tool.told.value_or(Operating::kDisabled));
    if (!command) continue;
    copy_ = orders_.issue(*command, sender_);
    copy_due_ns_ = clock_.now_ns() + kCopyAfter_ns;
    if (!commands_->write(*copy_)) ++refused_;
  }
}

void Republisher::send_copy() {
  if (!copy_ || clock_.now_ns() < copy_due_ns_) return;
  if (!commands_->write(*copy_)) ++refused_;
  copy_.reset();
}

}  // namespace omentum::ros
