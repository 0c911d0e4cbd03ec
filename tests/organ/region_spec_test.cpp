#include "organ/region_spec.h"

#include "tests/support/meshes.h"

#include <gmock/gmock.h>

namespace omentum::organ {
namespace {

using testing::AllOf;
using testing::HasSubstr;

const physics::Material kOrganTissue{3000, 0.45, 1050};

class RegionSpecTest : public testing::Test {
 protected:
  physics::MaterialMap parse(const std::vector<std::string>& specs) {
    return parse_regions(specs, kOrganTissue, mesh);
  }

  std::string refusal(const std::vector<std::string>& specs) {
    geometry::TetraMesh untouched = mesh;
    try {
      parse_regions(specs, kOrganTissue, untouched);
    } catch (const geometry::InputError& error) {
      EXPECT_THAT(error.what(), HasSubstr("--region "));
      EXPECT_THAT(error.what(), testing::Not(HasSubstr("\n")));
      return error.what();
    }
    return "accepted";
  }

  const physics::Material& at(const physics::MaterialMap& map, std::size_t t) const {
    return map.of(mesh, geometry::TetId(t));
  }
  geometry::Vec3 centre(std::size_t t) const {
    geometry::Vec3 sum = geometry::Vec3::Zero();
    for (const geometry::NodeId n : mesh.tetrahedra[t]) sum += mesh.positions[n] / 4;
    return sum;
  }

  geometry::TetraMesh mesh = test::make_box_mesh(4, 4, 4, {0.04, 0.04, 0.04});
};

TEST_F(RegionSpecTest, WithoutSpecsAllIsTheOrgans) {
  const physics::MaterialMap map = parse({});
  EXPECT_TRUE(map.regions.empty());
  EXPECT_TRUE(mesh.regions.empty());
}

TEST_F(RegionSpecTest, ABallHasTheTetrahedraWhoseCentreLiesInIt) {
  const physics::MaterialMap map = parse({" ball = 0.02,0.02,0.02,0.01 ; young=15000;density=1100 "});
  std::size_t inside = 0;
  for (std::size_t t = 0; t < mesh.tetrahedra.size(); ++t) {
    const bool in_ball = (centre(t) - geometry::Vec3(0.02, 0.02, 0.02)).norm() <= 0.01;
    EXPECT_EQ(at(map, t).young_pa, in_ball ? 15000 : 3000);
    EXPECT_EQ(at(map, t).poisson, 0.45);
    EXPECT_EQ(at(map, t).density_kg_m3, in_ball ? 1100 : 1050);
    inside += in_ball;
  }
  EXPECT_GT(inside, 0u);
  EXPECT_LT(inside, mesh.tetrahedra.size());
}

TEST_F(RegionSpecTest, TheLastOfSeveralHolds) {
  const physics::MaterialMap map =
      parse({"box=0.04,0.04,0.04,0,0,0; young=1", "box=0,0,0,0.02,0.04,0.04; poisson=0.3"});
  for (std::size_t t = 0; t < mesh.tetrahedra.size(); ++t) {
    const bool second = centre(t).x() <= 0.02;
    EXPECT_EQ(at(map, t).young_pa, second ? 3000 : 1);
    EXPECT_EQ(at(map, t).poisson, second ? 0.3 : 0.45);
  }
}

TEST_F(RegionSpecTest, LabelsAreTheMeshsAndPlacesGetOnesAboveThem) {
  mesh.regions.assign(mesh.tetrahedra.size(), -5);
  for (std::size_t t = 0; t < 100; ++t) mesh.regions[t] = 40;
  const physics::MaterialMap map = parse({"box=0,0,0,0.04,0.04,0.01; young=2", "label=-5; young=1"});
  ASSERT_EQ(map.regions.size(), 2u);
  EXPECT_EQ(map.regions[0].label, -5);
  EXPECT_EQ(map.regions[1].label, 41);
  for (std::size_t t = 0; t < mesh.tetrahedra.size(); ++t)
    EXPECT_EQ(at(map, t).young_pa, t >= 100 ? 1 : centre(t).z() <= 0.01 ? 2 : 3000) << t;
}

TEST_F(RegionSpecTest, WrongSpecsAreRefusedInOneLine) {
  EXPECT_THAT(refusal({""}), HasSubstr("expected KEY=VALUE between semicolons"));
  EXPECT_THAT(refusal({"ball=0,0,0,0.01"}), HasSubstr("no material of its own"));
  EXPECT_THAT(refusal({"young=3"}), HasSubstr("gives 0 places; expected one"));
  EXPECT_THAT(refusal({"label=1; ball=0,0,0,1; young=3"}), HasSubstr("gives 2 places"));
  EXPECT_THAT(refusal({"ball=0,0,0,1; young=3; young=4"}), HasSubstr("gives young twice"));
  EXPECT_THAT(refusal({"ball=0,0,0,1; yuong=3"}),
              HasSubstr("found 'yuong'; expected label, box, ball, young"));
  EXPECT_THAT(refusal({"ball=0,0,0,0; young=3"}), HasSubstr("a radius above 0"));
  EXPECT_THAT(refusal({"ball=0,0,0; young=3"}), HasSubstr("expected ball=x,y,z,r"));
  EXPECT_THAT(refusal({"box=0,0,0,1,1,x; young=3"}), HasSubstr("expected box="));
  EXPECT_THAT(refusal({"ball=0,0,0,1; young=soft"}), HasSubstr("found young=soft; expected a number"));
  EXPECT_THAT(refusal({"ball=0,0,0,1; young=nan"}), HasSubstr("expected a number"));
  EXPECT_THAT(refusal({"label=2.5; young=3"}), HasSubstr("expected a whole number"));
}

TEST_F(RegionSpecTest, MaterialsThatNoSolidHasAreRefused) {
  EXPECT_THAT(refusal({"ball=0,0,0,1; young=-3"}), HasSubstr("young=-3: Young's modulus is -3"));
  EXPECT_THAT(refusal({"ball=0,0,0,1; poisson=0.5"}), HasSubstr("less than 0.5"));
  EXPECT_THAT(refusal({"ball=0,0,0,1; density=0"}), HasSubstr("expected a positive number (kg/m^3)"));
}

TEST_F(RegionSpecTest, RegionsWithoutATetrahedronAreRefused) {
  EXPECT_THAT(refusal({"ball=1,0,0,0.1; young=3"}),
              AllOf(HasSubstr("no tetrahedron has its centre there"),
                    HasSubstr("x 0 .. 0.04, y 0 .. 0.04, z 0 .. 0.04 m")));
  EXPECT_THAT(refusal({"ball=0,0,0,0.02; young=3", "box=0,0,0,1,1,1; young=4"}),
              HasSubstr("ball=0,0,0,0.02; young=3: all of its tetrahedra are those of later regions"));
  EXPECT_THAT(refusal({"label=1; young=3"}), HasSubstr("gives its tetrahedra no labels"));
  mesh.why_no_regions = "the arrays 'a' and 'b' both give labels, expected one";
  EXPECT_THAT(refusal({"label=1; young=3"}), HasSubstr("no labels: the arrays 'a' and 'b' both"));
  mesh.regions.assign(mesh.tetrahedra.size(), 2);
  mesh.regions[0] = 4;
  EXPECT_THAT(refusal({"label=1; young=3"}), HasSubstr("names no tetrahedron; the mesh has the labels 2, 4"));
  EXPECT_THAT(refusal({"label=2; young=3", "label=2; young=4"}),
              HasSubstr("names the label of --region label=2; young=3; expected each once"));
}

}  // namespace
}  // namespace omentum::organ
