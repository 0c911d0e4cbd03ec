// A made-up organ for deform_node's tests: random symmetric compliance, no mesh behind it.
#pragma once

#include "deform_node/contact_book.h"
#include "geometry/surface.h"
#include "physics/surface_compliance.h"

#include <memory>
#include <random>
#include <vector>

namespace omentum::deform_test {

using geometry::NodeId;
using geometry::SurfaceId;
using geometry::Vec3;

inline constexpr std::int64_t kNs_per_s = 1'000'000'000;

/// C with entries of about 1e-4 m/N (soft tissue), C_nk = C_kn^T.
inline physics::SurfaceCompliance random_compliance(std::int32_t mobile, unsigned seed) {
  constexpr int kLanes = physics::SurfaceCompliance::kLanes;
  constexpr int kTile = physics::SurfaceCompliance::kTileFloats;
  const std::int32_t clusters = (mobile + kLanes - 1) / kLanes;
  struct Storage {
    std::vector<float> tiles, bounds;
  };
  auto storage = std::make_shared<Storage>();
  storage->tiles.resize(static_cast<std::size_t>(mobile) * clusters * kTile + kLanes);
  storage->bounds.assign(static_cast<std::size_t>(mobile) * clusters, 1.0F);
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> entry(-1e-4F, 1e-4F);
  // the tiles are 64-byte aligned: the kernels load whole lines
  float* tiles = storage->tiles.data();
  while (reinterpret_cast<std::uintptr_t>(tiles) % 64 != 0) ++tiles;
  const auto at = [&](std::int32_t n, std::int32_t k, int i, int j) -> float& {
    const std::size_t tile = (static_cast<std::size_t>(k) * clusters + n / kLanes) * kTile;
    return tiles[tile + static_cast<std::size_t>(3 * i + j) * kLanes + n % kLanes];
  };
  for (std::int32_t n = 0; n < mobile; ++n)
    for (std::int32_t k = 0; k <= n; ++k)
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) at(n, k, i, j) = at(k, n, j, i) = entry(random);
  return {mobile, tiles, storage->bounds.data(), storage};
}

/// Node 2 n + 1 of the mesh, and of its file, is surface node n; even ones are inside.
inline geometry::Surface odd_surface(std::int32_t surface_nodes) {
  geometry::Surface surface;
  surface.of_node.resize(2 * static_cast<std::size_t>(surface_nodes) + 1);
  for (std::int32_t n = 0; n < surface_nodes; ++n) {
    surface.node.emplace_back(2 * n + 1);
    surface.of_node[surface.node.back()] = SurfaceId(n);
  }
  return surface;
}

/// How contacts with it are read. The last `pinned` surface nodes are held.
inline deform::OrganNumbers odd_numbers(std::int32_t surface_nodes, std::int32_t pinned) {
  deform::OrganNumbers numbers;
  const geometry::Surface surface = odd_surface(surface_nodes);
  numbers.surface_of_node = surface.of_node;
  for (std::size_t n = 0; n < surface.of_node.size(); ++n) {
    numbers.node_of_file.emplace_back(n);
    numbers.pinned.push_back(surface.of_node[n] >= surface_nodes - pinned);
  }
  return numbers;
}

inline NodeId node_of(std::int32_t surface_node) {
  return NodeId(2 * surface_node + 1);
}
inline std::uint32_t file_node(std::int32_t surface_node) {
  return static_cast<std::uint32_t>(node_of(surface_node));
}

/// A contact of `tool` that pushes each surface node with its force.
inline msg::Contact contact_on(std::uint32_t tool, const std::vector<std::int32_t>& surface_nodes,
                               const std::vector<Vec3>& forces) {
  msg::Contact contact{};
  contact.tool = tool;
  contact.cause = {.tool = tool, .seq = 100 + tool, .stamp_ns = 7};
  for (const std::int32_t n : surface_nodes) contact.nodes.push_back(file_node(n));
  for (const Vec3& f : forces) contact.forces.push_back({f.x(), f.y(), f.z()});
  contact.displacements.resize(forces.size());
  return contact;
}

}  // namespace omentum::deform_test
