#include "physics/intestine/gut_explicit.h"
#include "physics/intestine/gut_projective.h"

#include "tests/physics/intestine/gut_shapes.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace omentum::physics {
namespace {

TEST(GutExplicit, AStepAboveTheStableOneIsRefused) {
  const GutSprings springs(test::hanging_gut({}), {});
  EXPECT_THROW(GutExplicit(springs, 1.01 * stable_step_s(springs)), std::invalid_argument);
  EXPECT_NO_THROW(GutExplicit(springs, stable_step_s(springs)));
}

}  // namespace
}  // namespace omentum::physics
