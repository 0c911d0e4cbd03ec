// Writes the local models that organs offer around the tools, on a thread of its own: neither the organs'
// states nor the wire delay them.
#pragma once

#include "deform_node/local_model_message.h"
#include "deform_node/served_organ.h"
#include "deform_node/tool_places.h"
#include "runtime/mailbox.h"
#include "runtime/woken_thread.h"
#include "transport/bus.h"

#include <memory>
#include <vector>

namespace omentum::deform {

/// Whether any of them offers some.
bool offers_local_models(const std::vector<ServedOrgan>& organs);

/// Publishes the newest local model of each organ and tool. Destruction writes what is left.
class LocalPublisher {
 public:
  /// Writer and organs outlive this. `start`: how the publishing thread is made. Throws std::runtime_error
  /// where a model offers patches of more than `most_nodes` (transport::local_model_nodes).
  LocalPublisher(transport::Writer<msg::LocalModel>& writer, const std::vector<ServedOrgan>& organs,
                 std::size_t most_nodes, const runtime::StartWork& start);

  /// The loop's thread, after a step: what the organs offer around the tools. `echoes`: the newest poses in
  /// that step. Neither waits nor allocates.
  void offer(std::span<const ToolPlace> tools, std::span<const msg::Echo> echoes,
             std::int64_t now_ns) noexcept;

 private:
  struct Box {
    explicit Box(const StampedPatch& room) : newest(room) {}
    std::uint64_t seq = 0;  // the loop's
    runtime::Mailbox<StampedPatch> newest;
  };
  bool offer(std::size_t organ, const ToolPlace& tool, std::span<const msg::Echo> echoes,
             std::int64_t now_ns) noexcept;
  void write_newest();

  transport::Writer<msg::LocalModel>& writer_;
  const std::vector<ServedOrgan>& organs_;
  std::vector<std::vector<std::unique_ptr<Box>>> boxes_;  // per organ and tool; none for an organ without
  msg::LocalModel message_;                               // the publishing thread's
  std::unique_ptr<runtime::WokenWork> writing_;           // last: it uses what is above
};

}  // namespace omentum::deform
