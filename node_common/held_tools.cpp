#include "node_common/held_tools.h"

#include "node_common/pose_form.h"

namespace omentum::node {

HeldTools::HeldTools(transport::Bus& bus, const scene::Scene& scene) {
  bool any = false;
  for (const scene::ToolSpec& tool : scene.tools) {
    if (tool.device.empty() || tool.id >= tools_.size()) continue;
    tools_[tool.id] = std::make_unique<Tool>(tool.device, hand_over_ns(scene.haptics.decay_s));
    any = true;
  }
  if (!any) return;
  infos_ = bus.reader<msg::DeviceInfo>(transport::ByWriter<msg::DeviceInfo>{
      [this](const msg::DeviceInfo& info, const transport::WriterId& writer) {
        if (info.tool >= tools_.size() || !tools_[info.tool]) return;
        Tool& tool = *tools_[info.tool];
        tool.names.hear(info, writer);
        tool.known.post(tool.names.known());
      },
      [this](const transport::WriterId& writer) {
        for (const auto& tool : tools_) {
          if (!tool) continue;
          tool->names.gone(writer);
          tool->known.post(tool->names.known());
        }
      }});
  answers_ = bus.reader<msg::ToolForce>([this](const msg::ToolForce& answer) {
    if (answer.tool >= tools_.size() || !tools_[answer.tool]) return;
    tools_[answer.tool]->answers.post({answer.tool, answer.echo_seq, answer.echo_stamp_ns});
  });
}

transport::LatestByTool<msg::ToolPose>::Admits HeldTools::admits() {
  if (!infos_) return {};
  return [this](const msg::ToolPose& pose, const transport::WriterId& writer, std::int64_t now_ns) {
    return admits(pose, writer, now_ns);
  };
}

transport::Admission HeldTools::admits(const msg::ToolPose& pose, const transport::WriterId& writer,
                                       std::int64_t now_ns) noexcept {
  using transport::Admission;
  if (pose.tool >= tools_.size() || !tools_[pose.tool]) return Admission::kContinues;
  Tool& tool = *tools_[pose.tool];
  const transport::ParticipantId who = transport::participant_of(writer);
  // one that is none by itself takes nobody's tool
  if (form_of(pose) != PoseForm::kWell)
    return !tool.holder.holder() || tool.holder.holder() == who ? Admission::kContinues : Admission::kRefused;
  tool.known.fetch();
  if (tool.answers.fetch()) tool.holder.answered(tool.answers.value(), now_ns, tool.known.value());
  const PoseRight right = tool.holder.judge(who, pose, now_ns, tool.known.value());
  if (right != PoseRight::kHolds && right != PoseRight::kTakes) return Admission::kRefused;
  // one that is sent again was not measured anew
  if (right == PoseRight::kTakes || pose.stamp_ns != tool.stamp_ns) tool.holder.heard(now_ns);
  tool.stamp_ns = pose.stamp_ns;
  return right == PoseRight::kTakes ? Admission::kBegins : Admission::kContinues;
}

}  // namespace omentum::node
