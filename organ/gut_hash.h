// The fingerprint of an intestine that a scene's numbers make.
#pragma once

#include "geometry/gut_anatomy.h"

#include <string>

namespace omentum::organ {

/// Which make_gut() this is: one that makes another gut of the same numbers takes the next.
inline constexpr int kGutVersion = 1;

/// SHA-256 (hexadecimal) of that version and the anatomy's numbers to nine digits: two machines that make
/// another gut must not take part in one session, but may have sines that differ in their last bit.
std::string gut_hash(const geometry::GutAnatomy& anatomy);

}  // namespace omentum::organ
