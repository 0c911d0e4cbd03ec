// Force tensors in memory, for tests of what reads them.
#pragma once

#include "physics/force_tensors.h"

#include <gtest/gtest.h>

#include <memory>

namespace omentum::test {

/// Those of a surface, in float, as an organ file has them.
inline physics::SurfaceCompliance tensors_of(const physics::Stiffness& stiffness,
                                             const physics::FixedComponents& fixed,
                                             const geometry::Surface& surface) {
  struct Storage {
    std::vector<float> tiles, bounds;
  };
  auto storage = std::make_shared<Storage>();
  physics::ComplianceTiles<float> tiles{surface.mobile_count, nullptr};
  constexpr std::size_t kLine = 64;
  storage->tiles.resize(tiles.size() + kLine / sizeof(float));
  storage->bounds.resize(static_cast<std::size_t>(tiles.mobile_count) * tiles.cluster_count());
  void* begin = storage->tiles.data();
  std::size_t room = storage->tiles.size() * sizeof(float);
  tiles.values = static_cast<float*>(std::align(kLine, tiles.size() * sizeof(float), begin, room));
  const physics::FreeDofs free = physics::free_dofs(fixed);
  const physics::StiffnessFactor factor(stiffness, free);
  EXPECT_TRUE(physics::compute_force_tensors(factor, free, surface, tiles, storage->bounds, {}));
  return {tiles.mobile_count, tiles.values, storage->bounds.data(), storage};
}

}  // namespace omentum::test
