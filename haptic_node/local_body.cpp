#include "haptic_node/local_body.h"

#include "physics/compliance_tiles.h"
#include "transport/messages.h"

#include <Eigen/Cholesky>

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

// Where the nodes would be without forces: positions - C forces.
std::vector<Vec3> rest_of(const LocalPatch& patch, const physics::SurfaceCompliance& compliance) {
  std::vector<Vec3> rest = patch.positions;
  for (SurfaceId k(0); k < compliance.mobile_count(); k = SurfaceId(k + 1)) {
    const Vec3& load = patch.forces[static_cast<std::size_t>(k)];
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
  return {std::move(surface), std::move(rest), std::move(compliance), patch.nodes};
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

bool in_a_scene(const Vec3& position) {
  constexpr double kFarthest_m = 1000;
  return position.allFinite() && position.cwiseAbs().maxCoeff() <= kFarthest_m;
}

bool all_finite(const LocalPatch& patch) {
  return std::ranges::all_of(patch.positions, in_a_scene) &&
         std::ranges::all_of(patch.forces, [](const Vec3& f) { return f.allFinite(); }) &&
         std::ranges::all_of(patch.compliance, [](float c) { return std::isfinite(c); });
}

bool spans_an_area(const LocalPatch& patch, const geometry::Triangle& t) {
  constexpr double kLeastArea_m2 = 1e-12;
  const auto x = [&](int v) { return patch.positions[static_cast<std::size_t>(t[v])]; };
  return 0.5 * (x(1) - x(0)).cross(x(2) - x(0)).norm() > kLeastArea_m2;
}

// Whether every triangle's corners are nodes, apart from each other, and every node is a corner.
bool nodes_are_corners(const LocalPatch& patch) {
  const auto count = static_cast<std::int32_t>(patch.positions.size());
  std::vector<bool> corner(patch.positions.size(), false);
  for (const geometry::Triangle& t : patch.triangles) {
    if (std::ranges::any_of(t, [count](SurfaceId n) { return n < 0 || n >= count; })) return false;
    if (!spans_an_area(patch, t)) return false;
    for (const SurfaceId n : t) corner[static_cast<std::size_t>(n)] = true;
  }
  return std::ranges::all_of(corner, std::identity{});
}

// Positive definite but for the rounding of floats.
bool is_passive(const LocalPatch& patch) {
  constexpr double kRounding = 1e-5;
  const auto size = static_cast<Eigen::Index>(3 * patch.positions.size());
  Eigen::MatrixXd C(size, size);
  for (Eigen::Index i = 0; i < size; ++i) {
    for (Eigen::Index j = 0; j < size; ++j)
      C(i, j) = entry(patch, static_cast<std::size_t>(i), static_cast<std::size_t>(j));
  }
  if (!(C.diagonal().minCoeff() > 0)) return false;
  C.diagonal().array() += kRounding * C.diagonal().maxCoeff();
  return Eigen::LLT<Eigen::MatrixXd>(C).info() == Eigen::Success;
}

std::optional<std::string> wrong_size(const LocalPatch& patch) {
  constexpr std::size_t kMostTriangles = msg::MAX_LOCAL_CORNERS / 3;
  const std::size_t n = patch.positions.size(), floats = 3 * n * (3 * n + 1) / 2;
  if (n < 3 || n > msg::MAX_LOCAL_NODES)
    return std::to_string(n) + " nodes, expected 3 to " + std::to_string(msg::MAX_LOCAL_NODES);
  if (patch.triangles.size() > kMostTriangles)
    return std::to_string(patch.triangles.size()) + " triangles, expected at most " +
           std::to_string(kMostTriangles);
  if (patch.forces.size() != n || patch.nodes.size() != n || patch.compliance.size() != floats)
    return "forces, node numbers or compliance are not of " + std::to_string(n) + " nodes";
  return std::nullopt;
}

}  // namespace

std::optional<std::string> reason_against(const LocalPatch& patch, std::size_t organ_count) {
  if (patch.organ >= organ_count)
    return "organ " + std::to_string(patch.organ) + ", which the scene does not have";
  if (auto why = wrong_size(patch)) return why;
  if (!all_finite(patch)) return "a number that is not finite, or a position outside of any scene";
  if (!nodes_are_corners(patch)) return "its triangles do not have its nodes as corners, or have no area";
  if (!is_passive(patch)) return "a compliance that is not positive definite";
  if (!std::ranges::all_of(elastic_surface(patch).rest, in_a_scene))
    return "forces that would move it out of any scene";
  return std::nullopt;
}

std::unique_ptr<Body> make_local_body(const LocalPatch& patch) {
  return std::make_unique<LocalBody>(patch);
}

}  // namespace omentum::haptic
