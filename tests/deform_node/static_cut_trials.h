// Random cuts of organs that are always in equilibrium, pressed meanwhile.
#pragma once

#include "deform_node/dynamic_model.h"
#include "geometry/surface.h"

#include <cstdint>
#include <string>

namespace omentum::deform {

/// An organ that supports hold, as its file says it.
struct HeldOrgan {
  geometry::TetraMesh mesh;
  physics::MaterialMap material;
  physics::FixedComponents fixed;
  geometry::Surface surface;

  /// Held within `depth_m` of its smallest x.
  HeldOrgan(geometry::TetraMesh of, double depth_m);
  /// Its model, which it outlives; strokes cut at once.
  DynamicParts parts() const;
};

/// One sequence of `ticks`: strokes through random places, a hand that presses by the local models that it is
/// told, presses elsewhere or lets go, resets, and other processes that take the cuts up. Checks after every
/// tick that states and patches are finite, that no force is beyond twice what the hand said, that the rest
/// is manifold and held, and that nobody's energy is beyond the work that was done. The first thing that is
/// wrong, with its tick; empty: nothing.
std::string try_static_cuts(const HeldOrgan& organ, std::uint32_t seed, int ticks);

}  // namespace omentum::deform
