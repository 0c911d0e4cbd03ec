// Lists that typed indices count.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace omentum::geometry {

/// No place in a list.
inline constexpr std::int32_t kNone = -1;

/// What a list has for a node, tetrahedron, ...: no bounds are checked.
template <class T, class Id>
T& at(std::vector<T>& values, Id i) {
  return values[static_cast<std::size_t>(i)];
}

}  // namespace omentum::geometry
