// Where the tools are, for the small models that are made around them.
#pragma once

#include "deform_node/local_patch.h"
#include "node_common/held_tools.h"
#include "scene/scene.h"
#include "transport/latest.h"

#include <span>

namespace omentum::deform {

/// Around a tool's tip, this far, m: what a hand crosses at 0.5 m/s within the 20 ms that a local model may
/// be late, and the tip's own size.
inline constexpr double kPatchRadius_m = 0.015;
/// A tool whose pose is older is gone, or nobody holds it, s.
inline constexpr double kToolGone_s = 0.1;

struct ToolPlace {
  std::uint32_t tool = 0;
  PatchPlace around;
};

/// Hears the poses of the scene's tools. A tool is there before it touches: the hand needs a local model to
/// meet what it does not touch yet.
class ToolPlaces {
 public:
  ToolPlaces(transport::Bus& bus, const scene::Scene& scene, std::function<std::int64_t()> clock);

  /// The tools that are there, valid until the next call. The loop's thread; neither waits nor allocates.
  std::span<const ToolPlace> find(std::int64_t now_ns) noexcept;

 private:
  std::vector<std::uint32_t> tools_;  // of the scene
  std::array<ToolPlace, msg::MAX_TOOLS> places_{};
  node::HeldTools held_;
  transport::LatestByTool<msg::ToolPose> poses_;
};

}  // namespace omentum::deform
