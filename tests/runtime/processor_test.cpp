#include "runtime/processor.h"

#include "runtime/built_for.h"

#include <gmock/gmock.h>

#include <array>

namespace omentum::runtime {
namespace {

TEST(Processor, WhatIsMissingIsNamedAndNothingElse) {
  const std::array<const char*, 3> needed{"avx", "avx2", "avx512f"};
  const auto old = [](const std::string& name) { return name == "avx"; };
  EXPECT_EQ(missing(needed, old), "avx2, avx512f");
  EXPECT_EQ(missing(needed, [](const std::string&) { return true; }), "");
  EXPECT_EQ(missing({}, [](const std::string&) { return false; }), "");
}

// Built here: each name of the list is one that the check knows and that this machine has.
TEST(Processor, TheMachineThatBuiltAProgramMayRunIt) {
  EXPECT_EQ(missing(built_for(), processor_has), "");
  EXPECT_NO_THROW(require_processor());
}

#if defined(__x86_64__)
TEST(Processor, KernelsForThisMachineAskForItsVectorUnit) {
  EXPECT_FALSE(processor_has("telepathy"));
  if (built_for().empty()) GTEST_SKIP() << "built with OMENTUM_NATIVE=OFF, or on a first x86-64";
  for (const char* name : {"avx", "avx2", "avx512f"}) {
    const bool asked = testing::Matches(testing::Contains(testing::StrEq(name)))(built_for());
    EXPECT_EQ(asked, processor_has(name)) << name;
  }
}
#endif

}  // namespace
}  // namespace omentum::runtime
