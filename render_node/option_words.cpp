#include "render_node/option_words.h"

#include <cstdio>

namespace omentum::render {

std::string parse_size(const std::string& text, Size& size) {
  char rest = 0;
  const int found = std::sscanf(text.c_str(), "%dx%d%c", &size.width, &size.height, &rest);
  if (found == 2 && size.width >= 64 && size.height >= 64 && size.width <= 8192 && size.height <= 8192)
    return {};
  return "found " + text + ", expected WIDTHxHEIGHT from 64x64 to 8192x8192";
}

std::string parse_ui_scale(const std::string& text, float& scale) {
  char rest = 0;
  float value = 0;
  if (std::sscanf(text.c_str(), "%f%c", &value, &rest) != 1 || !(value >= 0.5f && value <= 4.0f))
    return "found " + text + ", expected 0.5 to 4";
  scale = value;
  return {};
}

std::string parse_record(const std::string& text, double& fps) {
  char rest = 0;
  double value = 0;
  if (std::sscanf(text.c_str(), "%lf%c", &value, &rest) != 1 || !(value >= 1 && value <= 120))
    return "found " + text + ", expected 1 to 120 pictures a second";
  fps = value;
  return {};
}

std::string parse_map(const std::string& text, TissueMap& map) {
  for (const TissueMap known : {TissueMap::kStrain, TissueMap::kStress}) {
    if (text != word(known)) continue;
    map = known;
    return {};
  }
  return "found " + text + ", expected strain or stress";
}

void add_window_options(runtime::CommandLine& line, RenderOptions& options) {
  line.flag("--pairs", options.touches, "mark parts of organs that touch (key T switches)");
  line.option(
          "--ui-scale", [&](const std::string& text) { return parse_ui_scale(text, options.ui_scale); },
          "of the panel, 0.5 to 4 (default: as monitor and picture ask for)")
      .type_name("SCALE");
  line.option(
          "--record",
          [&](const std::string& text) {
            options.record = true;
            return parse_record(text, options.record_fps);
          },
          "record a video's pictures from the start, so many a second; else when a person asks (key V)")
      .type_name("FPS");
}

}  // namespace omentum::render
