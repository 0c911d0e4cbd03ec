#include "deform_node/tool_places.h"

#include "node_common/vectors.h"

namespace omentum::deform {

namespace {

constexpr auto kToolGone_ns = static_cast<std::int64_t>(1e9 * kToolGone_s);

}  // namespace

ToolPlaces::ToolPlaces(transport::Bus& bus, const scene::Scene& scene, std::function<std::int64_t()> clock)
    : held_(bus, scene), poses_(bus, {}, std::move(clock), held_.admits()) {
  for (const scene::ToolSpec& tool : scene.tools)
    if (tool.id < msg::MAX_TOOLS && !tool.scope) tools_.push_back(tool.id);
}

std::span<const ToolPlace> ToolPlaces::find(std::int64_t now_ns) noexcept {
  std::size_t count = 0;
  transport::Arrived<msg::ToolPose> pose;
  for (const std::uint32_t tool : tools_) {
    if (!poses_.load(tool, pose) || !pose.sample.valid || pose.age_ns(now_ns) > kToolGone_ns) continue;
    const geometry::Vec3 tip = node::to_vector(pose.sample.position);
    if (tip.allFinite()) places_[count++] = {tool, {tool, tip, kPatchRadius_m}};
  }
  return {places_.data(), count};
}

}  // namespace omentum::deform
