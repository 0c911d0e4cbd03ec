#include "runtime/faults.h"

#include "runtime/clock.h"

#include <algorithm>
#include <cstdio>

namespace omentum::runtime {

FaultList::FaultList() noexcept : begin_ns_(steady_now_ns()) {}

void FaultList::raise(std::string_view text) noexcept {
  text = text.substr(0, kTextSize);
  for (Entry& entry : entries_) {
    std::uint8_t state = entry.state.load(std::memory_order_acquire);
    if (state == kEmpty && entry.state.compare_exchange_strong(state, kFilling, std::memory_order_acquire)) {
      std::copy(text.begin(), text.end(), entry.text.begin());
      entry.size = static_cast<std::uint8_t>(text.size());
      entry.first_ns = steady_now_ns();
      entry.count.store(1, std::memory_order_relaxed);
      entry.state.store(kReady, std::memory_order_release);
      return;
    }
    // an entry that another thread fills this very moment is passed over: list() merges equal texts
    if (state == kReady && std::string_view(entry.text.data(), entry.size) == text) {
      entry.count.fetch_add(1, std::memory_order_relaxed);
      return;
    }
  }
  further_.fetch_add(1, std::memory_order_relaxed);
}

std::vector<Fault> FaultList::list() const {
  std::vector<Fault> faults;
  for (const Entry& entry : entries_) {
    if (entry.state.load(std::memory_order_acquire) != kReady) continue;
    const std::string_view text(entry.text.data(), entry.size);
    const std::uint64_t count = entry.count.load(std::memory_order_relaxed);
    const auto same =
        std::find_if(faults.begin(), faults.end(), [&](const Fault& f) { return f.text == text; });
    if (same != faults.end()) {
      same->count += count;
    } else {
      faults.push_back({std::string(text), 1e-9 * static_cast<double>(entry.first_ns - begin_ns_), count});
    }
  }
  return faults;
}

std::vector<std::string> FaultList::lines() const {
  std::vector<std::string> lines;
  for (const Fault& fault : list()) {
    std::array<char, 64> suffix{};
    std::snprintf(suffix.data(), suffix.size(), " (first at %.1f s, %llu times)", fault.first_s,
                  static_cast<unsigned long long>(fault.count));
    lines.push_back(fault.text + suffix.data());
  }
  if (const auto further = further_.load(std::memory_order_relaxed)) {
    lines.push_back(std::to_string(further) + " further faults");
  }
  return lines;
}

}  // namespace omentum::runtime
