// Values of render_node's command line. Each parser gives an error message, or nothing.
#pragma once

#include "render_node/render_loop.h"

#include <string>

namespace omentum::render {

/// "WIDTHxHEIGHT", pixels.
std::string parse_size(const std::string& text, Size& size);
/// 0.5 to 4.
std::string parse_ui_scale(const std::string& text, float& scale);
/// Pictures of a second of video, 1 to 120.
std::string parse_record(const std::string& text, double& fps);
/// "strain" or "stress".
std::string parse_map(const std::string& text, TissueMap& map);

/// --pairs, --ui-scale and --record.
void add_window_options(runtime::CommandLine& line, RenderOptions& options);

}  // namespace omentum::render
