// A caller that breaks its word ends the process where it did, in release builds too.
#include "geometry/precondition.h"

#include <gtest/gtest.h>

namespace omentum::geometry {
namespace {

TEST(PreconditionDeathTest, SaysWhereAndWhatWasExpected) {
  require(true, "nothing");
  EXPECT_DEATH(require(false, "a force for each node"),
               "precondition_test.cpp.*expected a force for each node");
}

}  // namespace
}  // namespace omentum::geometry
