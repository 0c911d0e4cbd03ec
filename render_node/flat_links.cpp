#include "render_node/flat_links.h"

#include <algorithm>

namespace omentum::render {

FlatLinks::FlatLinks(std::span<const std::vector<std::int32_t>> of_nodes) {
  const auto links_of = [&](std::int32_t node) -> const std::vector<std::int32_t>& {
    return of_nodes[static_cast<std::size_t>(node)];
  };
  for (std::size_t n = 0; n < of_nodes.size(); ++n) node_.push_back(static_cast<std::int32_t>(n));
  std::ranges::stable_sort(node_, {}, [&](std::int32_t node) { return links_of(node).size(); });
  for (const std::int32_t node : node_) {
    const std::vector<std::int32_t>& links = links_of(node);
    link_.insert(link_.end(), links.begin(), links.end());
    if (runs_.empty() || runs_.back().links != links.size()) runs_.push_back({0, links.size()});
    ++runs_.back().nodes;
  }
}

}  // namespace omentum::render
