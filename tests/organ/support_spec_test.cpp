#include "organ/support_spec.h"

#include "tests/support/meshes.h"
#include "tests/support/process.h"

#include <gmock/gmock.h>

namespace omentum::organ {
namespace {

using testing::HasSubstr;

class SupportSpecTest : public testing::Test {
 protected:
  // node (i, j, k) has number i + 3 j + 9 k, 1 m apart
  const geometry::TetraMesh mesh = test::make_box_mesh(2, 2, 2, {2, 2, 2});
  test::ScratchFolder folder;

  physics::FixedComponents parse(const std::vector<std::string>& specs) const {
    return parse_supports(specs, mesh);
  }

  std::string refusal(const std::string& spec) const {
    try {
      parse({spec});
    } catch (const geometry::InputError& e) {
      return e.what();
    }
    return "accepted";
  }

  std::string csv(const std::string& text) const {
    std::ofstream(folder / "nodes.csv") << text;
    return (folder / "nodes.csv").string();
  }

  static int count(const physics::FixedComponents& fixed, int components) {
    return static_cast<int>(std::ranges::count(fixed, components));
  }
};

TEST_F(SupportSpecTest, PlaneHoldsOneSide) {
  EXPECT_EQ(count(parse({"plane:x<0.5"}), 7), 9);
  EXPECT_EQ(count(parse({"plane:z>0.5"}), 7), 18);
}

TEST_F(SupportSpecTest, SeveralPlacesAreJoinedByAPlus) {
  const auto fixed = parse({"box:0,0,0,0.5,0.5,2+box:1.5,1.5,0,2,2,2:z+plane:x>+1.5:y"});
  EXPECT_EQ(count(fixed, 7), 3);
  EXPECT_EQ(count(fixed, 4 | 2), 3) << "held by the second and the third";
  EXPECT_EQ(count(fixed, 2), 6);
  EXPECT_THAT(refusal("box:0,0,0,1,1,1+plane:x"), HasSubstr("--fixed plane:x: not a plane"));
}

TEST_F(SupportSpecTest, BoxHoldsItsInsideAndFacesInAnyOrderOfCorners) {
  EXPECT_EQ(count(parse({"box:0,0,0,1,1,1"}), 7), 8);
  EXPECT_EQ(count(parse({"box:1,1,1,0,0,0"}), 7), 8);
}

TEST_F(SupportSpecTest, ComponentsAreSingle) {
  const auto fixed = parse({"plane:x<0.5:xz"});
  EXPECT_EQ(count(fixed, 1 + 4), 9);
  EXPECT_EQ(count(fixed, 0), 18);
}

TEST_F(SupportSpecTest, SeveralSpecsAreUnited) {
  const auto fixed = parse({"plane:x<0.5:x", "plane:y<0.5:y"});
  EXPECT_EQ(count(fixed, 1), 6);
  EXPECT_EQ(count(fixed, 2), 6);
  EXPECT_EQ(count(fixed, 3), 3);
}

TEST_F(SupportSpecTest, CsvListsNodesOfTheFile) {
  const auto fixed = parse({csv("node\n0\n26\n") + ":z"});
  EXPECT_EQ(fixed[0], 4);
  EXPECT_EQ(fixed[26], 4);
  EXPECT_EQ(count(fixed, 0), 25);
}

TEST_F(SupportSpecTest, NumbersAreTheFilesOwnUnlessPositionsAreAskedFor) {
  geometry::RawMesh raw = test::make_raw_box(2, 2, 2, {2, 2, 2});
  for (int n = 0; n < 27; ++n) raw.node_numbers.push_back(1000 - 10 * n);
  const geometry::TetraMesh own = geometry::check_mesh(raw, 1).mesh;
  const std::vector<std::string> specs = {csv("740\n1000\n")};
  const auto fixed = parse_supports(specs, own);
  EXPECT_EQ(fixed[26] + fixed[0], 2 * physics::kPinned);
  EXPECT_EQ(count(fixed, 0), 25);
  const std::vector<std::string> by_position = {csv("26\n")};
  EXPECT_THROW(parse_supports(by_position, own), geometry::InputError);
  EXPECT_EQ(parse_supports(by_position, own, geometry::Numbering::kPosition)[26], physics::kPinned);
}

TEST_F(SupportSpecTest, AMergedNodeHoldsTheOneThatTookItsPlace) {
  geometry::RawMesh raw = test::make_raw_box(2, 2, 2, {2, 2, 2});
  raw.positions.push_back(raw.positions[13]);
  for (auto& node : raw.tetrahedra[0]) node = node == 13 ? 27 : node;
  const geometry::CheckedMesh checked = geometry::check_mesh(raw, 1, {.merge_m = 1e-6});
  ASSERT_EQ(checked.mesh.merged.size(), 1u);
  const std::vector<std::string> specs = {csv("27\n")};
  const auto fixed = parse_supports(specs, checked.mesh);
  EXPECT_EQ(fixed[13], physics::kPinned);
  EXPECT_EQ(count(fixed, physics::kPinned), 1);
}

TEST_F(SupportSpecTest, ASpecThatHoldsNothingNamesTheExtent) {
  EXPECT_THAT(refusal("plane:x<-1"),
              AllOf(HasSubstr("plane:x<-1"), HasSubstr("x 0 .. 2"), HasSubstr("z 0 .. 2")));
  EXPECT_THAT(refusal("box:5,5,5,6,6,6"), HasSubstr("holds no node"));
}

TEST_F(SupportSpecTest, WrongSpecsAreRefusedWithAnExample) {
  for (const char* wrong :
       {"plane:w<1", "plane:x=1", "plane:x<", "plane:", "plane:x<1e999", "plane:x<1:q", "plane:x"}) {
    EXPECT_THAT(refusal(wrong), HasSubstr("plane:x<0.03")) << wrong;
  }
  for (const char* wrong : {"box:1,2,3", "box:", "box:a,b,c,d,e,f"}) {
    EXPECT_THAT(refusal(wrong), HasSubstr("box:x0,y0,z0,x1,y1,z1")) << wrong;
  }
  EXPECT_THAT(refusal("nowhere.csv"), HasSubstr("nowhere.csv"));
}

TEST_F(SupportSpecTest, UnknownNodeIsRefusedWithItsLine) {
  EXPECT_THAT(refusal(csv("0\n27\n")),
              AllOf(HasSubstr("nodes.csv:2"), HasSubstr("27"), HasSubstr("0 to 26")));
  EXPECT_THAT(refusal(csv("-1\n")), HasSubstr("-1"));
  EXPECT_THAT(refusal(csv("1.5\n")), HasSubstr("1.5"));
}

}  // namespace
}  // namespace omentum::organ
