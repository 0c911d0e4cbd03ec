#include "physics/blas_kernels.h"

#include <gtest/gtest.h>

namespace omentum::physics {
namespace {

constexpr std::array kUnits{VectorUnit::kSse, VectorUnit::kAvx, VectorUnit::kAvx2, VectorUnit::kAvx512};

TEST(BlasKernels, AProcessorThatOpenBlasDoesNotKnowGetsTheKernelsOfItsUnit) {
  EXPECT_EQ(better_blas_core(VectorUnit::kAvx512, "Prescott"), "SkylakeX");
  EXPECT_EQ(better_blas_core(VectorUnit::kAvx512, "Haswell"), "SkylakeX");
  EXPECT_EQ(better_blas_core(VectorUnit::kAvx2, "Prescott"), "Haswell");
  EXPECT_EQ(better_blas_core(VectorUnit::kAvx, "Nehalem"), "Sandybridge");
}

TEST(BlasKernels, AChoiceThatUsesTheUnitStands) {
  for (const char* core : {"SkylakeX", "Cooperlake", "SapphireRapids", "SAPPHIRERAPIDS"})
    EXPECT_FALSE(better_blas_core(VectorUnit::kAvx512, core)) << core;
  for (const char* core : {"Haswell", "Zen", "SkylakeX"})
    EXPECT_FALSE(better_blas_core(VectorUnit::kAvx2, core)) << core;
  EXPECT_FALSE(better_blas_core(VectorUnit::kSse, "Prescott"));
}

TEST(BlasKernels, WhatIsAskedForIsNeverAskedAgain) {
  for (const VectorUnit unit : kUnits) {
    const auto asked = better_blas_core(unit, "Prescott");
    if (asked) {
      EXPECT_FALSE(better_blas_core(unit, *asked)) << *asked;
    }
  }
}

TEST(BlasKernels, OfThisProcessorAreSaid) {
  EXPECT_FALSE(blas_core().empty());
  EXPECT_GE(vector_unit(), VectorUnit::kSse);
}

}  // namespace
}  // namespace omentum::physics
