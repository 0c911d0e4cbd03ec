// What is known of pairs, for a step.
#pragma once

#include <bit>
#include <cstdint>
#include <utility>
#include <vector>

namespace omentum::physics {

/// A table by two numbers (open addressing) that forgets everything at once. Entries lie one behind the
/// other, in the order in which they came: what is taken over are those, not the table. No allocation after
/// construction.
template <class Value>
class PairMemory {
 public:
  struct Entry {
    std::int32_t segment = 0, part = 0;
    Value value;
  };

  /// Room for this many pairs; beyond, remember() says none.
  explicit PairMemory(std::size_t most)
      : entries_(most), slots_(std::bit_ceil(2 * most + 2)), shift_(64 - std::countr_zero(slots_.size())) {}

  void forget() noexcept {
    used_ = 0;
    if (++round_ != 0) return;
    for (Slot& slot : slots_) slot.round = 0;
    round_ = 1;
  }
  /// The pair's entry, and whether it is new (its value is then to be filled in); none when full.
  std::pair<Entry*, bool> remember(std::int32_t segment, std::int32_t part) noexcept {
    Slot& slot = slots_[slot_of(segment, part)];
    if (slot.round == round_) return {&entries_[slot.entry], false};
    if (used_ == entries_.size()) return {nullptr, false};
    slot = {round_, static_cast<std::uint32_t>(used_)};
    entries_[used_] = {segment, part, {}};
    return {&entries_[used_++], true};
  }
  /// All that another one of the same room knows, each value as `changed` makes it.
  template <class Change>
  void take_over(const PairMemory& other, Change changed) noexcept {
    forget();
    for (std::size_t i = 0; i < other.used_; ++i) {
      const Entry& entry = other.entries_[i];
      const auto [own, is_new] = remember(entry.segment, entry.part);
      if (is_new) own->value = changed(entry.value);
    }
  }
  /// The pair's value; none where it is not remembered.
  const Value* find(std::int32_t segment, std::int32_t part) const noexcept {
    const Slot& slot = slots_[slot_of(segment, part)];
    return slot.round == round_ ? &entries_[slot.entry].value : nullptr;
  }

 private:
  struct Slot {
    std::uint32_t round = 0;  // the slot is empty in all others
    std::uint32_t entry = 0;
  };
  std::size_t used_ = 0;
  std::vector<Entry> entries_;
  std::vector<Slot> slots_;
  int shift_;
  std::uint32_t round_ = 1;

  // The pair's, or the empty one where it belongs.
  std::size_t slot_of(std::int32_t segment, std::int32_t part) const noexcept {
    std::size_t at = home(segment, part);
    for (; slots_[at].round == round_; at = (at + 1) & (slots_.size() - 1)) {
      const Entry& entry = entries_[slots_[at].entry];
      if (entry.segment == segment && entry.part == part) break;
    }
    return at;
  }
  // Fibonacci hashing: the upper bits of a product with 2^64 over the golden ratio.
  std::size_t home(std::int32_t segment, std::int32_t part) const noexcept {
    const auto key = static_cast<std::uint64_t>(segment) << 32 | static_cast<std::uint32_t>(part);
    return static_cast<std::size_t>(key * 0x9E3779B97F4A7C15U >> shift_);
  }
};

}  // namespace omentum::physics
