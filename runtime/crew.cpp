#include "runtime/crew.h"

namespace omentum::runtime {

Crew::Crew(std::size_t helpers) {
  threads_.reserve(helpers);
  for (std::size_t i = 0; i < helpers; ++i) threads_.emplace_back([this] { help(); });
}

Crew::~Crew() {
  ending_.store(true);
  calls_.fetch_add(1);
  calls_.notify_all();
  for (std::thread& thread : threads_) thread.join();
}

// Whoever takes a number that is given out for this call sees what it is about: it was written before.
void Crew::share_out(std::size_t count, Call call, const void* part) noexcept {
  call_ = call;
  part_ = part;
  left_.store(static_cast<std::uint32_t>(count), std::memory_order_relaxed);
  next_.store(static_cast<std::uint64_t>(count) << 32, std::memory_order_release);
  calls_.fetch_add(1);
  calls_.notify_all();
  take_parts();
  for (std::uint32_t left = left_.load(std::memory_order_acquire); left != 0;
       left = left_.load(std::memory_order_acquire))
    left_.wait(left, std::memory_order_acquire);
}

void Crew::take_parts() noexcept {
  while (true) {
    const std::uint64_t taken = next_.fetch_add(1, std::memory_order_acq_rel);
    const std::uint64_t part = taken & 0xFFFFFFFFU;
    if (part >= taken >> 32) return;
    call_(part_, part);
    if (left_.fetch_sub(1, std::memory_order_acq_rel) == 1) left_.notify_one();
  }
}

void Crew::help() noexcept {
  std::uint32_t seen = 0;
  while (!ending_.load()) {
    calls_.wait(seen);
    seen = calls_.load();
    take_parts();
  }
}

}  // namespace omentum::runtime
