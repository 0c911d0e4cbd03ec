// What the tools' cutting edges swept, on its way from the receiving thread to the loop.
#pragma once

#include "deform_node/organ_models.h"
#include "runtime/mailbox.h"
#include "transport/messages.h"

#include <array>
#include <atomic>

namespace omentum::deform {

/// Strokes of one organ that wait for a tick: a quarter of a second of contacts at 250 Hz and both their
/// strokes. Who finds no room sweeps on with the next sample.
inline constexpr std::size_t kWaitingStrokes = 128;
/// What the loop takes of them in one tick, and beside them one of each edge that rests.
inline constexpr std::size_t kStrokesPerTick = kWaitingStrokes + msg::MAX_TOOLS;

/// An edge that goes on cutting was heard of this lately; between samples farther apart nothing was swept,
/// and a sender whose numbers begin again after as long is another one, s.
inline constexpr double kCutSilence_s = 0.1;

/// One organ's strokes. A sample that was lost loses no cut: what comes after it sweeps from the edge that
/// was known (idl/contact.idl). One that comes again, or late, sweeps nothing. take() and the loop's methods
/// may run at the same time on one thread each; neither waits or allocates.
class CutBook {
 public:
  /// Receiving thread. The contact's tool is below msg::MAX_TOOLS and its edges are finite.
  void take(const msg::Contact& contact, std::int64_t now_ns) noexcept;

  /// Loop: takes what arrived. An edge that cuts and was not moved is a stroke of no length, since what lies
  /// in it goes on burning.
  void advance(std::int64_t now_ns) noexcept;
  /// Loop: of the last advance(), each tool's in the order in which its edge went.
  std::span<const CutStroke> strokes() const noexcept { return {strokes_.data(), count_}; }
  /// Loop: nothing that was received up to `now_ns` cuts any more.
  void forget(std::int64_t now_ns) noexcept { forget_until_ns_ = now_ns; }

 private:
  using Edge = std::array<Vec3, 2>;

  // how far the receiving thread knows one tool's cut
  struct Line {
    std::int64_t heard_ns = 0;  // 0: never
    std::uint64_t seq = 0, cut = 0;
    bool cuts = false;
    Edge edge{};
  };
  struct Waiting {
    CutStroke stroke;
    std::int64_t received_ns = 0;
  };
  struct Level {
    bool cuts = false;
    std::uint64_t cut = 0;
    Edge edge{};
    std::int64_t received_ns = 0;
  };

  void sweep(const msg::Contact& contact, Line& line, std::int64_t now_ns) noexcept;
  bool push(const CutStroke& stroke, std::int64_t now_ns) noexcept;
  void take_waiting() noexcept;
  void add_resting(std::int64_t now_ns) noexcept;

  std::array<Line, msg::MAX_TOOLS> lines_{};  // receiving thread
  std::array<runtime::Mailbox<Level>, msg::MAX_TOOLS> levels_;

  // a ring: the receiving thread writes, the loop reads
  std::array<Waiting, kWaitingStrokes> ring_{};
  std::atomic<std::uint64_t> written_{0}, read_{0};

  // the loop's
  std::array<CutStroke, kStrokesPerTick> strokes_{};
  std::size_t count_ = 0;
  std::int64_t forget_until_ns_ = 0;
};

}  // namespace omentum::deform
