// A small model of a surface around a place, as a moving organ offers it to the hand.
#pragma once

#include "geometry/types.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace omentum::deform {

/// Around which tool a local model is wanted, and where.
struct PatchPlace {
  std::uint32_t tool = 0;
  geometry::Vec3 centre = geometry::Vec3::Zero();  // in W, m
  double radius_m = 0;
  // What its jaws hold, in the surface's numbers: faces among these belong to the patch wherever they are,
  // since a hold that the model leaves out is a hold that is lost.
  std::span<const geometry::NodeId> held{};
};

/// The nodes of a surface around a tool, how they move, and how they yield to other forces f of that tool;
/// what others do there is in the positions:
///   x(f, t) = positions + t velocities + C (f - forces),   C [3n][3n] symmetric,
/// good for the next few milliseconds. Vectors have the size that they may need; the counts say what of it
/// is used, so that filling one takes no memory.
struct LocalPatch {
  LocalPatch() = default;
  /// Room for so many nodes, and the triangles of a surface with so many.
  explicit LocalPatch(std::size_t most_nodes)
      : nodes(most_nodes),
        positions(most_nodes),
        velocities(most_nodes),
        forces(most_nodes),
        triangles(2 * most_nodes),
        compliance(3 * most_nodes * (3 * most_nodes + 1) / 2) {}

  std::uint64_t topology_version = 0;
  std::size_t node_count = 0, triangle_count = 0;
  std::vector<std::uint32_t> nodes;                    // places in the mesh file, from 0
  std::vector<geometry::Vec3> positions;               // in W, m
  std::vector<geometry::Vec3> velocities;              // in W, m/s
  std::vector<geometry::Vec3> forces;                  // of that tool, at which the positions hold, in W, N
  std::vector<std::array<std::uint8_t, 3>> triangles;  // of places in `nodes`, counter-clockwise from outside
  std::vector<float> compliance;                       // upper triangle of C, row by row, m/N
};

}  // namespace omentum::deform
