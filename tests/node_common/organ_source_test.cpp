#include "node_common/organ_source.h"

#include <gmock/gmock.h>

namespace omentum::node {
namespace {

TEST(OrganSource, StatesOfEveryKindThatASceneCanNameAreKnown) {
  for (const auto& model : scene::kOrganModels) EXPECT_NO_THROW(state_kind(model.kind)) << model.word;
  EXPECT_EQ(state_kind(scene::OrganKind::kTetrahedralMesh), msg::KIND_SURFACE);
  EXPECT_EQ(state_kind(scene::OrganKind::kTube), msg::KIND_TUBE);
}

scene::OrganSpec intestine() {
  scene::OrganSpec spec;
  spec.name = "gut";
  spec.model = "intestine";
  spec.kind = scene::OrganKind::kTube;
  spec.intestine.emplace().where = "scene.toml:4";
  return spec;
}

TEST(OrganSource, AnIntestineIsMadeFromTheScenesNumbersAndNeedsNoFile) {
  const scene::OrganSpec spec = intestine();
  const OrganSource source = load_organ_source({}, spec, organ::Load::kMeshOnly);
  ASSERT_TRUE(source.gut);
  EXPECT_EQ(source.gut->layout,
            (geometry::GutLayout{spec.intestine->anatomy.rows, spec.intestine->anatomy.columns}));
  EXPECT_EQ(source.rest, source.gut->positions);
  EXPECT_EQ(describe(source).name, "gut");
  EXPECT_EQ(describe(source).kind, msg::KIND_TUBE);
}

TEST(OrganSource, AnIntestinesHashIsThatOfItsNumbers) {
  scene::OrganSpec one = intestine(), other = intestine();
  const auto hash = [](const scene::OrganSpec& spec) {
    return load_organ_source({}, spec, organ::Load::kMeshOnly).organ.hash;
  };
  EXPECT_EQ(hash(one), hash(other));
  other.intestine->anatomy.origin.x() += 1e-9;
  EXPECT_NE(hash(one), hash(other));
}

TEST(OrganSource, AnImpossibleIntestineIsRefusedWithItsPlaceInTheScene) {
  scene::OrganSpec spec = intestine();
  spec.intestine->anatomy.fold_pitch_m = spec.intestine->anatomy.tube_radius_m;
  try {
    load_organ_source({}, spec, organ::Load::kMeshOnly);
    FAIL() << "it was made";
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), ::testing::AllOf(::testing::HasSubstr("scene.toml:4: organ gut: "),
                                               ::testing::HasSubstr("fold_pitch_m")));
  }
}

TEST(OrganSource, IsToldByNameHashAndKind) {
  OrganSource source;
  source.organ.name = "liver";
  source.organ.hash = "abc";
  EXPECT_EQ(describe(source), (msg::OrganInfo{.name = "liver", .hash = "abc", .kind = msg::KIND_SURFACE}));
}

}  // namespace
}  // namespace omentum::node
