// The fingerprint of an intestine that a scene's numbers made.
#pragma once

#include "geometry/gut_shape.h"

#include <string>

namespace omentum::organ {

/// SHA-256 (hexadecimal) of its layout, the bytes of its masses' places, radius and thickness: two machines
/// that make another gut of the same numbers must not take part in one session.
std::string gut_hash(const geometry::GutShape& gut);

}  // namespace omentum::organ
