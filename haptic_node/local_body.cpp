#include "haptic_node/local_body.h"

#include "node_common/contact_bounds.h"
#include "physics/compliance_tiles.h"
#include "transport/messages.h"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <Eigen/SVD>

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

// In which direction tissue pushes: the normals of the organ's own shape, as DeformedSurface has them, turned
// as the patch has turned. Those of the shape without forces would be a funnel's, since most of a dent is by
// the organ's own motion. A gut, whose wall alone dents, is bent away from what it was at the start instead.
std::vector<Vec3> normals_of(const LocalPatch& patch, const ElasticSurface& elastic) {
  if (patch.at_rest.empty() || patch.bends_freely)
    return geometry::surface_normals(elastic.surface, elastic.rest);
  const auto columns = [](const std::vector<Vec3>& points) {
    return Eigen::Map<const Eigen::Matrix3Xd>(points.front().data(), 3, std::ssize(points));
  };
  const Eigen::Matrix3d turn =
      Eigen::umeyama(columns(patch.at_rest), columns(elastic.rest), false).topLeftCorner<3, 3>();
  std::vector<Vec3> normals = geometry::surface_normals(elastic.surface, patch.at_rest);
  for (Vec3& normal : normals) normal = turn * normal;
  return normals;
}

double seconds(std::int64_t from_ns, std::int64_t to_ns) {
  return 1e-9 * static_cast<double>(to_ns - from_ns);
}

class LocalBody final : private OwnedSurface, public DeformedSurface {
 public:
  explicit LocalBody(const LocalPatch& patch)
      : OwnedSurface{elastic_surface(patch)},
        DeformedSurface(elastic.surface, elastic.rest, elastic.compliance,
                        {patch.organ, patch.topology_version, elastic.file_node, patch.tool}),
        arrival_ns_(patch.arrival_ns),
        begin_(elastic.rest),
        velocities_(patch.velocities),
        at_rest_(patch.at_rest.empty() ? begin_ : patch.at_rest),
        pushes_(normals_of(patch, elastic)),
        apart_(begin_.size(), Vec3::Zero()),
        drifts_(begin_.size()) {
    velocities_.resize(begin_.size(), Vec3::Zero());
  }

  void go_on(std::int64_t now_ns) noexcept override {
    const double age_s = std::clamp(seconds(arrival_ns_, now_ns), 0.0, kLongestDrift_s);
    const double left = std::clamp(1 - seconds(replaced_ns_, now_ns) / kBlend_s, 0.0, 1.0);
    double most_m = 0;
    for (std::size_t n = 0; n < begin_.size(); ++n) {
      const Vec3 at = begin_[n] + age_s * velocities_[n] + left * apart_[n];
      drifts_[n] = {at - elastic.rest[n], (left - left_) * apart_[n]};
      elastic.rest[n] = at;
      most_m = std::max(most_m, drifts_[n].way.norm());
    }
    left_ = left;
    rest_moved(most_m);
  }

  // What the old one did in this tick is not lost with it.
  void continue_from(Body& old, std::int64_t now_ns) noexcept override {
    go_on(now_ns);
    const std::span<const std::uint32_t> numbers = old.origin().file_node;
    double most_m = 0;
    for (std::size_t n = 0; n < begin_.size(); ++n) {
      const auto same = std::ranges::find(numbers, elastic.file_node[n]);
      drifts_[n] = {};
      if (same == numbers.end()) continue;
      const SurfaceId there(static_cast<std::size_t>(same - numbers.begin()));
      apart_[n] = old.position(there) - position(SurfaceId(n));
      drifts_[n] = old.drift(there);
      most_m = std::max(most_m, apart_[n].norm());
    }
    for (std::size_t n = 0; n < begin_.size(); ++n) elastic.rest[n] += apart_[n];
    replaced_ns_ = now_ns;
    left_ = 1;
    rest_moved(most_m);
  }

  Drift drift(SurfaceId node) const noexcept override { return drifts_[static_cast<std::size_t>(node)]; }
  Vec3 moved_without_forces(SurfaceId node) const noexcept override {
    return elastic.rest[static_cast<std::size_t>(node)] - at_rest_[static_cast<std::size_t>(node)];
  }

  void find_place(const SurfacePoint& point, Place& place) noexcept override {
    DeformedSurface::find_place(point, place);
    const geometry::Triangle& t = surface().triangles[point.triangle];
    Vec3 push = Vec3::Zero();
    for (int v = 0; v < 3; ++v) {
      push += point.barycentric[v] * pushes_[static_cast<std::size_t>(t[v])];
      const Drift& of_node = drifts_[static_cast<std::size_t>(t[v])];
      place.drift.way += point.barycentric[v] * of_node.way;
      place.drift.blend += point.barycentric[v] * of_node.blend;
    }
    if (push.squaredNorm() > 0) place.normal = push.normalized();
  }

  std::optional<SurfacePoint> point_among(std::span<const std::uint32_t> file_nodes,
                                          const Vec3& barycentric) const noexcept override {
    std::array<SurfaceId, 3> corners;
    for (std::size_t v = 0; v < corners.size(); ++v) {
      const auto found = std::ranges::find(elastic.file_node, file_nodes[v]);
      if (found == elastic.file_node.end()) return std::nullopt;
      corners[v] = SurfaceId(static_cast<std::size_t>(found - elastic.file_node.begin()));
    }
    for (const TriangleId t : surface().triangles_of(corners[0])) {
      SurfacePoint point{t, Vec3::Zero()};
      int met = 0;
      for (int v = 0; v < 3; ++v) {
        const auto at = std::ranges::find(corners, surface().triangles[t][v]);
        if (at == corners.end()) break;
        point.barycentric[v] = barycentric[at - corners.begin()];
        ++met;
      }
      if (met == 3) return point;
    }
    return std::nullopt;
  }

 private:
  std::int64_t arrival_ns_, replaced_ns_ = 0;
  std::vector<Vec3> begin_, velocities_;  // [n] without forces: where it was at its arrival, m, and m/s
  std::vector<Vec3> at_rest_;             // [n] in the organ's file, m
  std::vector<Vec3> pushes_;              // [n] normals, unit
  std::vector<Vec3> apart_;               // [n] to where the replaced one stood, m
  std::vector<Drift> drifts_;             // [n] in this tick
  double left_ = 0;                       // of the way between both
};

bool in_a_scene(const Vec3& position) {
  constexpr double kFarthest_m = 1000;
  return position.allFinite() && position.cwiseAbs().maxCoeff() <= kFarthest_m;
}

// Faster no tissue swings; NaN and infinity are no speed and no compliance.
constexpr double kFastest_m_s = 10;

bool all_finite(const LocalPatch& patch) {
  return std::ranges::all_of(patch.positions, in_a_scene) &&
         std::ranges::all_of(patch.forces, [](const Vec3& f) { return f.allFinite(); }) &&
         std::ranges::all_of(patch.velocities, [](const Vec3& v) { return v.norm() <= kFastest_m_s; }) &&
         std::ranges::all_of(patch.compliance, [](float c) { return std::abs(c) <= node::kSoftest_m_n; });
}

bool spans_an_area(std::span<const Vec3> positions, const geometry::Triangle& t) {
  constexpr double kLeastArea_m2 = 1e-12;
  const auto x = [&](int v) { return positions[static_cast<std::size_t>(t[v])]; };
  return 0.5 * (x(1) - x(0)).cross(x(2) - x(0)).norm() > kLeastArea_m2;
}

// Whether every triangle's corners are nodes, apart from each other, and every node is a corner.
bool nodes_are_corners(const LocalPatch& patch) {
  const auto count = static_cast<std::int32_t>(patch.positions.size());
  std::vector<bool> corner(patch.positions.size(), false);
  for (const geometry::Triangle& t : patch.triangles) {
    if (std::ranges::any_of(t, [count](SurfaceId n) { return n < 0 || n >= count; })) return false;
    if (!spans_an_area(patch.positions, t)) return false;
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
  if (patch.forces.size() != n || patch.nodes.size() != n || patch.compliance.size() != floats ||
      (!patch.velocities.empty() && patch.velocities.size() != n) ||
      (!patch.at_rest.empty() && patch.at_rest.size() != n))
    return "forces, velocities, node numbers or compliance are not of " + std::to_string(n) + " nodes";
  return std::nullopt;
}

}  // namespace

std::optional<std::string> reason_against(const LocalPatch& patch, std::size_t organ_count) {
  if (patch.organ >= organ_count)
    return "organ " + std::to_string(patch.organ) + ", which the scene does not have";
  if (auto why = wrong_size(patch)) return why;
  if (!all_finite(patch)) return "a number that is not finite, outside of any scene, too fast or too soft";
  if (!nodes_are_corners(patch)) return "its triangles do not have its nodes as corners, or have no area";
  if (!is_passive(patch)) return "a compliance that is not positive definite";
  const ElasticSurface at_rest = elastic_surface(patch);
  const auto is_one = [&](const geometry::Triangle& t) { return spans_an_area(at_rest.rest, t); };
  if (!std::ranges::all_of(at_rest.rest, in_a_scene) || !std::ranges::all_of(patch.triangles, is_one))
    return "forces that would move it out of any scene, or crush it";
  return std::nullopt;
}

std::unique_ptr<Body> make_local_body(const LocalPatch& patch) {
  return std::make_unique<LocalBody>(patch);
}

}  // namespace omentum::haptic
