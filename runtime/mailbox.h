// Hands the newest value from one thread to another without waiting.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <utility>

namespace omentum::runtime {

/// A latest-value mailbox: one writer, one reader, neither ever waits or allocates. Three slots: one
/// the writer fills, one the reader holds, one that holds the newest finished value; post and fetch
/// exchange their slot with it. T needs assignment only; give it its memory beforehand.
template <class T>
class Mailbox {
 public:
  Mailbox() = default;
  explicit Mailbox(const T& initial) : slots_{initial, initial, initial} {}

  /// Writer: the slot to fill. Call post() when it is complete.
  T& draft() { return slots_[write_]; }
  void post() noexcept { write_ = newest_.exchange(write_ | kFresh, std::memory_order_acq_rel) & kSlot; }
  void post(const T& value) {
    draft() = value;
    post();
  }
  void post(T&& value) {
    draft() = std::move(value);
    post();
  }

  /// Reader: takes the newest value if one came since the last call. Returns whether one came.
  bool fetch() noexcept {
    if (!(newest_.load(std::memory_order_relaxed) & kFresh)) return false;
    read_ = newest_.exchange(read_, std::memory_order_acq_rel) & kSlot;
    return true;
  }
  /// Reader: the value taken last (the initial one before). It is the reader's: what it leaves there comes
  /// back to the writer.
  const T& value() const { return slots_[read_]; }
  T& value() { return slots_[read_]; }

 private:
  static constexpr std::uint8_t kFresh = 4;
  static constexpr std::uint8_t kSlot = 3;
  std::array<T, 3> slots_{};
  std::uint8_t write_ = 0;
  std::uint8_t read_ = 1;
  std::atomic<std::uint8_t> newest_{2};
};

}  // namespace omentum::runtime
