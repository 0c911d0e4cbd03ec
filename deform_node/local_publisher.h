// Writes the local models that organs offer around the tools, on a thread of its own: neither the organs'
// states nor the wire delay them.
#pragma once

#include "deform_node/contact_book.h"
#include "deform_node/local_model_message.h"
#include "deform_node/served_organ.h"
#include "runtime/mailbox.h"
#include "runtime/woken_thread.h"
#include "transport/bus.h"

#include <memory>
#include <vector>

namespace omentum::deform {

/// Whether any of them offers some.
bool offers_local_models(const std::vector<ServedOrgan>& organs);

/// Around each tool that touches an organ, this far, m: what a hand crosses at 0.5 m/s within the 20 ms that
/// a local model may be late, and the tip's own size.
inline constexpr double kPatchRadiusM = 0.015;

/// Publishes the newest local model of each organ and tool. Destruction writes what is left.
class LocalPublisher {
 public:
  /// Both outlive this.
  LocalPublisher(transport::Writer<msg::LocalModel>& writer, const std::vector<ServedOrgan>& organs);

  /// The loop's thread, after a step; `book` as it was for that. Neither waits nor allocates.
  void offer(ContactBook& book, std::int64_t now_ns) noexcept;

 private:
  struct Box {
    explicit Box(const StampedPatch& room) : newest(room) {}
    std::uint64_t seq = 0;  // the loop's
    runtime::Mailbox<StampedPatch> newest;
  };
  bool offer(std::size_t organ, const ToolLoad& load, ContactBook& book, std::int64_t now_ns) noexcept;
  void write_newest();

  transport::Writer<msg::LocalModel>& writer_;
  const std::vector<ServedOrgan>& organs_;
  std::vector<std::vector<std::unique_ptr<Box>>> boxes_;  // per organ and tool; none for an organ without
  msg::LocalModel message_;                               // the publishing thread's
  runtime::WokenThread thread_;                           // last: it uses what is above
};

}  // namespace omentum::deform
