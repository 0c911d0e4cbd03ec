// How long a step of whatever moves by itself may be.
#pragma once

#include "scene/toml_section.h"

namespace omentum::scene {

// No picture shows steps that are longer, and a hand would feel them.
inline constexpr Range kStepRange_s{.minimum = 1e-6, .maximum = 0.02};

}  // namespace omentum::scene
