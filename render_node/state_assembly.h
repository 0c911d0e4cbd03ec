// Puts the blocks of an organ's state together again.
#pragma once

#include "render_node/known_topologies.h"

#include <functional>
#include <vector>

namespace omentum::render {

/// A whole state of one organ, as far as it arrived.
struct AssembledState {
  std::uint64_t seq = 0;
  std::int64_t stamp_ns = 0;         // deform_node's steady clock
  std::uint32_t missing_blocks = 0;  // these kept the values of an earlier state
  std::uint64_t topology_version = 0;
  RemovedSet removed;             // in that version; the inbox fills it in
  std::vector<msg::Echo> echoes;  // newest pose per tool in this state
  std::vector<float> values;      // x y z of each node, as the organ's kind of state has them, m
  // At each node, as OrganStress has them; empty where they are not known, or nobody asked
  // (stress_pairing.h).
  std::vector<float> strain, stress_pa;
};

/// Nodes of an organ's states: as it was loaded, and at most, when everything else of it was bared.
struct NodeCounts {
  std::size_t whole = 0, most = 0;
};

/// One organ's. A lost block keeps its old values for one state, unless the state before it was of another
/// topology: then its numbers mean other nodes, and only a complete state is shown. Late blocks are dropped.
/// After a restart of deform_node, which counts from 1 again, its newer stamp says so, or, should its clock
/// have begun anew as well, kPatience late blocks in a row. One thread.
class StateAssembly {
 public:
  static constexpr int kPatience = 100;  // blocks: a reordering network delays a few, never so many

  /// `kind`: of this organ's states, KIND_*. `reach_m`: a value beyond it is none of this organ.
  StateAssembly(std::uint32_t kind, NodeCounts counts, double reach_m);

  enum class Outcome {
    kTaken,
    kLate,
    kMisfit,  // other kind, a number of nodes that no state or not this one has, out of range, not finite or
              // beyond reach: nothing was changed
  };
  /// Calls show(state) when a state is complete, or when the first block of the next one came before it was.
  Outcome take(const msg::OrganState& block, const std::function<void(const AssembledState&)>& show);

 private:
  bool fits(const msg::OrganState& block) const;
  bool of_this_state(const msg::OrganState& block) const;
  bool newer(const msg::OrganState& block);
  void begin(const msg::OrganState& block);

  std::uint32_t kind_;
  NodeCounts counts_;
  float reach_m_;
  AssembledState state_;
  bool may_lack_blocks_ = true;  // what it lacks can be taken from the state before it
  std::vector<bool> arrived_;    // blocks of the current state
  int late_in_a_row_ = 0;
};

/// The newest echo of each tool among those of several organs.
std::vector<msg::Echo> merge_echoes(const std::vector<std::vector<msg::Echo>>& of_organs);

}  // namespace omentum::render
