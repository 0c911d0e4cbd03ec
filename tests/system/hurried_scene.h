// A scene of the project whose hands go faster along their waypoints than it says: tests wait less.
#pragma once

#include "tests/system/session_on_trial.h"

#include <fstream>

namespace omentum::test {

/// A scene's text with the hands' waypoints so many times as fast.
inline std::string hurried(const std::string& text, double times) {
  const std::string key = "seconds = ";
  std::string faster;
  std::size_t from = 0;
  for (std::size_t at; (at = text.find(key, from)) != std::string::npos;) {
    const std::size_t number = at + key.size();
    std::size_t digits = 0;
    const double seconds = std::stod(text.substr(number), &digits);
    faster += text.substr(from, number - from) + std::to_string(seconds / times);
    from = number + digits;
  }
  return faster + text.substr(from);
}

/// scenes/NAME.toml, made ready in `folder` as by prepare_scene().
inline std::string prepare_hurried(const std::string& name, double times,
                                   const std::filesystem::path& folder) {
  const std::string scene = prepare_scene(OMENTUM_SOURCE_DIR "/scenes/" + name + ".toml", {}, folder);
  const std::string text = hurried(read_text(scene), times);
  std::ofstream(scene) << text;
  return scene;
}

}  // namespace omentum::test
