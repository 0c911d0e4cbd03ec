#include "geometry/self_intersection.h"
#include "geometry/tetra_mesh.h"
#include "tests/support/meshes.h"
#include "tests/support/process.h"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <random>

namespace omentum::geometry {
namespace {

using testing::AllOf;
using testing::HasSubstr;

std::string refusal(const RawMesh& raw, double metres_per_unit = 1.0) {
  try {
    check_mesh(raw, metres_per_unit);
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

double volume(const TetraMesh& mesh, const Tetrahedron& t) {
  return signed_volume(mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]],
                       mesh.positions[t[3]]);
}

TEST(CheckMesh, AcceptsAConformingBoxThatFillsItsVolume) {
  const CheckedMesh checked = check_mesh(test::make_raw_box(3, 2, 4, {300, 200, 400}), 1e-3);
  EXPECT_TRUE(checked.warnings.empty());
  double sum = 0;
  for (const Tetrahedron& t : checked.mesh.tetrahedra) {
    EXPECT_GT(volume(checked.mesh, t), 0);
    sum += volume(checked.mesh, t);
  }
  EXPECT_NEAR(sum, 0.3 * 0.2 * 0.4, 1e-15);
}

TEST(CheckMesh, NegativelyListedTetrahedraAreReorderedAndCounted) {
  RawMesh raw = test::make_raw_box(2, 2, 2, {1, 1, 1});
  for (const std::size_t t : {3, 7, 20}) std::swap(raw.tetrahedra[t][0], raw.tetrahedra[t][1]);
  const CheckedMesh checked = check_mesh(raw, 1);
  for (const Tetrahedron& t : checked.mesh.tetrahedra) EXPECT_GT(volume(checked.mesh, t), 0);
  ASSERT_EQ(checked.warnings.size(), 1u);
  EXPECT_THAT(checked.warnings[0], HasSubstr("box: 3 tetrahedra were listed in negative order"));
}

TEST(CheckMesh, AMirroredMeshIsOnlyAMatterOfOrder) {
  RawMesh raw = test::make_raw_box(2, 3, 2, {1, 1, 1});
  for (Vec3& p : raw.positions) p.x() = -p.x();
  EXPECT_EQ(check_mesh(raw, 1).warnings.size(), 1u);
}

TEST(CheckMesh, UnusedNodesAreDroppedAndTheOthersKeepTheirFileNumbers) {
  RawMesh raw = test::make_raw_box(1, 1, 1, {1, 1, 1});
  raw.positions.insert(raw.positions.begin() + 2, Vec3(9, 9, 9));
  for (auto& t : raw.tetrahedra) {
    for (std::int32_t& n : t) n += n >= 2;
  }
  const CheckedMesh checked = check_mesh(raw, 1);
  EXPECT_EQ(checked.mesh.positions.size(), 8u);
  EXPECT_EQ(checked.mesh.file_node, (std::vector<std::int32_t>{0, 1, 3, 4, 5, 6, 7, 8}));
  EXPECT_EQ(checked.mesh.file_node_count, 9);
  ASSERT_EQ(checked.warnings.size(), 1u);
  EXPECT_THAT(checked.warnings[0], HasSubstr("1 node belongs to no tetrahedron"));
}

TEST(CheckMesh, RefusesFlatTetrahedraByNumberWhateverTheUnit) {
  RawMesh raw = test::make_raw_box(2, 2, 2, {1, 1, 1});
  raw.positions[raw.tetrahedra[5][0]] =
      (raw.positions[raw.tetrahedra[5][1]] + raw.positions[raw.tetrahedra[5][2]] +
       raw.positions[raw.tetrahedra[5][3]]) /
      3;
  for (const double scale : {1e-6, 1.0, 1e6}) {
    EXPECT_THAT(refusal(raw, scale), AllOf(HasSubstr("box:"), HasSubstr("5"), HasSubstr("zero volume")));
  }
}

TEST(CheckMesh, RefusesRepeatedTetrahedra) {
  RawMesh raw = test::make_raw_box(2, 1, 1, {1, 1, 1});
  const auto copied = raw.tetrahedra[4];
  raw.tetrahedra.push_back({copied[1], copied[2], copied[0], copied[3]});
  EXPECT_THAT(refusal(raw), HasSubstr("tetrahedra 12: repeating the nodes of an earlier one"));
}

TEST(CheckMesh, RefusesATetrahedronThatRepeatsANode) {
  RawMesh raw = test::make_raw_box(1, 1, 1, {1, 1, 1});
  raw.tetrahedra[2][3] = raw.tetrahedra[2][0];
  EXPECT_THAT(refusal(raw), AllOf(HasSubstr("tetrahedra 2:"), HasSubstr("zero volume")));
}

TEST(CheckMesh, RefusesTetrahedraFoldedOverASharedFace) {
  RawMesh raw{
      "two", {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0.3, 0.3, 0.5}}, {{0, 1, 2, 3}, {0, 1, 2, 4}}};
  EXPECT_THAT(refusal(raw), HasSubstr("tetrahedra 0, 1: on the same side of a shared face"));
}

// A flat tetrahedron between four others; with a negative thickness it alone is inverted.
RawMesh sliver_between_four(double thickness) {
  const double z = thickness / 2;
  return {"sliver",
          {{1, 0, z}, {-1, 0, z}, {0, 1, -z}, {0, -1, -z}, {0, 0, 2}, {0, 0, -2}},
          {{0, 2, 1, 4}, {0, 1, 3, 4}, {0, 2, 3, 5}, {1, 3, 2, 5}, {0, 1, 2, 3}}};
}

TEST(CheckMesh, NamesTheTetrahedronThatIsTurnedInsideOut) {
  EXPECT_EQ(refusal(sliver_between_four(0.2)), "accepted");
  EXPECT_THAT(refusal(sliver_between_four(-0.2)), HasSubstr("tetrahedra 4: turned inside out"));
}

TEST(CheckMesh, RefusesAFaceWithThreeTetrahedra) {
  RawMesh raw{"three",
              {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, -1}, {0.2, 0.2, 2}},
              {{0, 1, 2, 3}, {0, 2, 1, 4}, {0, 1, 2, 5}}};
  EXPECT_THAT(refusal(raw), HasSubstr("tetrahedra 0, 1, 2: sharing a face with more than one other"));
}

TEST(CheckMesh, RefusesSeparateParts) {
  RawMesh raw = test::make_raw_box(1, 1, 1, {1, 1, 1});
  const RawMesh other = test::make_raw_box(1, 1, 1, {1, 1, 1});
  for (const Vec3& p : other.positions) raw.positions.push_back(p + Vec3(3, 0, 0));
  for (auto t : other.tetrahedra) {
    for (std::int32_t& n : t) n += 8;
    raw.tetrahedra.push_back(t);
  }
  EXPECT_THAT(refusal(raw), HasSubstr("in parts that no faces connect"));
}

// A 3x1x1 arch would do for real life; here cubes are left out of a box so that two meet in an edge or a node
// only.
RawMesh box_without(int n, const std::vector<std::array<int, 3>>& cubes) {
  RawMesh raw = test::make_raw_box(n, n, n, {1, 1, 1});
  std::vector<std::array<std::int32_t, 4>> kept;
  for (std::size_t t = 0; t < raw.tetrahedra.size(); ++t) {
    const int cube = static_cast<int>(t / 6);
    const std::array<int, 3> at = {cube % n, cube / n % n, cube / (n * n)};
    if (std::find(cubes.begin(), cubes.end(), at) == cubes.end()) kept.push_back(raw.tetrahedra[t]);
  }
  raw.tetrahedra = kept;
  return raw;
}

TEST(CheckMesh, RefusesRegionsThatTouchAlongAnEdge) {
  EXPECT_THAT(refusal(box_without(2, {{0, 0, 0}, {1, 1, 0}})), HasSubstr("along an edge only"));
}

TEST(CheckMesh, RefusesHollowsThatTouchInANode) {
  // the boundary alone is pinched there: every edge has its two faces, and the tetrahedra around are
  // connected
  EXPECT_THAT(refusal(box_without(4, {{1, 1, 1}, {2, 2, 2}})),
              HasSubstr("nodes 62: joining boundary faces that touch there in a point only"));
}

TEST(CheckMesh, RefusesRegionsThatTouchInANode) {
  // the cube in the corner hangs on by the node that it shares with the box's centre
  const std::string reason =
      refusal(box_without(3, {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 0}, {1, 0, 1}, {0, 1, 1}}));
  EXPECT_THAT(reason,
              AllOf(HasSubstr("no faces connect"), HasSubstr("joining regions that touch there in a point")));
}

TEST(CheckMesh, AHollowIsAllowed) {
  EXPECT_EQ(refusal(box_without(3, {{1, 1, 1}})), "accepted");
}

// A closed ring of wedges around the z axis, `turns` full turns long, of tetrahedra that share the axis.
RawMesh fan_around_an_axis(double turns, int wedges, bool closed) {
  RawMesh raw{"fan", {{0, 0, 0}, {0, 0, 1}}, {}};
  const int rim = closed ? wedges : wedges + 1;
  for (int i = 0; i < rim; ++i) {
    const double angle = 2 * 3.141592653589793 * turns * i / wedges;
    raw.positions.emplace_back(std::cos(angle), std::sin(angle), 0.4);
  }
  for (int i = 0; i < wedges; ++i) raw.tetrahedra.push_back({0, 1, 2 + i, 2 + (i + 1) % rim});
  for (auto& t : raw.tetrahedra) std::swap(t[0], t[1]);
  return raw;
}

TEST(CheckMesh, AFullTurnAroundAnEdgeIsAcceptedAndTwoAreRefused) {
  EXPECT_EQ(refusal(fan_around_an_axis(1, 7, true)).find("overlapping"), std::string::npos);
  EXPECT_THAT(refusal(fan_around_an_axis(2, 11, true)), HasSubstr("overlapping"));
  EXPECT_THAT(refusal(fan_around_an_axis(1.1, 9, false)), HasSubstr("overlapping"));
}

// A bar of cubes bent into a helix with radius 1: after more than one turn at small pitch it runs through
// itself.
RawMesh bent_bar(double turns, double pitch) {
  RawMesh raw = test::make_raw_box(60, 2, 2, {1, 1, 1});
  raw.source = "bar";
  for (Vec3& p : raw.positions) {
    const double angle = 2 * 3.141592653589793 * turns * p.x(), radius = 1 + 0.3 * p.y();
    p = Vec3(radius * std::cos(angle), radius * std::sin(angle), 0.3 * p.z() + pitch * turns * p.x());
  }
  return raw;
}

TEST(CheckMesh, RefusesABodyThatRunsThroughItself) {
  EXPECT_THAT(refusal(bent_bar(1.2, 0.13)), HasSubstr("pass through each other (overlapping)"));
  EXPECT_THAT(refusal(bent_bar(1.2, 0.0)), HasSubstr("inside another one (overlapping)")) << "face upon face";
  EXPECT_EQ(refusal(bent_bar(1.2, 0.6)), "accepted");
  EXPECT_EQ(refusal(bent_bar(0.9, 0.0)), "accepted");
}

// Node `node` of tetrahedra [first, last) becomes one of its own at the same place, but for `apart`.
RawMesh with_copied_node(RawMesh raw, std::int32_t node, std::size_t first, std::size_t last,
                         double apart = 0) {
  raw.positions.push_back(raw.positions[node] + Vec3::Constant(apart));
  for (std::size_t t = first; t < last; ++t) {
    std::ranges::replace(raw.tetrahedra[t], node, static_cast<std::int32_t>(raw.positions.size() - 1));
  }
  return raw;
}

// Every tetrahedron behind the middle gets nodes of its own: two parts that look like one.
RawMesh glued_by_copying() {
  RawMesh raw = test::make_raw_box(4, 3, 3, {0.08, 0.06, 0.06});
  std::vector<std::int32_t> copy(raw.positions.size(), -1);
  for (auto& t : raw.tetrahedra) {
    double x = 0;
    for (const std::int32_t node : t) x += raw.positions[node].x() / 4;
    if (x < 0.04) continue;
    for (std::int32_t& node : t) {
      if (raw.positions[node].x() > 0.041) continue;
      if (copy[node] < 0) {
        copy[node] = static_cast<std::int32_t>(raw.positions.size());
        raw.positions.push_back(raw.positions[node]);
      }
      node = copy[node];
    }
  }
  return raw;
}

TEST(CheckMesh, AnInnerCrackIsNamed) {
  const RawMesh box = test::make_raw_box(3, 3, 3, {3, 3, 3});
  constexpr std::int32_t kInner = 1 + 4 * (1 + 4 * 1);
  const auto user =
      std::ranges::find_if(box.tetrahedra, [&](const auto& t) { return std::ranges::count(t, kInner) > 0; });
  const auto t = static_cast<std::size_t>(user - box.tetrahedra.begin());
  for (const double rounding : {0.0, 1e-8, -1e-8}) {
    EXPECT_THAT(refusal(with_copied_node(box, kInner, t, t + 1, rounding)),
                AllOf(HasSubstr("1 pair of nodes at the same place"), HasSubstr("nodes 21 and 64"),
                      HasSubstr("--merge")));
  }
  RawMesh unused = box;
  unused.positions.push_back(box.positions[kInner]);
  EXPECT_EQ(refusal(unused), "accepted") << "nobody uses it";
}

TEST(CheckMesh, PartsGluedByCopyingAreCountedAndMergedOnDemand) {
  const RawMesh glued = glued_by_copying();
  EXPECT_THAT(refusal(glued),
              AllOf(HasSubstr("16 pairs of nodes at the same place"), HasSubstr("--merge METRES")));

  const RawMesh whole = test::make_raw_box(4, 3, 3, {0.08, 0.06, 0.06});
  RawMesh shifted = glued;
  for (std::size_t n = whole.positions.size(); n < shifted.positions.size(); ++n)
    shifted.positions[n].y() += 5e-7;
  for (const RawMesh& parts : {glued, shifted}) {
    const CheckedMesh merged = check_mesh(parts, 1, {.merge_m = 1e-6});
    EXPECT_EQ(merged.mesh.positions, whole.positions);
    EXPECT_EQ(merged.mesh.tetrahedra, check_mesh(whole, 1).mesh.tetrahedra);
    EXPECT_EQ(merged.mesh.file_node_count, static_cast<std::int32_t>(parts.positions.size()));
    ASSERT_EQ(merged.mesh.merged.size(), 16u);
    EXPECT_EQ(merged.mesh.merged[0].dropped, static_cast<std::int32_t>(whole.positions.size()));
    EXPECT_EQ(parts.positions[merged.mesh.merged[0].kept].x(), 0.04);
    EXPECT_THAT(merged.warnings, testing::ElementsAre(HasSubstr("16 nodes were merged")));
  }
}

TEST(CheckMesh, MergingNeverCollapsesATetrahedron) {
  try {
    check_mesh(glued_by_copying(), 1, {.merge_m = 0.021});
    FAIL() << "an edge of 20 mm is no rounding";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("no farther apart than what is merged"));
  }
  for (const double wrong : {-1.0, std::numeric_limits<double>::quiet_NaN()})
    EXPECT_THROW(check_mesh(glued_by_copying(), 1, {.merge_m = wrong}), InputError);
}

TEST(CheckMesh, RefusesPositionsAndNumbersThatAreNone) {
  RawMesh raw = test::make_raw_box(1, 1, 1, {1, 1, 1});
  raw.positions[3].y() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(refusal(raw), HasSubstr("the position of node 3 is not finite"));
  raw = test::make_raw_box(1, 1, 1, {1, 1, 1});
  raw.positions.push_back(Vec3::Constant(std::numeric_limits<double>::quiet_NaN()));
  EXPECT_EQ(refusal(raw), "accepted") << "nobody uses it";
  raw = test::make_raw_box(1, 1, 1, {1, 1, 1});
  raw.tetrahedra[4][2] = 8;
  EXPECT_THAT(refusal(raw), HasSubstr("tetrahedron 4 names node 8, expected 0 to 7"));
  raw.tetrahedra[4][2] = -1;
  EXPECT_THAT(refusal(raw), HasSubstr("names node -1"));
  raw.tetrahedra.clear();
  EXPECT_THAT(refusal(raw), HasSubstr("no tetrahedra"));
}

TEST(CheckMesh, RefusesAScaleThatIsNoLength) {
  const RawMesh raw = test::make_raw_box(1, 1, 1, {1, 1, 1});
  for (const double scale :
       {0.0, -1.0, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    EXPECT_THAT(refusal(raw, scale), HasSubstr("metres per unit"));
  }
}

TEST(CheckMesh, ManyOffendersAreCountedNotListed) {
  RawMesh raw = test::make_raw_box(4, 4, 4, {1, 1, 1});
  const std::size_t count = raw.tetrahedra.size();
  for (std::size_t t = 0; t < count; ++t) raw.tetrahedra.push_back(raw.tetrahedra[t]);
  EXPECT_THAT(refusal(raw), HasSubstr("tetrahedra 384, 385, 386, 387, 388, ... (384 in all)"));
}

TEST(CheckMesh, MovedNodesAreAcceptedExactlyWhileNoTetrahedronFolds) {
  constexpr int n = 4;
  std::mt19937 random(11);
  std::uniform_real_distribution<double> unit(-1, 1);
  int refused = 0;
  for (int i = 0; i < 200; ++i) {
    RawMesh raw = test::make_raw_box(n, n, n, {1, 1, 1});
    const double amplitude = 0.02 + 0.003 * i;
    std::size_t moved = random() % raw.positions.size();
    raw.positions[moved] += amplitude * Vec3(unit(random), unit(random), unit(random));
    // a negative tetrahedron in the file's own order is a fold: only the mesh without any may be accepted
    bool folded = false;
    for (const auto& t : raw.tetrahedra) {
      folded |= signed_volume(raw.positions[t[0]], raw.positions[t[1]], raw.positions[t[2]],
                              raw.positions[t[3]]) <= 0;
    }
    EXPECT_EQ(refusal(raw) == "accepted", !folded) << refusal(raw);
    refused += folded;
  }
  EXPECT_GT(refused, 20);
}

struct RealMesh {
  const char* file;
  std::size_t nodes, tetrahedra;
  std::size_t warnings;
};

class RealMeshes : public testing::TestWithParam<RealMesh> {};

TEST_P(RealMeshes, AreReadAndAccepted) {
  const std::filesystem::path file = test::data_file(GetParam().file);
  if (!std::filesystem::exists(file)) GTEST_SKIP() << file << " is not here";
  const CheckedMesh checked = check_mesh(read_mesh(file), 1e-3);
  EXPECT_EQ(checked.mesh.positions.size(), GetParam().nodes);
  EXPECT_EQ(checked.mesh.tetrahedra.size(), GetParam().tetrahedra);
  EXPECT_EQ(checked.warnings.size(), GetParam().warnings);
}

INSTANTIATE_TEST_SUITE_P(Manifest, RealMeshes,
                         testing::Values(RealMesh{"tet/infinytoolkit_liver.msh", 3060, 10542, 0},
                                         RealMesh{"tet/mor_liverFine.vtu", 4293, 22019, 0},
                                         RealMesh{"tet/openhelp_kidney_left_22k.msh", 4728, 21847, 0},
                                         RealMesh{"tet/openhelp_liver_132k.msh", 25979, 131879, 0},
                                         RealMesh{"tet/openhelp_liver_25k.msh", 5648, 24893, 0},
                                         RealMesh{"tet/openhelp_liver_7k.msh", 1765, 7185, 0},
                                         RealMesh{"tet/openhelp_stomach_15k.msh", 3538, 15197, 0},
                                         RealMesh{"tet/sofa_liver.msh", 181, 596, 0},
                                         RealMesh{"tet/sofa_liver2.msh", 507, 1493, 0},
                                         RealMesh{"tet/sofa_pdms_cylinder.vtk", 3668, 12724, 0},
                                         RealMesh{"tet/sofaenv_gallbladder.vtk", 366, 1063, 1},
                                         RealMesh{"tet/sofaenv_liver_coarse.vtk", 98, 273, 0},
                                         RealMesh{"tet/sofaenv_tissue_retraction.msh", 493, 1432, 0},
                                         RealMesh{"tet/sofamcp_prostate.vtk", 634, 2025, 0}));

TEST(BrokenRealMeshes, AreRefusedWithReasons) {
  const std::filesystem::path six = test::data_file("tet_invalid/sofa_6_tetra_bad.msh");
  if (!std::filesystem::exists(six)) GTEST_SKIP() << six << " is not here";
  EXPECT_THAT([&] { read_mesh(six); },
              testing::ThrowsMessage<InputError>(HasSubstr("tetrahedron number 44 twice")));
  // the same with numbers of their own
  std::string text = test::read_text(six);
  char number = '1';
  for (std::size_t at = 0; (at = text.find("\n44 4 ", at)) != std::string::npos; ++number)
    text.replace(at, 3, {'\n', number});
  const test::ScratchFolder folder;
  std::ofstream(folder / "six.msh") << text;
  EXPECT_THAT(refusal(read_mesh(folder / "six.msh")),
              AllOf(HasSubstr("six.msh"), HasSubstr("no faces connect"), HasSubstr("non-manifold")));
}

TEST(BrokenRealMeshes, OneInvertedTetrahedronAmongNegativelyListedOnesIsNamed) {
  const std::filesystem::path file = test::data_file("tet_invalid/cleaver_all_negative.node");
  if (!std::filesystem::exists(file)) GTEST_SKIP() << file << " is not here";
  RawMesh raw = read_mesh(file);
  EXPECT_THAT(refusal(raw), HasSubstr("tetrahedra 16541: turned inside out"));
}

TEST(CrossingTriangles, FindsWhatBruteForceFinds) {
  // pairs of separate random triangles, tested by the definition: some edge of one passes through the other
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(0, 1);
  std::vector<Vec3> positions;
  std::vector<std::array<std::int32_t, 3>> triangles;
  for (std::int32_t t = 0; t < 300; ++t) {
    const Vec3 centre(unit(random), unit(random), unit(random));
    for (int i = 0; i < 3; ++i)
      positions.push_back(centre + 0.2 * Vec3(unit(random), unit(random), unit(random)));
    triangles.push_back({3 * t, 3 * t + 1, 3 * t + 2});
  }
  const auto crosses = [&](std::size_t i, std::size_t j) {
    const auto volume = [&](int a, int b, int c, int d) {
      return signed_volume(positions[a], positions[b], positions[c], positions[d]);
    };
    const auto& [a, b, c] = triangles[j];
    for (int e = 0; e < 3; ++e) {
      const int p = triangles[i][e], q = triangles[i][(e + 1) % 3];
      const bool separated = volume(a, b, c, p) * volume(a, b, c, q) < 0;
      const double s = volume(p, q, a, b), t = volume(p, q, b, c), u = volume(p, q, c, a);
      if (separated && ((s > 0) == (t > 0)) && ((t > 0) == (u > 0))) return true;
    }
    return false;
  };
  std::vector<std::pair<std::size_t, std::size_t>> expected;
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    for (std::size_t j = i + 1; j < triangles.size(); ++j) {
      if (crosses(i, j) || crosses(j, i)) expected.emplace_back(i, j);
    }
  }
  EXPECT_GT(expected.size(), 20u);
  EXPECT_EQ(crossing_triangles(positions, triangles), expected);
}

}  // namespace
}  // namespace omentum::geometry
