#include "geometry/surface.h"
#include "organ_tools/phantom/label_volume.h"
#include "organ_tools/phantom/liver_shape.h"
#include "tests/support/process.h"

#include <gmock/gmock.h>

#include <cmath>
#include <cstring>
#include <queue>

namespace omentum::phantom {
namespace {

using geometry::Surface;
using geometry::TetraMesh;
using geometry::Triangle;

constexpr double kVoxel = 1.5e-3;  // m

TEST(LiverShape, IsAboutEighteenCentimetresAcrossInsideItsExtent) {
  const LabelVolume volume = sample_liver(kVoxel);
  std::array<int, 3> low = {1 << 20, 1 << 20, 1 << 20}, high = {-1, -1, -1};
  std::size_t voxels = 0, at = 0;
  for (int k = 0; k < volume.size[2]; ++k) {
    for (int j = 0; j < volume.size[1]; ++j) {
      for (int i = 0; i < volume.size[0]; ++i) {
        if (volume.labels[at++] == 0) continue;
        ++voxels;
        const std::array<int, 3> here = {i, j, k};
        for (std::size_t a = 0; a < 3; ++a) {
          low[a] = std::min(low[a], here[a]);
          high[a] = std::max(high[a], here[a]);
        }
      }
    }
  }
  EXPECT_NEAR((high[0] - low[0]) * kVoxel, 0.18, 0.005);
  for (std::size_t a = 0; a < 3; ++a) {
    EXPECT_GT(low[a], 0);
    EXPECT_LT(high[a], volume.size[a] - 1);
  }
  // an adult's liver of 1.5 l and 23 cm across, scaled to 18 cm, and as much either way as adults differ
  EXPECT_NEAR(static_cast<double>(voxels) * std::pow(kVoxel, 3), 0.72e-3, 0.15e-3);
}

TEST(LiverShape, IsInOnePiece) {
  const LabelVolume volume = sample_liver(3e-3);
  const std::array<std::ptrdiff_t, 3> stride = {1, volume.size[0],
                                                static_cast<std::ptrdiff_t>(volume.size[0]) * volume.size[1]};
  std::vector<bool> seen(volume.labels.size(), false);
  int pieces = 0;
  for (std::size_t start = 0; start < seen.size(); ++start) {
    if (volume.labels[start] == 0 || seen[start]) continue;
    ++pieces;
    std::queue<std::size_t> open;
    open.push(start);
    seen[start] = true;
    while (!open.empty()) {
      const auto at = static_cast<std::ptrdiff_t>(open.front());
      open.pop();
      for (const std::ptrdiff_t step : stride) {
        for (const std::ptrdiff_t next : {at - step, at + step}) {
          const auto index = static_cast<std::size_t>(next);
          if (volume.labels[index] == 0 || seen[index]) continue;
          seen[index] = true;
          open.push(index);
        }
      }
    }
  }
  EXPECT_EQ(pieces, 1);
}

TEST(LiverShape, RightLobeIsThickerThanTheLeft) {
  const auto thickness = [](double x, double y) {
    int inside = 0;
    for (double z = -0.08; z < 0.06; z += 1e-3) inside += liver_distance({x, y, z}) < 0;
    return inside * 1e-3;
  };
  EXPECT_GT(thickness(-0.035, 0.0), 0.045);
  EXPECT_LT(thickness(0.055, 0.03), 0.6 * thickness(-0.035, 0.0));
  EXPECT_GT(thickness(0.055, 0.03), 0.01);
}

TEST(LiverShape, TheGallbladderHasItsFossaOnTheUnderside) {
  const auto underside = [](double x, double y) {
    double z = -0.08;
    while (z < 0.06 && liver_distance({x, y, z}) > 0) z += 1e-4;
    return z;
  };
  EXPECT_GT(underside(-0.0112, -0.030), underside(-0.035, -0.030) + 0.006);
  EXPECT_GT(underside(-0.0112, -0.030), underside(0.012, -0.030) + 0.006);
}

TEST(LabelVolume, NiftiFileHoldsHeaderAndLabelsInMillimetres) {
  const test::ScratchFolder folder;
  const LabelVolume volume = sample_liver(6e-3);
  write_nifti(volume, folder / "liver.nii");
  const std::string file = test::read_text(folder / "liver.nii");
  ASSERT_EQ(file.size(), 352 + volume.labels.size());
  const auto at = [&]<class T>(std::size_t offset, T value) {
    std::memcpy(&value, file.data() + offset, sizeof(T));
    return value;
  };
  // offsets of nifti1.h
  EXPECT_EQ(at(0, std::int32_t{}), 348);
  EXPECT_EQ(at(40, std::int16_t{}), 3);
  for (std::size_t a = 0; a < 3; ++a) EXPECT_EQ(at(42 + 2 * a, std::int16_t{}), volume.size[a]);
  EXPECT_EQ(at(70, std::int16_t{}), 2);  // unsigned char
  EXPECT_EQ(at(72, std::int16_t{}), 8);
  EXPECT_FLOAT_EQ(at(80, float{}), 6.0f);
  EXPECT_FLOAT_EQ(at(108, float{}), 352.0f);
  EXPECT_EQ(file[123], 2);                  // millimetres
  EXPECT_EQ(at(254, std::int16_t{}), 1);    // sform_code
  EXPECT_FLOAT_EQ(at(280, float{}), 6.0f);  // srow_x
  EXPECT_FLOAT_EQ(at(292, float{}), static_cast<float>(1e3 * volume.origin.x()));
  EXPECT_FLOAT_EQ(at(300, float{}), 6.0f);  // srow_y
  EXPECT_FLOAT_EQ(at(320, float{}), 6.0f);  // srow_z
  EXPECT_EQ(file.substr(344, 4), std::string("n+1\0", 4));
  EXPECT_EQ(std::memcmp(file.data() + 352, volume.labels.data(), volume.labels.size()), 0);
}

class OrganPhantom : public testing::Test {
 protected:
  void SetUp() override {
    if (!std::filesystem::exists(std::filesystem::path(OMENTUM_BIN_DIR) / "organ_phantom")) {
      GTEST_SKIP() << "organ_phantom is not built here (it needs CGAL and no sanitizer)";
    }
  }
  test::ScratchFolder folder_;
};

TEST_F(OrganPhantom, MakesAValidLiverOfThePapersSizeAndTheSameAgain) {
  const std::string file = (folder_ / "a.msh").string(), again = (folder_ / "b.msh").string();
  ASSERT_EQ(test::Process("organ_phantom",
                          {"--size", "paper", "-o", file, "--labels", (folder_ / "a.nii").string()})
                .wait(),
            0);
  ASSERT_EQ(test::Process("organ_phantom", {"-o", again}).wait(), 0);
  EXPECT_EQ(test::read_text(file), test::read_text(again));
  EXPECT_TRUE(std::filesystem::exists(folder_ / "a.nii"));

  const geometry::CheckedMesh checked = geometry::check_mesh(geometry::read_mesh(file), 1.0);
  EXPECT_TRUE(checked.warnings.empty());
  const TetraMesh& mesh = checked.mesh;
  EXPECT_GE(mesh.positions.size(), 1500u);
  EXPECT_LE(mesh.positions.size(), 1800u);
  EXPECT_GE(mesh.tetrahedra.size(), 6500u);
  EXPECT_LE(mesh.tetrahedra.size(), 8000u);

  // the boundary is the shape's, and closed without a handle
  const Surface surface = geometry::extract_surface(mesh, {});
  const auto edges = 3 * static_cast<int>(surface.triangles.size()) / 2;
  EXPECT_EQ(surface.node_count() - edges + static_cast<int>(surface.triangles.size()), 2);
  constexpr double kOnSurface = 2e-4;  // m: the mesher finds the surface to 1e-3 of the shape's radius
  for (const Vec3& p : geometry::surface_positions(mesh, surface))
    EXPECT_LT(std::abs(liver_distance(p)), kOnSurface);
}

TEST_F(OrganPhantom, WrongArgumentsEndWithTwoAndOneLine) {
  for (const auto& arguments :
       std::vector<std::vector<std::string>>{{},
                                             {"--size", "huge", "-o", (folder_ / "x.msh").string()},
                                             {"-o", (folder_ / "nowhere/x.msh").string()}}) {
    test::Process process("organ_phantom", arguments);
    EXPECT_EQ(process.wait(), 2);
    const std::string messages = process.messages();
    EXPECT_THAT(messages, testing::StartsWith("organ_phantom: "));
    EXPECT_EQ(std::count(messages.begin(), messages.end(), '\n'), 1);
  }
  EXPECT_TRUE(std::filesystem::is_empty(folder_.path()));
}

TEST_F(OrganPhantom, AFileThatCannotBeWrittenIsRefusedWithTheReasonAndNothingIsMade) {
  const std::string mesh = folder_ / "x.msh", nowhere = folder_ / "nowhere/x";
  for (const auto& [arguments, reason] : std::vector<std::pair<std::vector<std::string>, std::string>>{
           {{"-o", nowhere}, nowhere + ": cannot be written: No such file or directory"},
           {{"-o", mesh, "--labels", nowhere}, nowhere + ": cannot be written: No such file or directory"},
           {{"-o", folder_.path()}, "it is a folder, expected a file or a new name"},
           {{"-o", "/dev/null"}, "it is a device"}}) {
    test::Process process("organ_phantom", arguments);
    EXPECT_EQ(process.wait(), 2);
    EXPECT_THAT(process.messages(), testing::HasSubstr(reason));
    EXPECT_EQ(process.output(), "");
    EXPECT_TRUE(std::filesystem::is_empty(folder_.path()));
  }
}

TEST(LabelVolume, AFullDiskIsTheReason) {
  try {
    write_nifti(sample_liver(2e-2), "/dev/full");
    ADD_FAILURE() << "no exception";
  } catch (const geometry::InputError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("/dev/full: cannot be written: No space left on device"));
  }
}

}  // namespace
}  // namespace omentum::phantom
