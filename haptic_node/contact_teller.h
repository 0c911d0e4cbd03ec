// Tells organs and pictures what the tools do, slower than the hand's loop.
#pragma once

#include "haptic_node/contact_message.h"
#include "haptic_node/cutting_edge.h"
#include "transport/bus.h"

#include <vector>

namespace omentum::haptic {

/// What the loop knows of one tool beside the step.
struct ToolNews {
  bool served = false;   // this node answers for it
  bool pressed = false;  // the button under which it cuts
  ToolFrame measured{};  // of `cause`
  msg::Echo cause{};
};

/// Writes a Contact for each tool and organ that meet, 250 times a second, and at once when a touch, a grasp
/// or a cut begins or ends. An edge that cuts is told to every organ: it need not touch what it goes through.
/// One thread; allocates after construction nothing.
class ContactTeller {
 public:
  /// All but the ids outlive this. `tool_ids`: [tools].
  ContactTeller(const HapticModel& model, std::span<const std::uint32_t> tool_ids, const HapticState& state,
                Bodies& bodies);

  /// After each step. `news`, `outputs`: [tools].
  void tell(std::uint64_t tick, std::int64_t now_ns, std::span<const ToolNews> news,
            std::span<const ToolOutput> outputs, transport::Writer<msg::Contact>& writer) noexcept;

 private:
  // what a tool does to an organ, and whether the organ was told
  struct TouchedOrgan {
    msg::Contact message;
    bool now = false, told = false;
    std::int64_t told_until_ns = 0;
  };

  bool look(std::span<const ToolNews> news, std::span<const ToolOutput> outputs) noexcept;
  bool is_due(TouchedOrgan& touched, bool always, std::int64_t now_ns) noexcept;

  const HapticModel& model_;
  std::size_t organs_;
  const HapticState& state_;
  Bodies& bodies_;
  std::vector<CuttingEdge> edges_;      // [tools]
  std::vector<TouchedOrgan> contacts_;  // [tools][organs]
  std::vector<bool> grasped_;           // [tools] at the last publication
  std::int64_t due_ns_ = 0;
};

}  // namespace omentum::haptic
