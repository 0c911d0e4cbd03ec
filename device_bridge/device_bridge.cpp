#include "device_bridge/device_bridge.h"

#include "files/console.h"
#include "node_common/link_write.h"
#include "node_common/node_identity.h"
#include "node_common/rivals.h"
#include "runtime/report.h"

#include <chrono>
#include <utility>

namespace omentum::device {
namespace {

constexpr std::chrono::milliseconds kStatusPause{500};
constexpr auto kSettled_ns = static_cast<std::int64_t>(1e9 * node::kSettled_s);
constexpr double kRecordPeriod_s = 0.4;  // a fresh loop record is ready for each status

}  // namespace

DeviceBridge::DeviceBridge(const BridgeOptions& options, std::vector<std::unique_ptr<Device>> devices,
                           const transport::OpenBus& open_bus, runtime::Pace& loop)
    : options_(options),
      loop_(loop),
      start_ns_(loop.now_ns()),
      answers_(start_ns_),
      orders_(start_ns_),
      refusal_(loop),
      status_message_(node::introduce(msg::NODE_DEVICE, options.rate_hz)) {
  const runtime::NodeOptions& node = options.node;
  if (!node.log.empty()) log_ = std::make_unique<runtime::LoopLog>(node.log);
  if (log_) loop_.log_to(*log_);
  if (!options.record.empty()) record_ = std::make_unique<TraceLog>(options.record);
  for (auto& device : devices) {
    const auto mapping = options.mappings.find(device->info().tool);
    channels_.push_back(std::make_unique<ToolChannel>(
        std::move(device), faults_, mapping == options.mappings.end() ? MappingSpec{} : mapping->second));
    answers_.serve(channels_.back()->tool());
    status_message_.tools_served |= 1U << channels_.back()->tool();
  }
  connect(open_bus);
  status_ = loop_.beside(kStatusPause, [this] { publish_status(); });
}

DeviceBridge::~DeviceBridge() = default;

void DeviceBridge::connect(const transport::OpenBus& open_bus) {
  const runtime::RealtimeStart start(runtime::kHandLinkPriority);
  bus_ = open_bus();
  info_writer_ = bus_->writer<msg::DeviceInfo>();
  pose_writer_ = bus_->writer<msg::ToolPose>();
  status_writer_ = bus_->writer<msg::NodeStatus>();
  force_reader_ = bus_->reader<msg::ToolForce>([this](const msg::ToolForce& answer) { receive(answer); });
  status_reader_ = bus_->reader<msg::NodeStatus>([this](const msg::NodeStatus& status) {
    answers_.add(status, loop_.now_ns());
    orders_.hear(status, loop_.now_ns());
  });
  command_reader_ = bus_->reader<msg::SessionCommand>(
      [this](const msg::SessionCommand& command) { orders_.hear(command, loop_.now_ns()); });
  if (options_.scene)
    scene_reader_ = bus_->reader<msg::SceneInfo>([this](const msg::SceneInfo& other) { hear(other); });
  if (options_.rays)
    ray_reader_ = bus_->reader<msg::PointerRay>(
        [this](const msg::PointerRay& ray) { options_.rays->take(ray, loop_.now_ns()); });
  for (const auto& channel : channels_) info_writer_->write(channel->info());
}

void DeviceBridge::run() {
  realtime_ = runtime::request_realtime(runtime::kHandLoopPriority);
  if (!realtime_.warning.empty()) files::say("virtual_device: " + realtime_.warning);
  const std::int64_t begin_ns = loop_.now_ns();
  std::int64_t recorded_ns = begin_ns;

  while (loop_.wait() != runtime::Pace::Cause::kStopped) {
    const std::int64_t now_ns = loop_.now_ns();
    obey();
    for (const auto& channel : channels_) exchange(*channel);
    loop_.finish_tick();

    if (1e-9 * static_cast<double>(now_ns - recorded_ns) >= kRecordPeriod_s) {
      status_record_.post(loop_.record());
      recorded_ns = now_ns;
    }
    if (options_.seconds > 0 && 1e-9 * static_cast<double>(now_ns - begin_ns) >= options_.seconds) break;
  }
  // haptic_node notices by the age of the last poses
  for (const auto& channel : channels_) channel->release();
  refusal_.throw_if_any();
}

void DeviceBridge::exchange(ToolChannel& channel) noexcept {
  const msg::ToolPose& pose = channel.tick(loop_.now_ns());
  if (!pose_writer_->write(pose)) faults_.raise("a pose could not be sent");
  if (record_) record_->push(pose);
}

void DeviceBridge::obey() noexcept {
  const bool restart = orders_.take_reset();
  for (const auto& channel : channels_) {
    channel->device().pause(orders_.paused());
    if (restart) channel->device().restart();
  }
}

void DeviceBridge::receive(const msg::ToolForce& answer) noexcept {
  const std::int64_t now_ns = loop_.now_ns();
  for (const auto& channel : channels_) {
    if (channel->tool() != answer.tool) continue;
    const AnswerVerdict verdict = channel->receive(answer, now_ns);
    // a late one is not exerted, but how late it was is worth knowing
    if (verdict == AnswerVerdict::kAccepted || verdict == AnswerVerdict::kLate) answers_.add(answer, now_ns);
  }
}

void DeviceBridge::hear(const msg::SceneInfo& other) {
  auto why = node::contradicts(*options_.scene, other);
  if (!why) return;
  if (loop_.now_ns() - start_ns_ > kSettled_ns) {
    faults_.raise(node::kForeignScene);
  } else {
    refusal_.because(*std::move(why));
  }
}

void DeviceBridge::publish_status() {
  status_record_.fetch();
  orders_.tell(status_message_);
  node::fill_status(status_record_.value(), faults_, status_message_);
  status_message_.round_trip_us = node::to_message(answers_.report().to_force);
  node::write_as_link(*status_writer_, status_message_);
}

void DeviceBridge::require_written() {
  if (log_) log_->finish();
  if (record_) record_->finish();
}

nlohmann::json DeviceBridge::report() const {
  const AnswerReport answers = answers_.report();
  AnswerCounts counts;
  std::uint64_t sent = 0, expired = 0;
  double energy_j = 0;
  nlohmann::json hands = nlohmann::json::array();
  for (const auto& channel : channels_) {
    counts += channel->answers();
    sent += channel->sent();
    expired += channel->expired();
    energy_j += channel->energy_j();
    nlohmann::json hand = channel->device().report();
    hand.update({{"tool", channel->tool()},
                 {"energy_j", channel->energy_j()},
                 {"most_energy_j", channel->most_energy_j()},
                 {"held_back", channel->held_back()}});
    hands.push_back(hand);
  }
  const nlohmann::json round_trip = to_json(answers.to_force);
  return {{"dds", options_.node.dds},
          {"loop", to_json(loop_.record(), options_.rate_hz)},
          {"realtime", {{"fifo", realtime_.fifo}, {"locked", realtime_.locked}}},
          {"round_trip_us", round_trip},
          {"sent", sent},
          {"answers", counts.accepted},
          {"lost", counts.lost},
          {"unanswered", answers.unanswered},
          {"refused", {{"repeated", counts.repeated}, {"foreign", counts.foreign}, {"late", counts.late}}},
          {"expired", expired},
          {"energy_j", energy_j},
          {"hands", hands},
          {"faults", faults_.lines()},
          {"link",
           {{"tool_to_force_us", round_trip},
            {"tool_to_organ_us", to_json(answers.to_organ)},
            {"tool_to_picture_us", to_json(answers.to_picture)}}}};
}

}  // namespace omentum::device
