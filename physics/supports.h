// What holds an organ in place, and the degrees of freedom that are left.
#pragma once

#include "geometry/tetra_mesh.h"

#include <cstdint>
#include <span>
#include <vector>

namespace omentum::physics {

/// Which components of which nodes are held: [N] bit sets, 1 = x, 2 = y, 4 = z; 7 = pinned.
using FixedComponents = std::vector<std::uint8_t>;

inline constexpr std::uint8_t kPinned = 7;

inline bool is_fixed(std::uint8_t components, int axis) {
  return (components >> axis & 1) != 0;
}

/// [N]: nodes held in all three components.
std::vector<bool> pinned_nodes(const FixedComponents& fixed);

/// The free degrees of freedom, numbered by node, then component.
struct FreeDofs {
  std::vector<std::int32_t> index;  // [3N] number among the free ones; -1 where held
  std::int32_t count = 0;

  std::int32_t of(geometry::NodeId node, int axis) const { return index[3 * node + axis]; }
};

FreeDofs free_dofs(const FixedComponents& fixed);

/// The supports leave the organ floating: it can move as a rigid body without any force.
class FloatingError : public geometry::InputError {
 public:
  using InputError::InputError;
};

/// How many of the six rigid motions of these nodes, not none, meet no support. Takes no memory.
int loose_motions(const geometry::TetraMesh& mesh, std::span<const geometry::NodeId> nodes,
                  const FixedComponents& fixed);

/// Throws FloatingError, saying how many rigid motions are left, unless the supports stop all six. The mesh
/// is connected, so that this decides whether K has an inverse over the free degrees of freedom; a
/// factorization alone may miss it, because rounding leaves a tiny positive pivot.
void require_held(const geometry::TetraMesh& mesh, const FixedComponents& fixed);

}  // namespace omentum::physics
