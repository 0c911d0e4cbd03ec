#include "haptic_node/local_body.h"

#include "physics/compliance_tiles.h"

#include <algorithm>

namespace omentum::haptic {
namespace {

// Where row i of the upper triangle of a symmetric matrix of `size` rows begins, less i: C_ij is at [.. + j].
std::size_t row_of(std::size_t i, std::size_t size) {
  return i * size - i * (i + 1) / 2;
}

float entry(const LocalPatch& patch, std::size_t i, std::size_t j) {
  return patch.compliance[row_of(std::min(i, j), 3 * patch.positions.size()) + std::max(i, j)];
}

// C as SurfaceCompliance keeps it, with the memory that it lies in.
physics::SurfaceCompliance compliance_of(const LocalPatch& patch, const geometry::Surface& surface) {
  using Tiles = physics::ComplianceTiles<float>;
  struct alignas(64) Line {
    std::array<float, physics::SurfaceCompliance::kLanes> lanes{};
  };
  struct Memory {
    std::vector<Line> tiles;
    std::vector<float> bounds, scratch;
  };
  const auto memory = std::make_shared<Memory>();
  Tiles tiles{surface.mobile_count, nullptr};
  const auto nodes = patch.positions.size(), clusters = static_cast<std::size_t>(tiles.cluster_count());
  memory->tiles.resize(tiles.size() / Tiles::kLanes);
  memory->bounds.resize(nodes * clusters);
  memory->scratch.resize(clusters * Tiles::kLanes);
  tiles.values = memory->tiles.front().lanes.data();
  const physics::ClusterReach reach = physics::cluster_reach(surface);
  for (std::size_t k = 0; k < nodes; ++k) {
    for (std::size_t n = 0; n < nodes; ++n) {
      for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j)
          tiles.at(static_cast<std::int32_t>(n), i, static_cast<std::int32_t>(k), j) =
              entry(patch, 3 * n + static_cast<std::size_t>(i), 3 * k + static_cast<std::size_t>(j));
      }
    }
    physics::bound_column(tiles, reach, static_cast<std::int32_t>(k), &memory->bounds[k * clusters],
                          memory->scratch);
  }
  return {tiles.mobile_count, tiles.values, memory->bounds.data(), memory};
}

// Where the nodes would be without forces: positions - C load.
std::vector<Vec3> rest_of(const LocalPatch& patch, const physics::SurfaceCompliance& compliance) {
  std::vector<Vec3> rest = patch.positions;
  for (SurfaceId k(0); k < compliance.mobile_count(); k = SurfaceId(k + 1)) {
    const Vec3& load = patch.load[static_cast<std::size_t>(k)];
    if (load.isZero(0)) continue;
    for (SurfaceId n(0); n < compliance.mobile_count(); n = SurfaceId(n + 1))
      rest[static_cast<std::size_t>(n)] -= compliance.block(n, k) * load;
  }
  return rest;
}

ElasticSurface elastic_surface(const LocalPatch& patch) {
  geometry::Surface surface =
      geometry::surface_of_triangles(static_cast<std::int32_t>(patch.positions.size()), patch.triangles);
  physics::SurfaceCompliance compliance = compliance_of(patch, surface);
  std::vector<Vec3> rest = rest_of(patch, compliance);
  return {std::move(surface), std::move(rest), std::move(compliance), patch.file_node};
}

// Made before the surface that refers to it.
struct OwnedSurface {
  ElasticSurface elastic;
};

class LocalBody final : private OwnedSurface, public DeformedSurface {
 public:
  explicit LocalBody(const LocalPatch& patch)
      : OwnedSurface{elastic_surface(patch)},
        DeformedSurface(elastic.surface, elastic.rest, elastic.compliance,
                        {patch.organ, patch.topology_version, elastic.file_node}) {}
};

bool all_finite(const LocalPatch& patch) {
  const auto finite = [](const Vec3& v) { return v.allFinite(); };
  return std::ranges::all_of(patch.positions, finite) && std::ranges::all_of(patch.load, finite) &&
         std::ranges::all_of(patch.compliance, [](float c) { return std::isfinite(c); });
}

// Whether every triangle's corners are nodes, and every node is a corner.
bool nodes_are_corners(const LocalPatch& patch) {
  std::vector<bool> corner(patch.positions.size(), false);
  for (const geometry::Triangle& t : patch.triangles) {
    for (const SurfaceId n : t) {
      if (n < 0 || static_cast<std::size_t>(n) >= corner.size()) return false;
      corner[static_cast<std::size_t>(n)] = true;
    }
  }
  return std::ranges::all_of(corner, std::identity{});
}

// C_ii > 0 and |C_ij| <= sqrt(C_ii C_jj): what every compliance keeps, and what an energy cannot do without.
bool is_passive(const LocalPatch& patch) {
  const std::size_t size = 3 * patch.positions.size();
  for (std::size_t i = 0; i < size; ++i) {
    const double own = entry(patch, i, i);
    if (!(own > 0)) return false;
    for (std::size_t j = 0; j < i; ++j) {
      const double c = entry(patch, i, j);
      if (c * c > own * entry(patch, j, j)) return false;
    }
  }
  return true;
}

}  // namespace

std::optional<std::string> reason_against(const LocalPatch& patch) {
  const std::size_t n = patch.positions.size();
  if (n < 3 || n > kMaxPatchNodes)
    return std::to_string(n) + " nodes, expected 3 to " + std::to_string(kMaxPatchNodes);
  if (patch.load.size() != n || patch.file_node.size() != n ||
      patch.compliance.size() != 3 * n * (3 * n + 1) / 2)
    return "load, node numbers or compliance are not of " + std::to_string(n) + " nodes";
  if (!nodes_are_corners(patch)) return "its triangles do not have its nodes as corners";
  if (!all_finite(patch)) return "a number that is not finite";
  if (!is_passive(patch))
    return "a compliance that no tissue has (not positive, or larger beside than at a node)";
  return std::nullopt;
}

std::unique_ptr<Body> make_local_body(const LocalPatch& patch) {
  return std::make_unique<LocalBody>(patch);
}

}  // namespace omentum::haptic
