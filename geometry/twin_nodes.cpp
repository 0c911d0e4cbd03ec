#include "geometry/twin_nodes.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace omentum::geometry {
namespace {

// Along which nodes are sorted: no layer of a regular mesh is perpendicular to it.
const Vec3 kAskew = Vec3(std::sqrt(2.0), std::sqrt(3.0), std::sqrt(5.0)).normalized();

struct Placed {
  double along;  // m
  std::int32_t node;
};

}  // namespace

std::vector<std::pair<std::int32_t, std::int32_t>> find_twins(std::span<const Vec3> positions,
                                                              std::span<const std::int32_t> among,
                                                              double distance) {
  const auto at = [&](std::int32_t node) -> const Vec3& { return positions[static_cast<std::size_t>(node)]; };
  std::vector<Placed> sorted;
  sorted.reserve(among.size());
  for (const std::int32_t node : among) sorted.push_back({kAskew.dot(at(node)), node});
  std::ranges::sort(sorted, {}, &Placed::along);
  std::vector<std::pair<std::int32_t, std::int32_t>> pairs;
  for (std::size_t i = 0; i < sorted.size(); ++i) {
    // rounding of the projections must not hide a pair
    const double reach = sorted[i].along + distance + 1e-12 * std::abs(sorted[i].along);
    for (std::size_t j = i + 1; j < sorted.size() && sorted[j].along <= reach; ++j) {
      const std::int32_t a = sorted[i].node, b = sorted[j].node;
      if ((at(a) - at(b)).norm() <= distance) pairs.emplace_back(std::min(a, b), std::max(a, b));
    }
  }
  std::ranges::sort(pairs);
  return pairs;
}

std::string describe_twins(std::span<const std::pair<std::int32_t, std::int32_t>> pairs,
                           const FileNumbers& names, std::size_t named) {
  const auto name = [&](std::int32_t node) {
    return std::to_string(names.of(static_cast<std::size_t>(node)));
  };
  std::string text =
      std::to_string(pairs.size()) + (pairs.size() == 1 ? " pair" : " pairs") +
      " of nodes at the same place (a crack, or parts glued by copying; organ_build --merge METRES "
      "makes one of each)";
  for (std::size_t i = 0; i < std::min(pairs.size(), named); ++i) {
    text += (i == 0 ? ": nodes " : ", ") + name(pairs[i].first) + " and " + name(pairs[i].second);
  }
  return text + (pairs.size() > named ? ", ..." : "");
}

std::vector<std::int32_t> first_of_twins(std::span<const std::pair<std::int32_t, std::int32_t>> pairs,
                                         std::size_t node_count) {
  std::vector<std::int32_t> first(node_count);
  std::iota(first.begin(), first.end(), 0);
  const auto find = [&](std::int32_t node) {
    while (first[static_cast<std::size_t>(node)] != node) node = first[static_cast<std::size_t>(node)];
    return node;
  };
  for (const auto& [a, b] : pairs) {
    const std::int32_t root_a = find(a), root_b = find(b);
    first[static_cast<std::size_t>(std::max(root_a, root_b))] = std::min(root_a, root_b);
  }
  for (std::int32_t& node : first) node = find(node);
  return first;
}

}  // namespace omentum::geometry
