// Several threads that share out one piece of work and are waited for.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <thread>
#include <vector>

namespace omentum::runtime {

/// Helpers of one thread, asleep between its calls. What is done does not depend on their number, as long as
/// the parts of the work do not touch each other; who is late is not waited for unless it has begun a part.
///
///     Crew crew(1);
///     crew.share(organs.size(), [&](std::size_t i) { organs[i].step(); });
class Crew {
 public:
  /// Starts `helpers` threads; 0: whoever calls does all alone.
  explicit Crew(std::size_t helpers);
  ~Crew();
  Crew(const Crew&) = delete;
  Crew& operator=(const Crew&) = delete;

  std::size_t helpers() const noexcept { return threads_.size(); }

  /// Calls part(i), which must not throw, once for each i below `count` (below 2^31), on the calling thread
  /// and on helpers, the lowest first; returns when all are done. Allocates nothing. One thread's.
  template <class Part>
  void share(std::size_t count, const Part& part) noexcept {
    const auto call = [](const void* of, std::size_t i) noexcept { (*static_cast<const Part*>(of))(i); };
    if (threads_.empty() || count < 2) {
      for (std::size_t i = 0; i < count; ++i) part(i);
    } else {
      share_out(count, call, &part);
    }
  }

 private:
  using Call = void (*)(const void*, std::size_t) noexcept;

  void share_out(std::size_t count, Call call, const void* part) noexcept;
  void take_parts() noexcept;
  void help() noexcept;

  Call call_ = nullptr;
  const void* part_ = nullptr;
  std::atomic<std::uint64_t> next_{0};  // parts in all, times 2^32, and how many are given out
  std::atomic<std::uint32_t> left_{0};  // parts not done
  std::atomic<std::uint32_t> calls_{0};
  std::atomic<bool> ending_{false};
  std::vector<std::thread> threads_;
};

}  // namespace omentum::runtime
