// When each pose came, so that answers to it can be timed on this process' own clock.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <optional>

namespace omentum::render {

/// The last kKept poses of one tool. One thread adds, any asks; nobody waits.
class PoseArrivals {
 public:
  static constexpr std::size_t kKept = 2048;  // two seconds at 1 kHz

  void add(std::uint64_t seq, std::int64_t arrived_ns) noexcept {
    Slot& slot = slots_[seq % kKept];
    slot.seq.store(kNone, std::memory_order_release);
    slot.arrived_ns.store(arrived_ns, std::memory_order_release);
    slot.seq.store(seq, std::memory_order_release);
  }
  /// Nothing when that pose did not come, is too old, or is being overwritten.
  std::optional<std::int64_t> find(std::uint64_t seq) const noexcept {
    const Slot& slot = slots_[seq % kKept];
    if (slot.seq.load(std::memory_order_acquire) != seq) return std::nullopt;
    const std::int64_t arrived_ns = slot.arrived_ns.load(std::memory_order_acquire);
    if (slot.seq.load(std::memory_order_acquire) != seq) return std::nullopt;
    return arrived_ns;
  }

 private:
  static constexpr std::uint64_t kNone = ~std::uint64_t{0};
  struct Slot {
    std::atomic<std::uint64_t> seq{kNone};
    std::atomic<std::int64_t> arrived_ns{0};
  };
  std::array<Slot, kKept> slots_;
};

}  // namespace omentum::render
