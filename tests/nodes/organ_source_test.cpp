#include "node_common/organ_source.h"

#include <gtest/gtest.h>

namespace omentum::node {
namespace {

TEST(OrganSource, StatesOfEveryKindThatASceneCanNameAreKnown) {
  for (const auto& model : scene::kOrganModels) EXPECT_NO_THROW(state_kind(model.kind)) << model.word;
  EXPECT_EQ(state_kind(scene::OrganKind::kTetrahedralMesh), msg::KIND_SURFACE);
}

TEST(OrganSource, IsToldInTextsThatAMessageHolds) {
  OrganSource source;
  source.organ.name = std::string(100, 'n');
  source.organ.hash = std::string(64, 'a');
  EXPECT_EQ(describe(source).name, std::string(64, 'n'));
  EXPECT_EQ(describe(source).hash, source.organ.hash);
}

}  // namespace
}  // namespace omentum::node
