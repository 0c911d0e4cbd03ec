// Places as a user writes them on a command line or in a scene: planes and boxes.
#pragma once

#include "geometry/types.h"

#include <functional>
#include <string>
#include <vector>

namespace omentum::organ {

/// Whether a point, m, lies there.
using Place = std::function<bool(const geometry::Vec3&)>;

/// "box:...+plane:..." in its parts; a plus in a number or in a file's name is none between parts.
std::vector<std::string> split_joined(const std::string& joined);

/// Of plane:x<0.03 (one side of a plane: axis x, y or z, then < or >, then metres) or
/// box:x0,y0,z0,x1,y1,z1 (inside or on the faces, metres); empty for anything else. Throws
/// geometry::InputError "OPTION WHOLE: ..." for one that is wrong. `whole`: the SPEC that `place` is of.
Place place_of(const std::string& place, const std::string& option, const std::string& whole);

}  // namespace omentum::organ
