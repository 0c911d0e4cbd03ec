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

/// The same whose pieces fall.
DynamicParts falling_parts_of(const HeldOrgan& organ);

/// A sequence of cut_trials.h, and what is left is held; or, of the other, may fall.
std::string try_falling_cuts(const HeldOrgan& organ, std::uint32_t seed, int ticks);
std::string try_static_cuts(const HeldOrgan& organ, std::uint32_t seed, int ticks);

}  // namespace omentum::deform
