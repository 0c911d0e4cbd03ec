// Organs of two meshes that share no nodes: what is joined, what is refused, and how they come back.
#include "organ/joined_parts.h"
#include "organ_file_fixture.h"

namespace omentum::organ {
namespace {

using geometry::Vec3;
using testing::HasSubstr;

// 4 cm of a bar of 3 x 3 cm, from `x` on.
geometry::TetraMesh piece_of_bar(double x_m, int along, int across) {
  geometry::TetraMesh mesh = test::make_box_mesh(along, across, across, {0.04, 0.03, 0.03});
  for (Vec3& p : mesh.positions) p.x() += x_m;
  return mesh;
}

JoinedParts joined_bar(double gap_m = 0, int fine = 3, int coarse = 2) {
  return join_parts(piece_of_bar(0, 4, fine), piece_of_bar(0.04 + gap_m, 3, coarse), 0, "--dynamic-mesh: ");
}

FixedComponents held_where(const geometry::TetraMesh& mesh, double x_m) {
  FixedComponents fixed;
  for (const Vec3& p : mesh.positions) fixed.push_back(std::abs(p.x() - x_m) < 1e-9 ? physics::kPinned : 0);
  return fixed;
}

Organ tied_organ(JoinedParts joined, double held_m = 0) {
  FixedComponents fixed = held_where(joined.mesh, held_m);
  return make_organ("bar", std::move(joined.mesh), kTissue, std::move(fixed), Storage::kFloat,
                    std::move(joined.dynamic), std::move(joined.border));
}

template <class Action>
std::string tie_refusal(Action&& action) {
  try {
    action();
  } catch (const geometry::InputError& e) {
    return e.what();
  }
  return "accepted";
}

TEST(JoinedPartsTest, TheBorderIsWhereTheyTouch) {
  const JoinedParts joined = joined_bar();
  EXPECT_EQ(joined.border.size(), 2u * 9 + 2u * 4) << "faces of both ends that meet";
  for (const auto& face : joined.border)
    for (const geometry::NodeId n : face) EXPECT_NEAR(joined.mesh.positions[n].x(), 0.04, 1e-12);
  const auto count = static_cast<std::size_t>(std::ranges::count(joined.dynamic, 1));
  EXPECT_EQ(count, 6u * 3 * 4);
  EXPECT_EQ(joined.dynamic.front(), 0);
  // a gap or an overlap of a hundredth of an edge is one of rounding
  EXPECT_EQ(joined_bar(1e-4).border.size(), joined.border.size());
  EXPECT_EQ(joined_bar(-1e-4).border.size(), joined.border.size());
}

TEST(JoinedPartsTest, NumbersOfTheSecondFileGoOnBehindTheFirst) {
  geometry::TetraMesh fine = piece_of_bar(0, 4, 3), coarse = piece_of_bar(0.04, 3, 2);
  for (std::int64_t& n : fine.node_numbers) n += 1;
  for (std::int64_t& n : coarse.node_numbers) n += 1;
  const auto first = static_cast<std::int64_t>(fine.positions.size());
  const JoinedParts joined = join_parts(fine, coarse, 0, "");
  EXPECT_EQ(joined.node_shift, first);
  EXPECT_EQ(joined.mesh.node_numbers[fine.positions.size()], first + 1);
  const auto names = joined.mesh.names_of_nodes(geometry::Numbering::kFile);
  EXPECT_EQ(names.position_of(first + 1), static_cast<std::int32_t>(first));
}

TEST(JoinedPartsTest, PartsThatDoNotMeetAreRefused) {
  EXPECT_THAT(tie_refusal([] { joined_bar(2e-3); }), HasSubstr("--dynamic-mesh: the parts do not touch"));
  EXPECT_THAT(tie_refusal([] { joined_bar(-3e-3); }), HasSubstr("the parts overlap by 3 mm; expected"));
  EXPECT_NO_THROW(join_parts(piece_of_bar(0, 4, 3), piece_of_bar(0.042, 3, 2), 2.5e-3, ""));
}

TEST(TiedSplitTest, WhatCannotBeTiedIsRefused) {
  EXPECT_THAT(tie_refusal([] { tied_organ(joined_bar(0, 2, 3)); }), HasSubstr("the coarser one there"));
  EXPECT_THAT(tie_refusal([] { tied_organ(joined_bar(), 0.04); }), HasSubstr("is held by a support"));
  EXPECT_THAT(tie_refusal([] { tied_organ(joined_bar(), 0.08); }), HasSubstr("no support holds"));
  EXPECT_THAT(
      tie_refusal([] {
        JoinedParts joined = joined_bar();
        joined.border.front() = {joined.border.front()[0], geometry::NodeId(1 << 30), geometry::NodeId(0)};
        tied_organ(std::move(joined));
      }),
      HasSubstr("none of either part's surface"));
}

TEST_F(OrganFileTest, ATiedOrganComesBackAndItsBorderBelongsToTheHash) {
  const Organ made = tied_organ(joined_bar());
  build_organ(made, file, {});
  const Organ found = load_organ(file, Load::kWithPart);
  EXPECT_EQ(found.hash, made.hash);
  ASSERT_TRUE(found.split && found.split->tie);
  EXPECT_EQ(found.split->border, made.split->border);
  EXPECT_EQ(found.split->connection.size(), 16u);
  EXPECT_EQ(found.split->tie->map.masters.size(), 9u);
  EXPECT_TRUE(found.split->tie->map.P.isApprox(made.split->tie->map.P));
  EXPECT_TRUE(is_up_to_date(file, made));
  // as a program reads it that knows no border: its hash is another one, and it refuses the file
  Organ without = tied_organ(joined_bar());
  without.split->border.clear();
  EXPECT_NE(organ_hash(without), made.hash);
}

TEST_F(OrganFileTest, ADamagedBorderIsRefused) {
  Organ made = tied_organ(joined_bar());
  build_organ(made, file, {});
  std::vector<std::int32_t> nodes(3 * made.split->border.size(), 1 << 30);
  made.split->border.assign(made.split->border.size(), {geometry::NodeId(1 << 30), geometry::NodeId(1 << 30),
                                                        geometry::NodeId(1 << 30)});
  damage([&](hid_t hdf5) {
    const hid_t dataset = H5Dopen2(hdf5, layout::kBorder, H5P_DEFAULT);
    H5Dwrite(dataset, H5T_NATIVE_INT32, H5S_ALL, H5S_ALL, H5P_DEFAULT, nodes.data());
    H5Dclose(dataset);
    const hid_t attribute = H5Aopen(hdf5, layout::kHash, H5P_DEFAULT);
    const hid_t type = H5Aget_type(attribute);
    H5Awrite(attribute, type, organ_hash(made).c_str());
    H5Tclose(type);
    H5Aclose(attribute);
  });
  EXPECT_THAT(tie_refusal([&] { load_organ(file, Load::kMeshOnly); }),
              HasSubstr("none of either part's surface"));
}

}  // namespace
}  // namespace omentum::organ
