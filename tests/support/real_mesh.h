// Real meshes for programs that are run by hand.
#pragma once

#include "tests/support/meshes.h"

#include <cstdio>
#include <optional>

namespace omentum::test {

/// A mesh of the real data beside the repository, whose unit is so many metres; none, said on stdout, where
/// it is absent. Throws where it is no mesh.
inline std::optional<geometry::TetraMesh> real_mesh(const std::string& name, double unit_m) {
  const std::filesystem::path file = data_file(name);
  if (std::filesystem::exists(file)) return geometry::check_mesh(geometry::read_mesh(file), unit_m).mesh;
  std::printf("%s is absent and left out\n", file.c_str());
  return std::nullopt;
}

}  // namespace omentum::test
