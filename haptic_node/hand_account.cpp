#include "haptic_node/hand_account.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace omentum::haptic {

void HandAccount::add(const msg::ToolForce& force, double pull_n, double limit_n) noexcept {
  force_max_n = std::max(force_max_n, std::hypot(force.force.x, force.force.y, force.force.z));
  grip_torque_max_nm = std::max(grip_torque_max_nm, std::abs(force.grip_torque));
  pull_max_n = std::max(pull_max_n, pull_n);
  const bool counted = ticks_beyond >= kLasting;
  const bool beyond = pull_n > (counted ? kEased * limit_n : limit_n);
  ticks_beyond = beyond ? std::min(ticks_beyond + 1, kLasting) : 0;
  if (ticks_beyond == kLasting && !counted) ++pulls_beyond_limit;
}

nlohmann::json to_json(std::uint32_t tool_id, const HandAccount& account, const ToolModel& model,
                       const ToolState& tool) {
  nlohmann::json told{{"tool", tool_id},
                      {"force_max_n", account.force_max_n},
                      {"pull_max_n", account.pull_max_n},
                      {"pulls_beyond_limit", account.pulls_beyond_limit}};
  if (!model.grasps) return told;
  told["grip_torque_max_nm"] = account.grip_torque_max_nm;
  told["grasps"] = {{"begun", tool.grasp_count},
                    {"empty", tool.grasps.empty},
                    {"torn", tool.grasps.torn},
                    {"lost", tool.grasps.lost}};
  return told;
}

}  // namespace omentum::haptic
