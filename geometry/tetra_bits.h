// A bit for each tetrahedron of a mesh.
#pragma once

#include "geometry/types.h"

#include <cstdint>
#include <span>

namespace omentum::geometry {

/// Bit t % 8 of byte t / 8; not set where `bits` end before it.
inline bool is_set(std::span<const std::uint8_t> bits, TetId t) noexcept {
  const auto i = static_cast<std::size_t>(t);
  return i / 8 < bits.size() && (bits[i / 8] >> (i % 8) & 1) != 0;
}

}  // namespace omentum::geometry
