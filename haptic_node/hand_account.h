// What a hand felt and did in a session, for its report and the trainee's score (docs/score.md).
#pragma once

#include "haptic_node/haptic_model.h"
#include "transport/messages.h"

#include <nlohmann/json_fwd.hpp>

namespace omentum::haptic {

/// One tool's.
struct HandAccount {
  double force_max_n = 0, pull_max_n = 0, grip_torque_max_nm = 0;
  std::uint64_t pulls_beyond_limit = 0;
  int ticks_beyond = 0;  // in a row, until it eases off

  /// Every tick: the force as it leaves, and how hard the tissue between the jaws is pulled, N. A pull counts
  /// once it has lasted for kLasting ticks, and again only after it has eased off to kEased of the limit.
  void add(const msg::ToolForce& force, double pull_n, double limit_n) noexcept;

  /// A pull that trembles at the limit is one.
  static constexpr double kEased = 0.8;
  /// As long as it takes tissue to slip: one tick alone is a step between two models.
  static constexpr int kLasting = 10;
};

/// {"tool", "force_max_n", "pull_max_n", "pulls_beyond_limit"}; of a tool with jaws also "grip_torque_max_nm"
/// and "grasps" {"begun", "empty", "torn", "lost"}.
nlohmann::json to_json(std::uint32_t tool_id, const HandAccount& account, const ToolModel& model,
                       const ToolState& tool);

}  // namespace omentum::haptic
