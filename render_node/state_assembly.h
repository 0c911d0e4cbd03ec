// Puts the blocks of an organ's state together again.
#pragma once

#include "transport/messages.h"

#include <functional>
#include <vector>

namespace omentum::render {

/// A whole state of one organ, as far as it arrived.
struct AssembledState {
  std::uint64_t seq = 0;
  std::int64_t stamp_ns = 0;         // deform_node's steady clock
  std::uint32_t missing_blocks = 0;  // these kept the values of an earlier state
  std::vector<msg::Echo> echoes;     // newest pose per tool in this state
  std::vector<float> values;         // x y z of each node, as the organ's kind of state has them, m
};

/// One organ's. A lost block keeps its old values for one state; late blocks are dropped. After a
/// restart of deform_node, which counts from 1 again, its newer stamp says so, or, should its clock have
/// begun anew as well, kPatience late blocks in a row. One thread.
class StateAssembly {
 public:
  static constexpr int kPatience = 100;  // blocks: a reordering network delays a few, never so many

  /// `kind`: of this organ's states, KIND_*. `reach_m`: a value beyond it is none of this organ.
  StateAssembly(std::uint32_t kind, std::size_t node_count, double reach_m);

  enum class Outcome {
    kTaken,
    kLate,
    kMisfit,  // other kind, other number of nodes, out of range, not finite or beyond reach: nothing was
              // changed
  };
  /// Calls show(state) when a state is complete, or when the first block of the next one came before it was.
  Outcome take(const msg::OrganState& block, const std::function<void(const AssembledState&)>& show);

 private:
  bool fits(const msg::OrganState& block) const;
  bool newer(const msg::OrganState& block);
  void begin(const msg::OrganState& block);

  std::uint32_t kind_;
  float reach_m_;
  AssembledState state_;
  std::vector<bool> arrived_;  // blocks of the current state
  int late_in_a_row_ = 0;
};

/// The newest echo of each tool among those of several organs.
std::vector<msg::Echo> merge_echoes(const std::vector<std::vector<msg::Echo>>& of_organs);

}  // namespace omentum::render
