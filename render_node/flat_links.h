// From each of many nodes to a few others, in flat tables.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace omentum::render {

/// Nodes lie in runs of those that have as many links: a loop over one is then of a length that the processor
/// foretells. Constant once made.
class FlatLinks {
 public:
  FlatLinks() = default;  // no node
  /// `of_nodes`: each node's links, in the order in which they are to be met.
  explicit FlatLinks(std::span<const std::vector<std::int32_t>> of_nodes);

  /// visit(node, its links), once for each node.
  template <class Visit>
  void each(Visit&& visit) const {
    const std::int32_t *node = node_.data(), *link = link_.data();
    for (const Run& run : runs_)
      for (std::size_t i = 0; i < run.nodes; ++i, link += run.links)
        visit(static_cast<std::size_t>(*node++), std::span(link, run.links));
  }

 private:
  struct Run {
    std::size_t nodes = 0, links = 0;  // links: of each
  };
  std::vector<Run> runs_;
  std::vector<std::int32_t> node_, link_;  // in the runs' order
};

}  // namespace omentum::render
