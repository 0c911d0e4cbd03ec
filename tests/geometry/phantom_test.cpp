#include "geometry/closest_points.h"
#include "geometry/surface.h"
#include "organ_tools/phantom/gallbladder_shape.h"
#include "organ_tools/phantom/label_volume.h"
#include "organ_tools/phantom/liver_shape.h"
#include "organ_tools/phantom/tissue_samples.h"
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
  const LabelVolume volume = sample(liver(), kVoxel);
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
  const LabelVolume volume = sample(liver(), 3e-3);
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

// Of all points of a grid inside the gallbladder.
template <class Use>
void for_points_inside_gallbladder(double spacing_m, Use&& use) {
  const Extent extent = gallbladder().extent;
  for (double x = extent.low.x(); x < extent.high.x(); x += spacing_m) {
    for (double y = extent.low.y(); y < extent.high.y(); y += spacing_m) {
      for (double z = extent.low.z(); z < extent.high.z(); z += spacing_m) {
        if (const Vec3 p(x, y, z); gallbladder_distance(p) < 0) use(p);
      }
    }
  }
}

TEST(GallbladderShape, IsAPearOfEightByThreeAndAHalfCentimetresInsideItsExtent) {
  Vec3 low = Vec3::Constant(1), high = Vec3::Constant(-1);
  for_points_inside_gallbladder(1e-3, [&](const Vec3& p) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  });
  const Extent extent = gallbladder().extent;
  EXPECT_NEAR(high.y() - low.y(), 0.08, 0.005);
  EXPECT_NEAR(high.x() - low.x(), 0.035, 0.003);
  EXPECT_TRUE((low.array() > extent.low.array() + 1e-3).all()) << low.transpose();
  EXPECT_TRUE((high.array() < extent.high.array() - 1e-3).all()) << high.transpose();
  const auto width = [](double y) {
    int inside = 0;
    for (double x = -0.04; x < 0.02; x += 1e-3) inside += gallbladder_distance({x, y, -0.03}) < 0;
    return inside * 1e-3;
  };
  EXPECT_LT(width(-0.01), 0.7 * width(-0.055)) << "the neck is thinner than the fundus";
}

TEST(GallbladderShape, LiesFreeBelowTheLiverWithItsFundusInFrontOfTheEdge) {
  double gap_m = 1;
  for_points_inside_gallbladder(1e-3, [&](const Vec3& p) { gap_m = std::min(gap_m, liver_distance(p)); });
  EXPECT_GT(gap_m, 2.5e-3);
  EXPECT_LT(gap_m, 5e-3) << "it belongs to the liver";
  // a straight shaft from above and in front meets the fundus and no liver
  const Vec3 towards_hand = Vec3(0.2, -0.56, 0.8).normalized();
  for (double way = 0; way < 0.2; way += 1e-3)
    EXPECT_GT(liver_distance(Vec3(-0.010, -0.068, -0.012) + way * towards_hand), 0.01) << way;
}

TEST(LabelVolume, NiftiFileHoldsHeaderAndLabelsInMillimetres) {
  const test::ScratchFolder folder;
  const LabelVolume volume = sample(liver(), 6e-3);
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
  EXPECT_EQ(file.substr(148, 22), std::string("Omentum phantom liver\0", 22));
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

double distance_between(const std::vector<Vec3>& points, const Surface& surface, const std::vector<Vec3>& x) {
  double least = 1;
  for (const Vec3& p : points) {
    for (const Triangle& t : surface.triangles) {
      const double squared =
          geometry::closest_point_on_triangle(p, x[t[0]], x[t[1]], x[t[2]]).squared_distance;
      least = std::min(least, std::sqrt(squared));
    }
  }
  return least;
}

TEST_F(OrganPhantom, TheGallbladdersMeshIsValidAndKeepsItsGapToTheLivers) {
  const std::string liver_file = folder_ / "liver.msh", sac_file = folder_ / "sac.msh";
  ASSERT_EQ(test::Process("organ_phantom", {"-o", liver_file}).wait(), 0);
  ASSERT_EQ(test::Process("organ_phantom", {"--part", "gallbladder", "-o", sac_file}).wait(), 0);
  const geometry::CheckedMesh sac = geometry::check_mesh(geometry::read_mesh(sac_file), 1.0);
  EXPECT_TRUE(sac.warnings.empty());
  const Surface skin = geometry::extract_surface(sac.mesh, {});
  EXPECT_GE(skin.node_count(), 300);
  EXPECT_LE(skin.node_count(), 1000);
  const auto edges = 3 * static_cast<int>(skin.triangles.size()) / 2;
  EXPECT_EQ(skin.node_count() - edges + static_cast<int>(skin.triangles.size()), 2) << "one closed sac";

  const TetraMesh liver_mesh = geometry::check_mesh(geometry::read_mesh(liver_file), 1.0).mesh;
  const Surface liver_skin = geometry::extract_surface(liver_mesh, {});
  const auto x = geometry::surface_positions(sac.mesh, skin);
  const auto liver_x = geometry::surface_positions(liver_mesh, liver_skin);
  EXPECT_GT(distance_between(x, liver_skin, liver_x), 2e-3);
  EXPECT_GT(distance_between(liver_x, skin, x), 2e-3);
  for (const Vec3& p : liver_x) EXPECT_GT(gallbladder_distance(p), 2e-3) << "no part of the liver is inside";
}

TEST(TissueSamples, AreAPlateAndACylinderOfTheirSizesWithRoundedEdges) {
  EXPECT_NEAR(plate_distance({0, 0, 0.005}), 0, 1e-12);
  EXPECT_NEAR(plate_distance({0.1, 0, 0}), 0, 1e-12);
  EXPECT_GT(plate_distance({0.1, 0.1, 0}), 0) << "rounded";
  EXPECT_NEAR(plate_distance({0.13, 0, 0}), 0.03, 1e-12);
  EXPECT_NEAR(cylinder_distance({0.03, 0, -0.06}), 0, 1e-12);
  EXPECT_NEAR(cylinder_distance({0, 0, -0.12}), 0, 1e-12);
  EXPECT_NEAR(cylinder_distance({0, 0, -0.06}), -0.03, 1e-12);
  EXPECT_GT(cylinder_distance({0.03, 0, 0}), 0) << "rounded";
}

// Cotin 1998, figures 2 and 3.
TEST_F(OrganPhantom, ThePlateAndTheCylinderHaveThePapersSizes) {
  const struct {
    const char* part;
    std::size_t nodes, tetrahedra;
  } samples[] = {{"plate", 759, 2212}, {"cylinder", 248, 889}};
  for (const auto& [part, nodes, tetrahedra] : samples) {
    const std::string file = folder_ / (std::string(part) + ".msh");
    ASSERT_EQ(test::Process("organ_phantom", {"--part", part, "-o", file}).wait(), 0);
    const geometry::CheckedMesh checked = geometry::check_mesh(geometry::read_mesh(file), 1.0);
    EXPECT_TRUE(checked.warnings.empty());
    EXPECT_NEAR(checked.mesh.positions.size() / static_cast<double>(nodes), 1, 0.1);
    EXPECT_NEAR(checked.mesh.tetrahedra.size() / static_cast<double>(tetrahedra), 1, 0.12);
  }
}

TEST_F(OrganPhantom, WrongArgumentsEndWithTwoAndOneLine) {
  for (const auto& arguments : std::vector<std::vector<std::string>>{
           {},
           {"--size", "huge", "-o", (folder_ / "x.msh").string()},
           {"--part", "spleen", "-o", (folder_ / "x.msh").string()},
           {"--part", "gallbladder", "--size", "fine", "-o", (folder_ / "x.msh").string()},
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
    write_nifti(sample(liver(), 2e-2), "/dev/full");
    ADD_FAILURE() << "no exception";
  } catch (const geometry::InputError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("/dev/full: cannot be written: No space left on device"));
  }
}

}  // namespace
}  // namespace omentum::phantom
