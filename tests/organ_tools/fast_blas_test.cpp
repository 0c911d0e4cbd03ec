// A processor that OpenBLAS does not know, played by a library that stands before it.
#include "tests/support/meshes.h"
#include "tests/support/process.h"

#include "physics/blas_kernels.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>

namespace omentum::organ_tools {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

class FastBlas : public ::testing::Test {
 protected:
  void SetUp() override {
    if (physics::vector_unit() == physics::VectorUnit::kSse) GTEST_SKIP() << "no vector unit to use";
    if (std::getenv("OPENBLAS_CORETYPE") != nullptr) GTEST_SKIP() << "OPENBLAS_CORETYPE is set here";
    geometry::write_mesh(test::make_box_mesh(4, 3, 3, {0.12, 0.09, 0.06}), folder_ / "box.msh");
  }

  /// organ_build where OpenBLAS seems to have chosen its Prescott kernels; what it said on stderr.
  std::string build(std::vector<std::string> environment, const std::string& mesh, int expected_code) {
    environment.emplace_back("LD_PRELOAD=" PRESCOTT_LIBRARY);
    for (const char* word : {OMENTUM_BIN_DIR "/organ_build", mesh.c_str(), "-o"})
      environment.emplace_back(word);
    environment.emplace_back(folder_ / "organ.h5");
    for (const char* word : {"--young", "3000", "--poisson", "0.45", "--density", "1000", "--scale", "1",
                             "--fixed", "plane:x<0.01"})
      environment.emplace_back(word);
    test::Process process("/usr/bin/env", environment);
    EXPECT_EQ(process.wait(), expected_code) << process.messages();
    return process.messages();
  }

  test::ScratchFolder folder_;
};

TEST_F(FastBlas, OldKernelsAreReplacedAndItIsSaidInALine) {
  EXPECT_THAT(build({}, folder_ / "box.msh", 0), HasSubstr("chose its Prescott kernels: started anew with"));
}

TEST_F(FastBlas, APersonsOwnChoiceStands) {
  EXPECT_THAT(build({"OPENBLAS_CORETYPE=Nehalem"}, folder_ / "box.msh", 0), Not(HasSubstr("Prescott")));
}

TEST_F(FastBlas, ARefusalIsStillOneLine) {
  const std::string said = build({}, folder_ / "missing.msh", 2);
  EXPECT_EQ(std::count(said.begin(), said.end(), '\n'), 1) << said;
}

}  // namespace
}  // namespace omentum::organ_tools
