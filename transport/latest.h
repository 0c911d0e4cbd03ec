// The newest sample of each tool, for loops that must not wait.
#pragma once

#include "transport/bus.h"

#include <array>
#include <atomic>
#include <cstring>
#include <type_traits>

namespace omentum::transport {

/// Holds the newest value of T. One thread writes, any number read; nobody waits or allocates.
///
/// Two slots: the writer fills the one that readers are not sent to, so that a writer suspended in the
/// middle does not keep a real-time reader from the last finished value. A read fails only when two
/// further values were finished while it copied.
template <class T>
class NewestCell {
  static_assert(std::is_trivially_copyable_v<T>);

 public:
  /// The writing thread.
  void store(const T& value) noexcept {
    const std::uint64_t count = count_.load(std::memory_order_relaxed) + 1;
    Slot& slot = slots_[count % 2];
    Words words{};
    std::memcpy(words.data(), &value, sizeof(T));
    slot.version.store(2 * count - 1, std::memory_order_relaxed);
    // released one by one: who reads one of these words also sees the odd version above
    for (std::size_t i = 0; i < kWords; ++i) slot.words[i].store(words[i], std::memory_order_release);
    slot.version.store(2 * count, std::memory_order_release);
    count_.store(count, std::memory_order_release);
  }

  /// False, with `value` untouched, when nothing was stored yet (or see above). Any thread.
  bool load(T& value) const noexcept {
    // every failed attempt means two further arrivals while 200 bytes were copied
    constexpr int kAttempts = 4;
    for (int attempt = 0; attempt < kAttempts; ++attempt)
      if (try_load(value)) return true;
    return false;
  }

 private:
  static constexpr std::size_t kWords = (sizeof(T) + 7) / 8;
  using Words = std::array<std::uint64_t, kWords>;
  struct Slot {
    std::atomic<std::uint64_t> version{0};  // 2n: holds value n whole; odd: being written
    std::array<std::atomic<std::uint64_t>, kWords> words{};
  };

  bool try_load(T& value) const noexcept {
    const std::uint64_t count = count_.load(std::memory_order_acquire);
    const Slot& slot = slots_[count % 2];
    if (count == 0 || slot.version.load(std::memory_order_acquire) != 2 * count) return false;
    Words words;
    for (std::size_t i = 0; i < kWords; ++i) words[i] = slot.words[i].load(std::memory_order_acquire);
    if (slot.version.load(std::memory_order_relaxed) != 2 * count) return false;
    std::memcpy(static_cast<void*>(&value), words.data(), sizeof(T));
    return true;
  }

  std::array<Slot, 2> slots_;
  std::atomic<std::uint64_t> count_{0};
};

/// How the samples of one tool came in, by their sequence numbers.
struct SequenceCounters {
  std::uint64_t received = 0;      // accepted as newest
  std::uint64_t lost = 0;          // numbers that were skipped
  std::uint64_t duplicates = 0;    // the newest number again; dropped
  std::uint64_t out_of_order = 0;  // an older number; dropped
  std::uint64_t restarts =
      0;  // an older number after a silence, or another sender's: it began anew; accepted
};

/// Decides which samples of one tool are new. accept() is for one thread, counters() for any.
class SequenceTracker {
 public:
  /// A sample with an older number is a late one while the newest is younger than this, and the first of a
  /// restarted sender after it: networks do not reorder across 100 ms, and no process restarts within.
  static constexpr std::int64_t kRestartSilence_ns = 100'000'000;

  /// Whether the sample is newer than all before it. now_ns: when it arrived, on any steady clock. `begins`:
  /// another sender's first, whatever its number.
  bool accept(std::uint64_t seq, std::int64_t now_ns, bool begins = false) noexcept {
    const bool first = received_.load(std::memory_order_relaxed) == 0;
    const bool is_older_after_silence = seq < newest_seq_ && now_ns - newest_ns_ > kRestartSilence_ns;
    const bool restarted = !first && (begins || is_older_after_silence);
    if (!first && !restarted && seq <= newest_seq_) {
      count(seq == newest_seq_ ? duplicates_ : out_of_order_, 1);
      return false;
    }
    if (restarted) count(restarts_, 1);
    if (!first && !restarted) count(lost_, seq - newest_seq_ - 1);
    count(received_, 1);
    newest_seq_ = seq;
    newest_ns_ = now_ns;
    return true;
  }

  SequenceCounters counters() const noexcept {
    return {received_.load(), lost_.load(), duplicates_.load(), out_of_order_.load(), restarts_.load()};
  }

 private:
  using Counter = std::atomic<std::uint64_t>;
  static void count(Counter& counter, std::uint64_t by) noexcept {
    counter.store(counter.load(std::memory_order_relaxed) + by, std::memory_order_relaxed);
  }

  std::uint64_t newest_seq_ = 0;
  std::int64_t newest_ns_ = 0;
  Counter received_{0}, lost_{0}, duplicates_{0}, out_of_order_{0}, restarts_{0};
};

/// A sample and when it arrived.
template <class M>
struct Arrived {
  M sample;
  std::int64_t arrived_ns = 0;  // on its reader's clock

  std::int64_t age_ns(std::int64_t now_ns) const noexcept { return now_ns - arrived_ns; }
};

/// What becomes of a writer's sample.
enum class Admission : std::uint8_t {
  kRefused,
  kContinues,
  kBegins,  // the first one of a writer that goes on where another one was
};

/// Reads a topic whose samples have `tool` and `seq` (ToolPose, ToolForce) and keeps each tool's newest.
/// Duplicates and late samples are dropped; tools from msg::MAX_TOOLS on are ignored.
template <class M>
class LatestByTool {
 public:
  /// Whether a sample of this writer counts, ns on the clock.
  using Admits = std::function<Admission(const M&, const WriterId&, std::int64_t)>;

  /// on_arrival (may be empty) is called on the vendor's thread, after the sample can be loaded; neither it
  /// nor the clock (ns, steady) may block, nor `admits` (empty: all count), which is asked before.
  LatestByTool(Bus& bus, std::function<void(const M&)> on_arrival, std::function<std::int64_t()> clock,
               Admits admits = {})
      : on_arrival_(std::move(on_arrival)),
        clock_(std::move(clock)),
        admits_(std::move(admits)),
        reader_(bus.reader<M>(callbacks())) {}

  /// The tool's newest sample. False, with `out` untouched, when none came yet. Any thread; never waits.
  bool load(std::uint32_t tool, Arrived<M>& out) const noexcept {
    return tool < tools_.size() && tools_[tool].newest.load(out);
  }

  /// Any thread; never waits. Tool below msg::MAX_TOOLS.
  SequenceCounters counters(std::uint32_t tool) const noexcept { return tools_[tool].sequence.counters(); }

  EndpointStatus status() const { return reader_->status(); }

 private:
  struct Tool {
    SequenceTracker sequence;
    NewestCell<Arrived<M>> newest;
  };

  ByWriter<M> callbacks() {
    ByWriter<M> callbacks{[this](const M& sample, const WriterId& writer) { take(sample, writer); }, {}};
    // who has to know writers says so by this
    if (admits_) callbacks.on_gone = [](const WriterId&) {};
    return callbacks;
  }

  void take(const M& sample, const WriterId& writer) {
    const std::int64_t now_ns = clock_();
    const Admission admission = admits_ ? admits_(sample, writer, now_ns) : Admission::kContinues;
    if (admission == Admission::kRefused || sample.tool >= tools_.size()) return;
    const bool begins = admission == Admission::kBegins;
    if (!tools_[sample.tool].sequence.accept(sample.seq, now_ns, begins)) return;
    tools_[sample.tool].newest.store({sample, now_ns});
    if (on_arrival_) on_arrival_(sample);
  }

  std::array<Tool, msg::MAX_TOOLS> tools_;
  std::function<void(const M&)> on_arrival_;
  std::function<std::int64_t()> clock_;
  Admits admits_;
  std::unique_ptr<Reader<M>> reader_;  // last: its callback uses the members above
};

}  // namespace omentum::transport
