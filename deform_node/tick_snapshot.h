// What a tick of the loop hands to the publishing thread, by value.
#pragma once

#include "deform_node/organ_models.h"
#include "transport/messages.h"

#include <vector>

namespace omentum::deform {

/// A model's view, copied. `values` and both bit sets have the largest size, so that taking a view takes no
/// memory.
struct OrganSnapshot {
  OrganSnapshot() = default;
  explicit OrganSnapshot(const ModelSizes& sizes)
      : values(sizes.values), removed_bits(sizes.removed_bytes, 0), burnt_bits(sizes.removed_bytes, 0) {}

  StateKind kind = StateKind::kSurface;
  std::uint64_t topology_version = 0;
  std::size_t value_count = 0;
  std::vector<float> values;
  std::vector<std::uint8_t> removed_bits, burnt_bits;

  /// `view` is not larger than the sizes said.
  void take(const OrganView& view) noexcept;
};

/// The loop's part of a NodeStatus; the texts, which take memory, are the publishing thread's.
struct LoopFigures {
  std::uint64_t number = 0;  // of this status; 0: none is due yet
  bool paused = false;
  std::uint64_t newest_order = 0;  // NodeStatus.newest_order
  std::uint64_t ticks = 0, missed = 0;
  msg::Percentiles period_us{}, compute_us{};
  double real_time_factor = 0;  // NodeStatus.real_time_factor
};

/// The newest pose of each tool that a state takes into account.
struct Echoes {
  std::array<msg::Echo, msg::MAX_TOOLS> of_tools{};
  std::size_t count = 0;

  void take(std::span<const msg::Echo> newest) noexcept;
  std::span<const msg::Echo> all() const noexcept { return {of_tools.data(), count}; }
};

struct TickSnapshot {
  std::uint64_t seq = 0;      // of the state
  std::int64_t stamp_ns = 0;  // the loop's steady clock
  Echoes echoes;
  std::vector<OrganSnapshot> organs;
  LoopFigures figures;  // the newest, so that none is lost with a snapshot that nobody fetched
};

}  // namespace omentum::deform
