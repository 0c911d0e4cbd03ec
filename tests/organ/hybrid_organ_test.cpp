// Organs with a dynamic part: how it is named, what is refused, and how they come back from a file.
#include "organ/dynamic_spec.h"
#include "organ/stored_tensors.h"
#include "organ/tensor_check.h"
#include "organ_file_fixture.h"
#include "physics/direct_solve.h"
#include "tests/organ/hostile_organ.h"

#include <fstream>

namespace omentum::organ {
namespace {

using geometry::TetId;
using testing::HasSubstr;

std::vector<std::uint8_t> beyond(const geometry::TetraMesh& mesh, double x) {
  return parse_dynamic(std::vector{"plane:x>" + std::to_string(x)}, mesh);
}

Organ hybrid_organ(double x = 0.04, Storage storage = Storage::kFloat) {
  Organ whole = small_organ(kTissue, storage);
  const std::vector<std::uint8_t> dynamic = beyond(whole.mesh, x);
  return make_organ("box", std::move(whole.mesh), kTissue, whole.fixed, storage, dynamic);
}

template <class Action>
std::string message_of(Action&& action) {
  try {
    action();
  } catch (const geometry::InputError& e) {
    return e.what();
  }
  return "accepted";
}

TEST(DynamicSpecTest, PlacesLabelsAndListsNameTetrahedraTogether) {
  geometry::TetraMesh mesh = small_organ().mesh;
  mesh.regions.assign(mesh.tetrahedra.size(), 1);
  mesh.regions[5] = 2;
  const test::ScratchFolder folder;
  const std::filesystem::path list = folder / "tets.csv";
  std::ofstream(list) << "tetrahedron\n0\n2\n";
  const auto named = [&](std::vector<std::string> specs) {
    std::vector<std::size_t> found;
    const auto flags = parse_dynamic(specs, mesh, geometry::Numbering::kPosition);
    for (std::size_t t = 0; t < flags.size(); ++t)
      if (flags[t] != 0) found.push_back(t);
    return found;
  };
  EXPECT_THAT(named({"label:2"}), testing::ElementsAre(5));
  EXPECT_THAT(named({list.string(), "label:2"}), testing::ElementsAre(0, 2, 5));
  EXPECT_EQ(named({"plane:x>0.04"}).size(), mesh.tetrahedra.size() / 3);
  EXPECT_EQ(named({"plane:x>0.04+plane:x<0.02"}).size(), 2 * mesh.tetrahedra.size() / 3);
  EXPECT_EQ(named({"box:0.04,0,0,1,1,1"}), named({"plane:x>0.04"}));
  EXPECT_TRUE(parse_dynamic({}, mesh).empty());
}

TEST(DynamicSpecTest, WhatNamesNothingIsRefusedWithItsSpec) {
  const geometry::TetraMesh mesh = small_organ().mesh;
  const auto refusal = [&](const std::string& spec) {
    return message_of([&] { parse_dynamic(std::vector{spec}, mesh); });
  };
  EXPECT_THAT(refusal("plane:x>1"), HasSubstr("--dynamic plane:x>1: names no tetrahedron"));
  EXPECT_THAT(refusal("plane:x"), HasSubstr("not a plane"));
  EXPECT_THAT(refusal("box:1,2"), HasSubstr("not a box"));
  EXPECT_THAT(refusal("label:a"), HasSubstr("not a label"));
  EXPECT_THAT(refusal("label:1"), HasSubstr("no labels"));
  EXPECT_THAT(refusal("absent.csv"), HasSubstr("absent.csv: cannot be read"));
}

TEST(SplitOrganTest, WhatCannotBeSplitIsRefused) {
  const Organ whole = small_organ();
  const std::size_t count = whole.mesh.tetrahedra.size();
  const auto refusal = [&](std::vector<std::uint8_t> dynamic) {
    return message_of([&] { split_organ(whole.mesh, whole.fixed, std::move(dynamic), "--dynamic: "); });
  };
  EXPECT_THAT(refusal(std::vector<std::uint8_t>(count, 0)),
              HasSubstr("--dynamic: the dynamic part holds no"));
  EXPECT_THAT(refusal(std::vector<std::uint8_t>(count, 1)), HasSubstr("holds every tetrahedron"));
  // the middle third: what is beyond it has no support
  std::vector<std::uint8_t> middle = beyond(whole.mesh, 0.02);
  const std::vector<std::uint8_t> outer = beyond(whole.mesh, 0.04);
  for (std::size_t t = 0; t < count; ++t) middle[t] = middle[t] != 0 && outer[t] == 0 ? 1 : 0;
  EXPECT_THAT(refusal(middle), HasSubstr("no support holds"));
  // a corner at the held end: nodes that connect are held
  std::vector<std::uint8_t> corner(count, 0);
  for (std::size_t t = 0; t < count; ++t)
    for (const geometry::NodeId n : whole.mesh.tetrahedra[t])
      if (whole.mesh.positions[n].isZero(1e-12)) corner[t] = 1;
  EXPECT_THAT(refusal(corner), HasSubstr("is held by a support"));
}

TEST(SplitOrganTest, WhatWouldHangBesideTheDynamicPartBecomesDynamic) {
  const geometry::TetraMesh mesh = small_organ().mesh;
  const std::vector<std::uint8_t> planned = beyond(mesh, 0.02);
  const auto touches_border_once = [&](const geometry::Tetrahedron& nodes) {
    return std::ranges::count_if(nodes,
                                 [&](auto n) { return std::abs(mesh.positions[n].x() - 0.02) < 1e-9; }) == 1;
  };
  std::vector<std::uint8_t> dynamic = planned;
  for (std::size_t t = 0; t < dynamic.size(); ++t) {
    if (planned[t] == 0 || !touches_border_once(mesh.tetrahedra[t])) continue;
    dynamic[t] = 0;
    break;
  }
  EXPECT_EQ(take_what_would_hang(mesh, dynamic), 1u);
  EXPECT_EQ(dynamic, planned);
  EXPECT_EQ(take_what_would_hang(mesh, dynamic), 0u);
}

TEST_F(OrganFileTest, AHybridOrgansPartsComeBackAndBelongToTheHash) {
  const Organ made = hybrid_organ();
  build_organ(made, file, {});
  const Organ found = load_organ(file, Load::kWithPart);
  EXPECT_EQ(found.hash, made.hash);
  ASSERT_TRUE(found.split);
  EXPECT_EQ(found.split->dynamic, made.split->dynamic);
  EXPECT_EQ(found.split->tensor_node, made.split->tensor_node);
  EXPECT_EQ(found.surface.node, made.surface.node);
  EXPECT_EQ(found.split->compliance->mobile_count(), made.split->surface.mobile_count);
  EXPECT_NE(hybrid_organ(0.02).hash, made.hash);
  EXPECT_NE(small_organ().hash, made.hash);
  EXPECT_TRUE(is_up_to_date(file, made));
  EXPECT_FALSE(is_up_to_date(file, small_organ()));
  require_whole(map_tensors(file, found), file);
}

// They are the precomputed part's own: how it yields where the dynamic part is taken away.
TEST_F(OrganFileTest, AHybridOrgansTensorsAreOfItsPrecomputedPart) {
  build_organ(hybrid_organ(), file, {});
  const Organ organ = load_organ(file, Load::kWithPart);
  const physics::MeshPart& part = organ.split->parts.precomputed;
  const physics::Stiffness K = physics::assemble_stiffness(part.mesh, organ.material);
  const geometry::SurfaceId c = organ.split->connection[4];
  std::vector<geometry::Vec3> loads(part.node.size(), geometry::Vec3::Zero());
  loads[organ.split->surface.node[c]] = {0.1, -0.2, 0.3};
  const auto exact = physics::direct_solve(K, organ.split->fixed, {}, loads).displacements;
  for (std::int32_t s = 0; s < organ.split->surface.mobile_count; ++s) {
    const geometry::Vec3 u =
        organ.split->compliance->block(geometry::SurfaceId(s), c) * loads[organ.split->surface.node[c]];
    EXPECT_LE((u - exact[organ.split->surface.node[s]]).norm(), 1e-9);
  }
  EXPECT_EQ(organ.split->connection.size(), 9u);
}

TEST_F(OrganFileTest, TensorsOfAPartAreNotThoseOfAWholeOrgan) {
  build_organ(hybrid_organ(), file, {});
  EXPECT_THAT(refusal(), HasSubstr("hybrid organ"));
  EXPECT_NO_THROW(load_organ(file, Load::kMeshOnly));
  build_organ(small_organ(), file, {});
  EXPECT_THAT(message_of([&] { load_organ(file, Load::kWithPart); }), HasSubstr("has no dynamic part"));
}

// With a hash that matches: what somebody wrote, or a version that numbers surfaces otherwise.
TEST_F(OrganFileTest, TensorsOfAnotherSplitAreRefused) {
  Organ other = hybrid_organ();
  build_organ(other, file, {});
  std::swap(other.split->tensor_node[0], other.split->tensor_node[1]);
  const auto forge = [&] {
    damage([&](hid_t hdf5) {
      put<std::int32_t>(hdf5, layout::kTensorNode, other.split->tensor_node, H5T_NATIVE_INT32);
      put<std::uint8_t>(hdf5, layout::kDynamic, other.split->dynamic, H5T_NATIVE_UINT8);
      const hid_t attribute = H5Aopen(hdf5, layout::kHash, H5P_DEFAULT);
      const hid_t type = H5Aget_type(attribute);
      const std::string hash = organ_hash(other);
      H5Awrite(attribute, type, hash.c_str());
      H5Tclose(type);
      H5Aclose(attribute);
    });
  };
  forge();
  EXPECT_THAT(message_of([&] { load_organ(file, Load::kWithPart); }), HasSubstr("those of another split"));
  other.split->dynamic.pop_back();
  forge();
  EXPECT_THAT(message_of([&] { load_organ(file, Load::kMeshOnly); }), HasSubstr("mesh/dynamic"));
  other.split->dynamic.assign(other.mesh.tetrahedra.size(), 1);
  forge();
  EXPECT_THAT(message_of([&] { load_organ(file, Load::kMeshOnly); }), HasSubstr("every tetrahedron"));
}

}  // namespace
}  // namespace omentum::organ
