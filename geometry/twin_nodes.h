// Nodes at the same place: an inner crack, or parts of a mesh that were glued by copying.
#pragma once

#include "geometry/file_numbers.h"
#include "geometry/types.h"

#include <span>
#include <string>
#include <utility>
#include <vector>

namespace omentum::geometry {

/// Pairs of the nodes `among` that are at most `distance` apart, m: the smaller number first, ascending.
/// O(n log n) while few nodes lie in a slice of that thickness. Precondition: positions are finite.
std::vector<std::pair<std::int32_t, std::int32_t>> find_twins(std::span<const Vec3> positions,
                                                              std::span<const std::int32_t> among,
                                                              double distance);

/// "2 pairs of nodes at the same place (what to do): nodes 3 and 12, 4 and 13", at most `named` of them, by
/// the numbers that `names` gives them.
std::string describe_twins(std::span<const std::pair<std::int32_t, std::int32_t>> pairs,
                           const FileNumbers& names, std::size_t named);

/// For each of `node_count` nodes the smallest one that a chain of pairs connects it with; itself without
/// any.
std::vector<std::int32_t> first_of_twins(std::span<const std::pair<std::int32_t, std::int32_t>> pairs,
                                         std::size_t node_count);

}  // namespace omentum::geometry
