// Random cuts of organs that a hand presses and pulls meanwhile.
#pragma once

#include "deform_node/organ_models.h"
#include "geometry/tetra_mesh.h"
#include "physics/supports.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace omentum::deform {

/// An organ, and what holds of it. All that it refers to outlives it.
struct TriedOrgan {
  const geometry::TetraMesh& mesh;
  const physics::FixedComponents& fixed;
  std::function<std::unique_ptr<OrganModel>()> make;  // strokes cut at once
  std::vector<NodeId> places;                         // where blades and hands go
  double depth_m = 2e-3;                              // how far along x a hand brings a node
  std::span<const std::uint8_t> precomputed{};        // [T] other than 0: stays; empty: none has to
  bool is_static = false;                             // what is left is held, always
  bool turns = false;                                 // what a hand feels depends on how it lies
  double most_way_m = 2e-3;  // of a hand within a tick of 10 ms: 0.2 m/s, a fast hand in a body
};

/// One sequence of `ticks`: strokes through random places, a hand that presses by the local models that it is
/// told, presses elsewhere or lets go, resets, and other processes that take the cuts up. Checks after every
/// tick that states and patches are finite, that no force is beyond twice what the hand said, that the rest
/// is manifold, and that nobody's energy is beyond the work that was done. The first thing that is wrong,
/// with its tick; empty: nothing.
std::string try_cuts(const TriedOrgan& organ, std::uint32_t seed, int ticks);

}  // namespace omentum::deform
