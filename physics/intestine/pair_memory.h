// What is known of pairs, for a step.
#pragma once

#include <bit>
#include <cstdint>
#include <utility>
#include <vector>

namespace omentum::physics {

/// A table by two numbers (open addressing) that forgets everything at once. No allocation after
/// construction.
template <class Value>
class PairMemory {
 public:
  /// Room for this many pairs; beyond, remember() says none.
  explicit PairMemory(std::size_t most)
      : most_(most), entries_(std::bit_ceil(2 * most + 2)), shift_(64 - std::countr_zero(entries_.size())) {}

  struct Entry {
    std::uint32_t round = 0;  // the entry is empty in all others
    std::int32_t segment = 0, part = 0;
    Value value;
  };

  void forget() noexcept {
    used_ = 0;
    if (++round_ != 0) return;
    for (Entry& entry : entries_) entry.round = 0;
    round_ = 1;
  }
  /// The pair's entry, and whether it is new (its value is then to be filled in); none when full.
  std::pair<Entry*, bool> remember(std::int32_t segment, std::int32_t part) noexcept {
    for (std::size_t at = home(segment, part);; at = (at + 1) & (entries_.size() - 1)) {
      Entry& entry = entries_[at];
      if (entry.round == round_ && entry.segment == segment && entry.part == part) return {&entry, false};
      if (entry.round == round_) continue;
      if (used_ == most_) return {nullptr, false};
      ++used_;
      entry = {round_, segment, part, {}};
      return {&entry, true};
    }
  }
  /// All that another one of the same room knows, each value as `changed` makes it.
  template <class Change>
  void take_over(const PairMemory& other, Change changed) noexcept {
    used_ = other.used_;
    round_ = other.round_;
    for (std::size_t i = 0; i < entries_.size(); ++i) {
      entries_[i] = other.entries_[i];
      if (entries_[i].round == round_) entries_[i].value = changed(entries_[i].value);
    }
  }
  /// The pair's value; none where it is not remembered.
  const Value* find(std::int32_t segment, std::int32_t part) const noexcept {
    for (std::size_t at = home(segment, part); entries_[at].round == round_;
         at = (at + 1) & (entries_.size() - 1)) {
      if (entries_[at].segment == segment && entries_[at].part == part) return &entries_[at].value;
    }
    return nullptr;
  }

 private:
  std::size_t most_, used_ = 0;
  std::vector<Entry> entries_;
  int shift_;
  std::uint32_t round_ = 1;

  // Fibonacci hashing: the upper bits of a product with 2^64 over the golden ratio.
  std::size_t home(std::int32_t segment, std::int32_t part) const noexcept {
    const auto key = static_cast<std::uint64_t>(segment) << 32 | static_cast<std::uint32_t>(part);
    return static_cast<std::size_t>(key * 0x9E3779B97F4A7C15U >> shift_);
  }
};

}  // namespace omentum::physics
