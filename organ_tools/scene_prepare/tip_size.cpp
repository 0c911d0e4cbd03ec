#include "organ_tools/scene_prepare/tip_size.h"

#include "organ/plausibility.h"

#include <algorithm>
#include <cmath>

namespace omentum::scene_prepare {

double tip_size(const scene::ToolSpec& tool) {
  double widest = 2 * tool.shaft_radius_m;
  for (const scene::Vec3& a : tool.points) {
    for (const scene::Vec3& b : tool.points)
      widest = std::max(widest, std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]));
  }
  return widest;
}

std::vector<std::string> smaller_than_tips(const organ::Organ& organ, const scene::Scene& scene) {
  const double length = organ::longest_side(organ.mesh);
  std::vector<std::string> found;
  for (const scene::ToolSpec& tool : scene.tools) {
    const double tip = tip_size(tool);
    if (length >= tip) continue;
    found.push_back("the organ is " + organ::length_text(length) + " long, smaller than the tip of tool " +
                    std::to_string(tool.id) + " (" + organ::length_text(tip) + ")");
  }
  return found;
}

}  // namespace omentum::scene_prepare
