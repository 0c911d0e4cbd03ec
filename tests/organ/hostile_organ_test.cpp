// What a forged organ file says is refused where it is wrong.
#include "tests/organ/hostile_organ.h"

#include <random>

namespace omentum::organ {
namespace {

using geometry::NodeId;
using geometry::TetId;
using geometry::TriangleId;
using testing::HasSubstr;

// One thing at a time, anywhere in an organ.
class Mutation {
 public:
  explicit Mutation(unsigned seed) : random_(seed) {}

  Organ of(Organ organ) {
    geometry::Surface& s = organ.surface;
    switch (pick(12)) {
      case 0:
        real(organ.mesh.positions[pick(organ.mesh.positions.size())][pick(3)]);
        break;
      case 1:
        index(organ.mesh.tetrahedra[pick(organ.mesh.tetrahedra.size())][pick(4)]);
        break;
      case 2:
        index(organ.mesh.file_node[pick(organ.mesh.file_node.size())]);
        break;
      case 3:
        index(s.node[pick(s.node.size())]);
        break;
      case 4:
        index(s.triangles[pick(s.triangles.size())][pick(3)]);
        break;
      case 5:
        index(s.tetrahedron[pick(s.tetrahedron.size())]);
        break;
      case 6:
        index(s.fan_start[pick(s.fan_start.size())]);
        break;
      case 7:
        index(s.fan[pick(s.fan.size())]);
        break;
      case 8:
        organ.fixed[pick(organ.fixed.size())] = static_cast<std::uint8_t>(random_());
        break;
      case 9:
        index(s.mobile_count);
        break;
      case 10:
        index(organ.mesh.file_node_count);
        break;
      default:
        length(organ);
        break;
    }
    return organ;
  }

 private:
  std::size_t pick(std::size_t count) { return random_() % count; }

  template <class Index>
  void index(Index& value) {
    const std::int32_t now = value;
    const std::int32_t wrong[] = {-1,      std::numeric_limits<std::int32_t>::min(),
                                  now + 1, std::numeric_limits<std::int32_t>::max(),
                                  0,       1 << 20,
                                  now - 1, static_cast<std::int32_t>(random_() % 64)};
    value = Index(wrong[pick(std::size(wrong))]);
  }
  void real(double& value) {
    const double wrong[] = {std::nan(""), HUGE_VAL, 1e300, -value - 0.01, 0};
    value = wrong[pick(std::size(wrong))];
  }
  template <class T>
  void resize(std::vector<T>& values) {
    const std::size_t sizes[] = {0, 1, values.size() - 1, values.size() + 1, 2 * values.size()};
    values.resize(sizes[pick(std::size(sizes))], values.front());
  }
  void length(Organ& organ) {
    geometry::Surface& s = organ.surface;
    switch (pick(11)) {
      case 0:
        resize(organ.mesh.positions);
        break;
      case 1:
        resize(organ.mesh.tetrahedra);
        break;
      case 2:
        resize(organ.mesh.file_node);
        break;
      case 3:
        resize(s.node);
        break;
      case 4:
        resize(s.triangles);
        break;
      case 5:
        resize(s.tetrahedron);
        break;
      case 6:
        resize(s.fan_start);
        break;
      case 7:
        resize(s.fan);
        break;
      case 8:
        resize(organ.mesh.node_numbers);
        break;
      case 9:
        resize(organ.mesh.tetrahedron_numbers);
        break;
      default:
        resize(organ.fixed);
        break;
    }
  }

  std::mt19937 random_;
};

TEST_F(HostileOrganTest, AForgedFileThatIsHonestIsAccepted) {
  forge(honest);
  EXPECT_EQ(refusal(), "accepted");
}

TEST_F(HostileOrganTest, EveryMutationIsRefusedOrHasAllIndicesInRange) {
  constexpr int kMutations = 600;
  int refused = 0;
  for (int i = 0; i < kMutations; ++i) {
    SCOPED_TRACE(i);
    forge(Mutation(static_cast<unsigned>(i)).of(honest));
    refused += refusal() != "accepted";
    ASSERT_FALSE(HasFatalFailure());
  }
  // what is left moved a node or kept a value
  EXPECT_GT(refused, kMutations * 3 / 4);
}

TEST_F(HostileOrganTest, WhatIsWrongIsNamed) {
  expect_named([](Organ& o) { o.surface.triangles[3][1] = SurfaceId(1 << 20); },
               "row 3 of 'surface/triangles'");
  expect_named([](Organ& o) { std::swap(o.surface.triangles[3][1], o.surface.triangles[3][2]); }, "no face");
  expect_named([](Organ& o) { o.surface.node[2] = NodeId(-7); }, "row 2 of 'surface/node'");
  expect_named([](Organ& o) { o.surface.tetrahedron[0] = TetId(4000); }, "row 0 of 'surface/tetrahedron'");
  expect_named([](Organ& o) { o.surface.fan[5] = TriangleId(-1); }, "row 5 of 'surface/fan'");
  expect_named([](Organ& o) { o.surface.fan_start[4] = 1 << 30; }, "row 4 of 'surface/fan_start'");
  expect_named([](Organ& o) { o.mesh.tetrahedra[6][0] = NodeId(27); }, "row 6 of 'mesh/tetrahedra'");
  expect_named([](Organ& o) { std::swap(o.mesh.tetrahedra[6][0], o.mesh.tetrahedra[6][1]); },
               "no positive volume");
  expect_named([](Organ& o) { o.mesh.file_node[1] = -3; }, "row 1 of 'mesh/file_node'");
  expect_named([](Organ& o) { o.mesh.node_numbers.pop_back(); },
               "'mesh/node_numbers' has 26 rows; expected 27");
  expect_named([](Organ& o) { o.mesh.tetrahedron_numbers.pop_back(); }, "'mesh/tetrahedron_numbers'");
  expect_named([](Organ& o) { o.mesh.merged = {{40, 3}}; }, "row 0 of 'mesh/merged'");
  expect_named([](Organ& o) { o.mesh.merged = {{-1, 3}}; }, "row 0 of 'mesh/merged'");
  expect_named([](Organ& o) { o.mesh.merged = {{26, 3}}; }, "or in use");
  for (const std::int32_t kept : {27, 1000, -2}) {
    const auto add_node = [kept](Organ& o) {
      o.mesh.node_numbers.push_back(27);
      o.mesh.file_node_count = 28;
      o.mesh.merged = {{27, 3}, {27, kept}};
    };
    expect_named(add_node, "row 1 of 'mesh/merged'");
  }
  expect_named([](Organ& o) { o.mesh.positions[9].y() = NAN; }, "row 9 of 'mesh/positions'");
  expect_named([](Organ& o) { o.fixed.back() = 8; }, "row 26 of 'supports/fixed'");
  expect_named([](Organ& o) { o.fixed.pop_back(); }, "'supports/fixed' has 26 rows; expected 27");
  expect_named([](Organ& o) { o.surface.mobile_count = 1 << 28; }, "mobile_count");
  expect_named([](Organ& o) { o.surface.mobile_count -= 1; }, "'surface/node'");
  expect_named([](Organ& o) { o.material.common.young_pa = -1; }, "Young's modulus");
  expect_named(
      [](Organ& o) {
        o.surface.triangles.pop_back();
        o.surface.tetrahedron.pop_back();
        o.surface.fan.resize(3 * o.surface.triangles.size());
      },
      "does not close");
}

TEST_F(HostileOrganTest, WhatIsWrongOfRegionsIsNamed) {
  const auto with_regions = [](std::vector<physics::RegionMaterial> regions, std::size_t labelled) {
    return [regions, labelled](Organ& o) {
      o.mesh.regions.assign(labelled, 3);
      o.mesh.regions.back() = 8;
      o.material.regions = regions;
    };
  };
  const physics::Material stiff{9000, 0.4, 1050};
  expect_named(with_regions({{3, stiff}, {8, stiff}}, 47), "'mesh/regions' has 47 rows; expected 48");
  expect_named(with_regions({{8, stiff}, {3, stiff}}, 48), "row 1 of 'material/labels'");
  expect_named(with_regions({{3, stiff}, {3, stiff}}, 48), "row 1 of 'material/labels'");
  expect_named(with_regions({{4, stiff}}, 48), "row 0 of 'material/labels' is the label of no tetrahedron");
  expect_named(with_regions({{3, {NAN, 0.4, 1050}}}, 48), "region 3: Young's modulus");
  expect_named(with_regions({{3, {9000, 0.4, 1050}}, {8, {9000, 0.5, 1050}}}, 48),
               "region 8: Poisson's ratio");
}

}  // namespace
}  // namespace omentum::organ
