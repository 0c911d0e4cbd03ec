#include "node_common/organ_source.h"

#include <gtest/gtest.h>

namespace omentum::node {
namespace {

TEST(OrganSource, StatesOfEveryKindThatASceneCanNameAreKnown) {
  for (const auto& model : scene::kOrganModels) EXPECT_NO_THROW(state_kind(model.kind)) << model.word;
  EXPECT_EQ(state_kind(scene::OrganKind::kTetrahedralMesh), msg::KIND_SURFACE);
}

TEST(OrganSource, IsToldByNameHashAndKind) {
  OrganSource source;
  source.organ.name = "liver";
  source.organ.hash = "abc";
  EXPECT_EQ(describe(source), (msg::OrganInfo{.name = "liver", .hash = "abc", .kind = msg::KIND_SURFACE}));
}

}  // namespace
}  // namespace omentum::node
