// Values of render_node's command line. Each parser gives an error message, or nothing.
#pragma once

#include "render_node/tissue_map.h"

#include <string>

namespace omentum::render {

/// "WIDTHxHEIGHT", pixels.
std::string parse_size(const std::string& text, Size& size);
/// "strain" or "stress".
std::string parse_map(const std::string& text, TissueMap& map);

}  // namespace omentum::render
