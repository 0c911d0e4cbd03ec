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

/// Where an organ begins anew its tissue comes back, maybe around a tool that stood where it was cut. For so
/// long hands are told that there is nothing, s: several samples, since each may be lost or overtaken, so
/// that none of them takes what comes then for what they touched before.
inline constexpr double kUnfelt_s = 0.1;

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
  /// that step. Of an organ that begins anew: nothing, for kUnfelt_s. Neither waits nor allocates.
  void offer(std::span<const ToolPlace> tools, std::span<const msg::Echo> echoes,
             std::int64_t now_ns) noexcept;

 private:
  struct Box {
    explicit Box(const StampedPatch& room) : newest(room) {}
    std::uint64_t seq = 0;  // the loop's
    runtime::Mailbox<StampedPatch> newest;
  };
  // None of an organ that offers none.
  struct OfOrgan {
    std::vector<std::unique_ptr<Box>> boxes{};  // [tools]
    std::uint64_t begun_anew = 0;               // the loop's, as is
    std::int64_t felt_from_ns = 0;
  };
  bool is_felt(std::size_t organ, std::int64_t now_ns) noexcept;
  bool fill(std::size_t organ, const ToolPlace& tool, std::int64_t now_ns, LocalPatch& patch) noexcept;
  bool offer(std::size_t organ, const ToolPlace& tool, std::span<const msg::Echo> echoes,
             std::int64_t now_ns) noexcept;
  void write_newest();

  transport::Writer<msg::LocalModel>& writer_;
  const std::vector<ServedOrgan>& organs_;
  std::vector<OfOrgan> offered_;                 // [organs]
  msg::LocalModel message_;                      // the publishing thread's
  std::unique_ptr<runtime::WokenWork> writing_;  // last: it uses what is above
};

}  // namespace omentum::deform
