#include "render_node/panel_view.h"

#include <array>
#include <cmath>

namespace omentum::render {
namespace {

constexpr std::uint64_t kSeriousMisses = 1000;  // one in so many ticks

std::string node_name(std::uint32_t kind) {
  constexpr std::array<const char*, 5> kNames{"haptic", "deform", "render", "device", "launcher"};
  return kind < kNames.size() ? kNames[kind] : "node " + std::to_string(kind);
}

}  // namespace

std::vector<NodeRow> node_rows(const std::vector<HeardStatus>& heard, std::int64_t now_ns) {
  std::vector<NodeRow> rows;
  for (const auto& [status, arrived_ns] : heard) {
    NodeRow& row = rows.emplace_back();
    row.name = node_name(status.kind);
    row.silent = now_ns - arrived_ns > kSilent_ns;
    row.rate_hz = status.period_us.p50 > 0 ? 1e6 / status.period_us.p50 : status.rate_hz;
    row.compute_us = status.compute_us.p50;
    row.missed = status.missed;
    // a picture that comes later takes nothing from the hand
    row.misses_matter = status.kind != msg::NODE_RENDER && kSeriousMisses * status.missed > status.ticks;
  }
  return rows;
}

msg::Percentiles device_round_trip(const std::vector<HeardStatus>& heard) {
  msg::Percentiles slowest{};
  for (const auto& [status, arrived_ns] : heard) {
    if (status.round_trip_us.count > 0 && status.round_trip_us.p50 >= slowest.p50)
      slowest = status.round_trip_us;
  }
  return slowest;
}

double real_time_factor(const std::vector<HeardStatus>& heard, std::int64_t now_ns) {
  double factor = 0;
  for (const auto& [status, arrived_ns] : heard) {
    if (status.kind == msg::NODE_DEFORM && now_ns - arrived_ns <= kSilent_ns)
      factor = status.real_time_factor;
  }
  return std::isfinite(factor) ? factor : 0;
}

std::optional<bool> haptic_paused(const std::vector<HeardStatus>& heard, std::int64_t now_ns) {
  std::optional<bool> paused;
  for (const auto& [status, arrived_ns] : heard) {
    if (status.kind != msg::NODE_HAPTIC || now_ns - arrived_ns > kSilent_ns) continue;
    paused = paused.value_or(false) || status.paused;
  }
  return paused;
}

std::vector<std::string> all_faults(const std::vector<HeardStatus>& heard) {
  std::vector<std::string> faults;
  for (const auto& [status, arrived_ns] : heard) {
    for (const std::string& fault : status.faults) faults.push_back(node_name(status.kind) + ": " + fault);
  }
  return faults;
}

std::vector<std::string> force_state_words(std::uint32_t state) {
  struct Word {
    std::uint32_t bit;
    const char* text;
  };
  constexpr std::array<Word, 7> kWords{{{msg::FORCE_FAULT, "FAULT"},
                                        {msg::FORCE_STALE, "stale"},
                                        {msg::FORCE_PAUSED, "paused"},
                                        {msg::FORCE_CLAMPED, "clamped"},
                                        {msg::FORCE_SLEW, "slew-limited"},
                                        {msg::FORCE_RAMP, "fading in"},
                                        {msg::FORCE_PASSIVITY, "damped"}}};
  // nothing fades in before a person clears it
  if (state & msg::FORCE_FAULT) state &= ~msg::FORCE_RAMP;
  std::vector<std::string> words;
  for (const auto& [bit, text] : kWords) {
    if (state & bit) words.emplace_back(text);
  }
  return words;
}

}  // namespace omentum::render
