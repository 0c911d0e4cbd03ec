// Brings a state and what its tissue is under together.
#pragma once

#include "render_node/state_assembly.h"

#include <deque>
#include <optional>

namespace omentum::render {

/// One organ's. Values of one state are never shown with another one: while they lag behind, the older pair
/// stays. While none come (nobody knows them, or not yet), or later than kPatience_ns, states are shown
/// without. One thread at a time.
class StressPairing {
 public:
  /// For so long a state waits for its values, and so long after the last pair states wait at all. A picture
  /// that stands still for longer is seen to do so.
  static constexpr std::int64_t kPatience_ns = 250'000'000;

  /// `most_nodes`: of this organ's states.
  explicit StressPairing(std::size_t most_nodes) : most_nodes_(most_nodes) {}

  /// What is to be shown now, if anything: the state, with its values or without.
  std::optional<AssembledState> take(const AssembledState& state, std::int64_t now_ns);
  /// A block of another state than the last one's begins anew. False: of no state of this organ, or not
  /// finite; nothing was changed.
  [[nodiscard]] bool take(const msg::OrganStress& block);
  /// The pair that the last block completed, if any.
  std::optional<AssembledState> pair(std::int64_t now_ns);

 private:
  struct Heard {
    AssembledState state;
    std::int64_t arrived_ns;
    bool is_shown;  // without its values
  };
  bool fits(const msg::OrganStress& block) const;
  bool continues(const msg::OrganStress& block) const;
  void begin(const msg::OrganStress& block);
  bool belong_together(const AssembledState& state) const;
  AssembledState with_values(AssembledState state, std::int64_t now_ns);

  std::size_t most_nodes_;
  std::deque<Heard> heard_;  // not longer ago than kPatience_ns, and since the last pair; the newest last
  // of the last blocks
  std::uint64_t seq_ = 0, topology_version_ = 0;
  std::size_t missing_blocks_ = 0;
  std::vector<bool> arrived_;
  std::vector<float> strain_, stress_pa_;
  std::optional<std::int64_t> paired_ns_;  // when values and state last met
};

}  // namespace omentum::render
