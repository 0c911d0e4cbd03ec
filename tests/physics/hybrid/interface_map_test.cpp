#include "physics/hybrid/interface_map.h"

#include "physics/direct_solve.h"
#include "physics/dynamics/implicit_step.h"
#include "physics/hybrid/condensed_stiffness.h"
#include "tests/physics/dynamics/force_law_properties.h"
#include "tests/support/meshes.h"
#include "tests/support/tensors.h"

namespace omentum::physics {
namespace {

using geometry::NodeId;
using geometry::SurfaceId;

constexpr Material kSoft{5000, 0.3, 1050};
constexpr double kBorderX_m = 0.06, kWidth_m = 0.03;
const Vec3 kPull(0.3, -0.1, -0.2);

/// A bar that is held at its fine end, precomputed up to the middle; its coarse other half meets it there
/// with nodes of its own.
class InterfaceMapTest : public testing::Test {
 protected:
  InterfaceMapTest() {
    for (Vec3& p : coarse_.positions) p.x() += kBorderX_m;
    for (const Vec3& p : fine_.positions) fixed_.push_back(p.x() == 0 ? kPinned : 0);
    boundary_ = geometry::extract_surface(coarse_, {});
    surface_ = geometry::extract_surface(fine_, pinned_nodes(fixed_));
    std::vector<std::int32_t> place(surface_.node.size(), -1);
    for (std::size_t s = 0; s < surface_.node.size(); ++s) {
      if (std::abs(fine_.positions[surface_.node[s]].x() - kBorderX_m) > 1e-12) continue;
      place[s] = static_cast<std::int32_t>(slaves_.size());
      connection_.emplace_back(s);
      slaves_.push_back(fine_.positions[surface_.node[s]]);
    }
    for (const geometry::Triangle& t : surface_.triangles) {
      const std::array face{place[static_cast<std::size_t>(t[0])], place[static_cast<std::size_t>(t[1])],
                            place[static_cast<std::size_t>(t[2])]};
      if (std::ranges::all_of(face, [](std::int32_t s) { return s >= 0; })) faces_.push_back(face);
    }
  }

  InterfaceMap pointwise() const { return tie_pointwise(coarse_, boundary_, slaves_); }
  InterfaceMap mortar() const { return tie_by_mortar(coarse_, boundary_, slaves_, faces_); }

  // What a uniform pressure on the border does to the nodes of one side, by area.
  template <class Faces, class Place>
  static std::vector<double> areas(const Faces& faces, std::size_t count, Place&& place) {
    std::vector<double> shares(count);
    for (const auto& f : faces) {
      const double area = (place(f[1]) - place(f[0])).cross(place(f[2]) - place(f[0])).norm() / 2;
      for (const auto n : f) shares[static_cast<std::size_t>(n)] += area / 3;
    }
    return shares;
  }
  /// How far forces of a uniform stress are, once passed on, from those that the coarse faces take from it;
  /// of the largest.
  double patch_error(const InterfaceMap& map) const {
    const std::vector<double> fine =
        areas(faces_, slaves_.size(), [&](std::int32_t s) { return slaves_[static_cast<std::size_t>(s)]; });
    std::vector<std::array<std::int32_t, 3>> border;
    for (const geometry::Triangle& t : boundary_.triangles) {
      const auto node = [&](SurfaceId s) { return static_cast<std::int32_t>(boundary_.node[s]); };
      const std::array face{node(t[0]), node(t[1]), node(t[2])};
      if (std::ranges::all_of(face, [&](std::int32_t n) {
            return coarse_.positions[static_cast<std::size_t>(n)].x() < kBorderX_m + 1e-12;
          }))
        border.push_back(face);
    }
    const std::vector<double> expected = areas(border, coarse_.positions.size(), [&](std::int32_t n) {
      return coarse_.positions[static_cast<std::size_t>(n)];
    });
    const Eigen::VectorXd passed =
        map.P.transpose() * Eigen::Map<const Eigen::VectorXd>(fine.data(), map.P.rows());
    double off = 0;
    for (std::size_t m = 0; m < map.masters.size(); ++m)
      off = std::max(off, std::abs(passed[static_cast<Eigen::Index>(m)] - expected[map.masters[m]]));
    return off / *std::ranges::max_element(expected);
  }
  /// Where the coarse half's nodes rest under a pull at its end.
  std::vector<Vec3> rest(const InterfaceMap& map) const {
    const SurfaceCompliance compliance = test::tensors_of(assemble_stiffness(fine_, kSoft), fixed_, surface_);
    const ComplianceTiles<const float> tiles{compliance.mobile_count(), compliance.tile(SurfaceId(0), 0)};
    const Eigen::MatrixXd S = condensed_stiffness(compliance_among(tiles, connection_));
    const Stiffness K = with_added(assemble_stiffness(coarse_, kSoft), tied(map, S));
    return direct_solve(K, FixedComponents(coarse_.positions.size(), 0), {}, pull(coarse_)).displacements;
  }
  /// The same of the same two meshes as one model, neither part condensed: K u + B^T l = f with multipliers l
  /// that hold u_s = P u_m.
  std::vector<Vec3> rest_with_multipliers(const InterfaceMap& map) const {
    const auto fine = static_cast<Eigen::Index>(3 * fine_.positions.size());
    const auto all = fine + static_cast<Eigen::Index>(3 * coarse_.positions.size());
    const auto ties = static_cast<Eigen::Index>(3 * slaves_.size());
    Eigen::MatrixXd K = Eigen::MatrixXd::Zero(all + ties, all + ties);
    add_dense(assemble_stiffness(fine_, kSoft), 0, K);
    add_dense(assemble_stiffness(coarse_, kSoft), fine, K);
    const auto tie = [&](Eigen::Index constraint, Eigen::Index node_row, double share) {
      for (Eigen::Index i = 0; i < 3; ++i)
        K(all + constraint + i, node_row + i) = K(node_row + i, all + constraint + i) = share;
    };
    for (std::size_t s = 0; s < slaves_.size(); ++s) {
      const auto row = static_cast<Eigen::Index>(3 * s);
      tie(row, 3 * static_cast<Eigen::Index>(surface_.node[connection_[s]]), 1);
      for (std::size_t m = 0; m < map.masters.size(); ++m)
        tie(row, fine + 3 * static_cast<Eigen::Index>(map.masters[m]),
            -map.P(static_cast<Eigen::Index>(s), static_cast<Eigen::Index>(m)));
    }
    for (Eigen::Index c = 0; c < fine; ++c) {
      if (fixed_[static_cast<std::size_t>(c / 3)] == 0) continue;
      K.row(c).setZero();
      K.col(c).setZero();
      K(c, c) = 1;
    }
    const std::vector<Vec3> loads = pull(coarse_);
    Eigen::VectorXd f = Eigen::VectorXd::Zero(all + ties);
    for (std::size_t n = 0; n < loads.size(); ++n)
      f.segment<3>(fine + static_cast<Eigen::Index>(3 * n)) = loads[n];
    const Eigen::VectorXd u = K.partialPivLu().solve(f);
    std::vector<Vec3> displacements;
    for (Eigen::Index c = fine; c < all; c += 3) displacements.emplace_back(u.segment<3>(c));
    return displacements;
  }
  static void add_dense(const Stiffness& K, Eigen::Index first, Eigen::MatrixXd& sum) {
    for (std::int32_t n = 0; n < K.node_count(); ++n)
      for (std::int32_t b = K.start[n]; b < K.start[n + 1]; ++b)
        sum.block<3, 3>(first + 3 * n, first + 3 * static_cast<Eigen::Index>(K.neighbour[b])) += K.block[b];
  }
  static std::vector<Vec3> pull(const geometry::TetraMesh& mesh) {
    std::vector<Vec3> loads(mesh.positions.size(), Vec3::Zero());
    std::vector<std::size_t> end;
    for (std::size_t n = 0; n < loads.size(); ++n)
      if (mesh.positions[n].x() > 2 * kBorderX_m - 1e-12) end.push_back(n);
    for (const std::size_t n : end) loads[n] = kPull / static_cast<double>(end.size());
    return loads;
  }

  geometry::TetraMesh fine_ = test::make_box_mesh(10, 5, 5, {kBorderX_m, kWidth_m, kWidth_m});
  geometry::TetraMesh coarse_ = test::make_box_mesh(4, 2, 2, {kBorderX_m, kWidth_m, kWidth_m});
  FixedComponents fixed_;
  geometry::Surface boundary_, surface_;
  std::vector<SurfaceId> connection_;
  std::vector<Vec3> slaves_;
  std::vector<std::array<std::int32_t, 3>> faces_;
};

TEST_F(InterfaceMapTest, LinearFieldsAreReproducedAlsoBesideTheCoarseBoundary) {
  std::vector<Vec3> beside = slaves_;
  for (std::size_t s = 0; s < beside.size(); ++s) beside[s].x() += s % 2 == 0 ? 1e-3 : -1e-3;
  const auto expect_linear = [&](const InterfaceMap& map, const std::vector<Vec3>& places) {
    for (Eigen::Index s = 0; s < map.P.rows(); ++s) {
      Vec3 place = Vec3::Zero();
      for (std::size_t m = 0; m < map.masters.size(); ++m)
        place += map.P(s, static_cast<Eigen::Index>(m)) * coarse_.positions[map.masters[m]];
      EXPECT_NEAR(map.P.row(s).sum(), 1, 1e-10);
      EXPECT_LE((place - places[static_cast<std::size_t>(s)]).norm(), 1e-10);
    }
  };
  expect_linear(pointwise(), slaves_);
  expect_linear(mortar(), slaves_);
  expect_linear(tie_pointwise(coarse_, boundary_, beside), beside);
  expect_linear(tie_by_mortar(coarse_, boundary_, beside, faces_), beside);
}

TEST_F(InterfaceMapTest, ForcesAndMomentsAreInBalance) {
  const test::Values values = test::random_values(3 * slaves_.size(), 1, 3);
  const Eigen::VectorXd f =
      Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
  for (const InterfaceMap& map : {pointwise(), mortar()}) {
    const Eigen::VectorXd passed = gathered(map, f);
    Vec3 force = Vec3::Zero(), moment = Vec3::Zero();
    for (std::size_t s = 0; s < slaves_.size(); ++s) {
      const Vec3 own = f.segment<3>(static_cast<Eigen::Index>(3 * s));
      force += own;
      moment += slaves_[s].cross(own);
    }
    for (std::size_t m = 0; m < map.masters.size(); ++m) {
      const Vec3 own = passed.segment<3>(static_cast<Eigen::Index>(3 * m));
      force -= own;
      moment -= coarse_.positions[map.masters[m]].cross(own);
    }
    EXPECT_LE(force.norm(), 1e-10);
    EXPECT_LE(moment.norm(), 1e-10);
  }
}

TEST_F(InterfaceMapTest, AMortarPassesAUniformStressOnPointsDoNot) {
  EXPECT_LE(patch_error(mortar()), 2e-3) << "what the kinks cost the integration";
  EXPECT_GT(patch_error(pointwise()), 1e-2);
}

// What tying and condensing cost is nothing: the rest of its distance from a fine bar is the coarse half's
// own.
TEST_F(InterfaceMapTest, ItRestsWhereTheSameTwoMeshesDoAsOneModelTiedByMultipliers) {
  for (const InterfaceMap& map : {pointwise(), mortar()}) {
    const std::vector<Vec3> condensed = rest(map), exact = rest_with_multipliers(map);
    double off = 0, size = 0;
    for (std::size_t n = 0; n < exact.size(); ++n) {
      off = std::max(off, (condensed[n] - exact[n]).norm());
      size = std::max(size, exact[n].norm());
    }
    RecordProperty("off", std::to_string(off / size));
    EXPECT_LE(off, 1e-6 * size) << "tensors are stored in float";
  }
}

// Against the same two meshes one of which was made as fine as the other; what a coarse half costs is known
// from a bar that is coarse throughout.
TEST_F(InterfaceMapTest, ItRestsNearerToTheFineBarThanACoarseOneDoes) {
  const auto tip = [](const geometry::TetraMesh& mesh, const std::vector<Vec3>& u) {
    Vec3 sum = Vec3::Zero();
    double count = 0;
    for (std::size_t n = 0; n < u.size(); ++n)
      if (mesh.positions[n].x() > 2 * kBorderX_m - 1e-12) sum += u[n], ++count;
    return (sum / count).eval();
  };
  const auto single = [&](int cells, int across) {
    const geometry::TetraMesh mesh =
        test::make_box_mesh(cells, across, across, {2 * kBorderX_m, kWidth_m, kWidth_m});
    FixedComponents fixed;
    for (const Vec3& p : mesh.positions) fixed.push_back(p.x() == 0 ? kPinned : 0);
    return tip(mesh, direct_solve(assemble_stiffness(mesh, kSoft), fixed, {}, pull(mesh)).displacements);
  };
  const Vec3 fine = single(20, 5), coarse = single(8, 2);
  const Vec3 by_points = tip(coarse_, rest(pointwise())), by_mortar = tip(coarse_, rest(mortar()));
  RecordProperty("pointwise", std::to_string((by_points - fine).norm() / fine.norm()));
  RecordProperty("mortar", std::to_string((by_mortar - fine).norm() / fine.norm()));
  RecordProperty("coarse", std::to_string((coarse - fine).norm() / fine.norm()));
  EXPECT_LT((by_mortar - fine).norm(), (coarse - fine).norm());
  EXPECT_LT((by_points - fine).norm(), (coarse - fine).norm());
  EXPECT_LE((by_mortar - by_points).norm(), 0.02 * fine.norm());
}

}  // namespace
}  // namespace omentum::physics
