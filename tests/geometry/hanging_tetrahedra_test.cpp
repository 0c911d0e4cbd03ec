#include "geometry/hanging_tetrahedra.h"

#include "geometry/tetra_mesh.h"
#include "tests/support/meshes.h"

#include <gmock/gmock.h>

#include <algorithm>

namespace omentum::geometry {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

CheckedMesh repaired(const RawMesh& raw) {
  return check_mesh(raw, 1, {.repair = true});
}

std::string refusal(const RawMesh& raw, const CheckOptions& options) {
  try {
    check_mesh(raw, 1, options);
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

// Adds a tetrahedron with these corners, of which those that are missing become new nodes 2 mm
// beyond the first one.
void hang(RawMesh& raw, std::vector<std::int32_t> corners) {
  constexpr double kSize_m = 2e-3;
  const Vec3 outside = raw.positions[static_cast<std::size_t>(corners[0])];
  const std::array<Vec3, 3> away = {Vec3(0, kSize_m, 0), Vec3(0, 0, kSize_m), Vec3(kSize_m, 0, 0)};
  for (std::size_t i = 0; corners.size() < 4; ++i) {
    corners.push_back(static_cast<std::int32_t>(raw.positions.size()));
    raw.positions.push_back(outside + away[i]);
  }
  raw.tetrahedra.push_back({corners[0], corners[1], corners[2], corners[3]});
}

// A box of 20 x 20 x 20 mm whose last node is its farthest corner, and its mesh.
RawMesh box() {
  return test::make_raw_box(3, 3, 3, {0.02, 0.02, 0.02});
}

TEST(HangingTetrahedra, NothingHangsInAValidMesh) {
  const RawMesh raw = box();
  EXPECT_THAT(hanging_tetrahedra(raw.tetrahedra, raw.positions.size()), IsEmpty());
}

TEST(HangingTetrahedra, WhatHangsOnANodeIsDroppedWithAWordAndNothingElse) {
  RawMesh raw = box();
  const CheckedMesh whole = check_mesh(raw, 1);
  hang(raw, {63});
  ASSERT_THAT(refusal(raw, {}), HasSubstr("touch there in a point"));

  const CheckedMesh checked = repaired(raw);

  EXPECT_EQ(checked.mesh.positions, whole.mesh.positions);
  EXPECT_EQ(checked.mesh.tetrahedra, whole.mesh.tetrahedra);
  EXPECT_THAT(checked.warnings,
              ElementsAre(HasSubstr("repaired: dropped 1 tetrahedron 162 with 1.33333 mm^3, 0.0166"),
                          HasSubstr("3 nodes belong to no tetrahedron")));
}

TEST(HangingTetrahedra, WhatHangsOnAnEdgeIsDropped) {
  RawMesh raw = box();
  hang(raw, {63, 62});
  ASSERT_THAT(refusal(raw, {}), HasSubstr("along an edge only"));

  EXPECT_THAT(hanging_tetrahedra(raw.tetrahedra, raw.positions.size()), ElementsAre(162));
  EXPECT_THAT(repaired(raw).mesh.tetrahedra, SizeIs(162));
}

TEST(HangingTetrahedra, AWholePartThatHangsOnANodeIsDropped) {
  RawMesh raw = box();
  hang(raw, {63});
  hang(raw, {65, 64, 66});
  EXPECT_THAT(hanging_tetrahedra(raw.tetrahedra, raw.positions.size()), ElementsAre(162, 163));
}

TEST(HangingTetrahedra, HollowsThatTouchArePartedAndTheMeshIsAccepted) {
  RawMesh raw = test::make_raw_box(6, 6, 6, {1, 1, 1});
  RawMesh hollow = raw;
  hollow.tetrahedra.clear();
  for (std::size_t t = 0; t < raw.tetrahedra.size(); ++t) {
    const std::size_t cube = t / 6;  // (2, 2, 2) and (3, 3, 3)
    if (cube != 2 * 43 && cube != 3 * 43) hollow.tetrahedra.push_back(raw.tetrahedra[t]);
  }
  ASSERT_THAT(refusal(hollow, {}), HasSubstr("joining boundary faces"));

  const CheckedMesh checked = repaired(hollow);

  EXPECT_LT(checked.mesh.tetrahedra.size(), hollow.tetrahedra.size());
  EXPECT_GT(checked.mesh.tetrahedra.size(), hollow.tetrahedra.size() - 10);
}

TEST(HangingTetrahedra, NumbersAndLabelsStayWithTheirTetrahedra) {
  RawMesh raw = box();
  hang(raw, {63});
  std::rotate(raw.tetrahedra.begin(), raw.tetrahedra.end() - 1, raw.tetrahedra.end());  // now the first
  for (std::size_t t = 0; t < raw.tetrahedra.size(); ++t) {
    raw.tetrahedron_numbers.push_back(1000 + 3 * static_cast<std::int64_t>(t));
    raw.regions.push_back(static_cast<std::int32_t>(t % 5));
  }

  const CheckedMesh checked = repaired(raw);

  EXPECT_THAT(checked.warnings[0], HasSubstr("dropped 1 tetrahedron 1000 with"));
  EXPECT_TRUE(std::equal(checked.mesh.tetrahedron_numbers.begin(), checked.mesh.tetrahedron_numbers.end(),
                         raw.tetrahedron_numbers.begin() + 1, raw.tetrahedron_numbers.end()));
  EXPECT_TRUE(std::equal(checked.mesh.regions.begin(), checked.mesh.regions.end(), raw.regions.begin() + 1,
                         raw.regions.end()));
}

TEST(HangingTetrahedra, AMergedNodeThatIsDroppedIsNoneOfTheMeshs) {
  RawMesh raw = box();
  hang(raw, {63});
  // a second one beside it, glued by copying
  raw.positions.push_back(raw.positions[64]);
  raw.positions.push_back(raw.positions[63] + Vec3(2e-3, 2e-3, 0));
  raw.tetrahedra.push_back({63, 65, 67, 68});

  const CheckedMesh checked = check_mesh(raw, 1, {.merge_m = 1e-9, .repair = true});

  EXPECT_THAT(checked.mesh.tetrahedra, SizeIs(162));
  EXPECT_THAT(checked.mesh.merged, IsEmpty());
}

TEST(HangingTetrahedra, LaterRefusalsNameTheFilesNumbers) {
  RawMesh raw = box();
  hang(raw, {63});
  std::rotate(raw.tetrahedra.begin(), raw.tetrahedra.end() - 1, raw.tetrahedra.end());
  raw.positions[21] = raw.positions[22] + Vec3(2e-3, 0, 0);  // an inner node goes through a neighbour
  ASSERT_THAT(refusal(raw, {}), HasSubstr("overlapping"));

  const std::string before = refusal(raw, {}), after = refusal(raw, {.repair = true});

  const auto named = [](const std::string& reasons) {
    const std::size_t end = reasons.find(": on the same side"), begin = reasons.rfind("tetrahedra", end);
    return end == std::string::npos ? reasons : reasons.substr(begin, end - begin);
  };
  EXPECT_EQ(named(after), named(before));
}

TEST(HangingTetrahedra, PartsThatDoNotTouchAreStillRefused) {
  RawMesh raw = box();
  const RawMesh other = box();
  for (const Vec3& p : other.positions) raw.positions.push_back(p + Vec3(1, 0, 0));
  for (auto v : other.tetrahedra) {
    for (std::int32_t& n : v) n += 64;
    raw.tetrahedra.push_back(v);
  }
  EXPECT_THAT(refusal(raw, {.repair = true}), HasSubstr("in parts that no faces connect"));
}

TEST(HangingTetrahedra, APartOfTheOrganIsNotDropped) {
  // two cubes that share a corner: half of the organ
  RawMesh raw = test::make_raw_box(2, 2, 2, {1, 1, 1});
  std::vector<std::array<std::int32_t, 4>> ends(raw.tetrahedra.begin(), raw.tetrahedra.begin() + 6);
  ends.insert(ends.end(), raw.tetrahedra.end() - 6, raw.tetrahedra.end());
  raw.tetrahedra = ends;
  EXPECT_THAT(refusal(raw, {.repair = true}),
              AllOf(HasSubstr("would drop 6 tetrahedra 6, 7, 8, 9, 10, ... (6 in all) with"),
                    HasSubstr("50 % of the volume"), HasSubstr("expected at most 5 %")));
}

}  // namespace
}  // namespace omentum::geometry
