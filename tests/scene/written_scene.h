// Scenes that tests write.
#pragma once

#include "scene/scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>

namespace omentum::scene {

/// A scene with everything that is required, one key a line, so that a test can replace one of them.
inline const std::string kGood = R"(name = "test"
[[organs]]
name = "liver"
mesh = "meshes/liver.msh"
young_pa = 12000
poisson = 0.45
density_kg_m3 = 1060
fixed = "plane:x<0.03"
[[tools]]
id = 2
name = "probe"
shape = "probe"
points = [[0, 0, 0], [0, 0.001, 0]]
[[hands]]
tool = 2
press_point = [0, 0, 0.1]
press_normal = [0, 0, 1]
)";

inline std::filesystem::path write_scene(const std::string& text) {
  const auto* info = ::testing::UnitTest::GetInstance()->current_test_info();
  std::string name = std::string(info->test_suite_name()) + "_" + info->name() + ".toml";
  std::replace(name.begin(), name.end(), '/', '_');
  const auto file = std::filesystem::path(::testing::TempDir()) / name;
  std::ofstream(file) << text;
  return file;
}

inline std::string with(const std::string& line, const std::string& replacement) {
  std::string text = kGood;
  const auto at = text.find(line);
  EXPECT_NE(at, std::string::npos) << line;
  return text.replace(at, line.size(), replacement);
}

inline std::string message_of(const std::filesystem::path& file) {
  try {
    load_scene(file);
  } catch (const std::runtime_error& e) {
    return e.what();
  }
  return "accepted";
}

}  // namespace omentum::scene
