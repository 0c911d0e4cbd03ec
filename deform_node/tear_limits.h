// Where each tetrahedron of an organ tears, by what its scene says of its materials.
#pragma once

#include "organ/organ.h"
#include "physics/dynamics/tearing.h"
#include "scene/scene.h"

namespace omentum::deform {

/// [T]. `spec` has dynamics. Of a region that says nothing of tearing, as of the rest, the organ's hold; a
/// tetrahedron that several regions hold is of the last one, as its material is (organ/region_spec.h).
std::vector<physics::TearLimits> tear_limits_of(const organ::Organ& organ, const scene::OrganSpec& spec);

}  // namespace omentum::deform
