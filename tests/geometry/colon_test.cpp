#include "geometry/gut_anatomy.h"
#include "geometry/surface.h"
#include "organ_tools/phantom/colon_shape.h"
#include "organ_tools/phantom/liver_shape.h"
#include "tests/support/process.h"

#include <gmock/gmock.h>

#include <cmath>

namespace omentum::phantom {
namespace {

// Of scenes/abdomen.toml.
geometry::GutAnatomy gut_of_the_abdomen() {
  geometry::GutAnatomy anatomy;
  anatomy.legs = 7;
  anatomy.origin = {0, -0.265, -0.075};
  return anatomy;
}
const Vec3 kCavityCentre(0, -0.265, -0.055), kCavityHalfAxes(0.25, 0.26, 0.26);  // an ellipsoid's
constexpr double kBackWall = -0.21;                                              // z of the plane below it

// Places inside a triangle, its corners among them.
template <class Use>
void for_points_of(const std::array<Vec3, 3>& corners, Use&& use) {
  constexpr int kSteps = 6;
  for (int i = 0; i <= kSteps; ++i)
    for (int j = 0; i + j <= kSteps; ++j)
      use((i * corners[0] + j * corners[1] + (kSteps - i - j) * corners[2]) / kSteps);
}

// use(point, what the gut reaches around it in m), over axis and mesentery.
template <class Use>
void for_points_of(const geometry::GutShape& gut, Use&& use) {
  const auto at = [&gut](geometry::MassId m) { return gut.positions[static_cast<std::size_t>(m)]; };
  for (std::int32_t i = 0; i < gut.layout.segment_count(); ++i) {
    const auto [a, b] = gut.layout.segment(i);
    for_points_of({at(a), at(b), at(b)}, [&](const Vec3& p) { use(p, gut.tube_radius_m); });
  }
  for (std::int32_t t = 0; t < gut.layout.triangle_count(); ++t) {
    const auto [a, b, c] = gut.layout.triangle(t);
    for_points_of({at(a), at(b), at(c)}, [&](const Vec3& p) { use(p, gut.mesentery_thickness_m / 2); });
  }
}

TEST(ColonShape, IsATubeOfSomeFiveCentimetresInsideItsExtent) {
  const std::vector<Vec3>& axis = colon_axis();
  const Extent extent = colon().extent;
  double length = 0;
  for (std::size_t i = 0; i + 1 < axis.size(); ++i) {
    const Vec3 along = (axis[i + 1] - axis[i]).normalized();
    length += (axis[i + 1] - axis[i]).norm();
    for (const Vec3& side : {Vec3(Vec3::UnitZ()), Vec3(-Vec3::UnitZ()), Vec3(along.cross(Vec3::UnitZ()))}) {
      const double radius = -colon_distance(axis[i]);
      EXPECT_GT(radius, 0.020);
      EXPECT_LT(radius, 0.030);
      const Vec3 skin = axis[i] + radius * side;
      EXPECT_TRUE((skin.array() > extent.low.array() + 2e-3).all()) << skin.transpose();
      EXPECT_TRUE((skin.array() < extent.high.array() - 2e-3).all()) << skin.transpose();
    }
  }
  EXPECT_NEAR(length, 0.84, 0.02);
}

TEST(ColonShape, LiesBehindTheGutAndClearOfTheLiver) {
  double to_colon = 1, liver_to_gut = 1;
  for_points_of(geometry::make_gut(gut_of_the_abdomen()), [&](const Vec3& p, double reach) {
    to_colon = std::min(to_colon, colon_distance(p) - reach);
    liver_to_gut = std::min(liver_to_gut, liver_distance(p) - reach);
  });
  EXPECT_GT(to_colon, 0.002);
  EXPECT_GT(liver_to_gut, 0.01);
  for (const Vec3& p : colon_axis()) EXPECT_GT(liver_distance(p), 0.05);
}

TEST(ColonShape, GutAndColonLieInsideTheCavity) {
  double level = 0, lowest = 1;
  const auto take = [&](const Vec3& p, double reach) {
    const Vec3 outward = (p - kCavityCentre).cwiseQuotient(kCavityHalfAxes.cwiseAbs2()).normalized();
    level = std::max(level, (p + reach * outward - kCavityCentre).cwiseQuotient(kCavityHalfAxes).norm());
    lowest = std::min(lowest, p.z() - reach);
  };
  for_points_of(geometry::make_gut(gut_of_the_abdomen()), take);
  EXPECT_GT(lowest, kBackWall + 0.04);
  for (const Vec3& p : colon_axis()) take(p, -colon_distance(p));
  EXPECT_GT(lowest, kBackWall);
  EXPECT_LT(level, 1);
}

TEST(ColonShape, ItsMeshIsOneValidTube) {
  if (!std::filesystem::exists(std::filesystem::path(OMENTUM_BIN_DIR) / "organ_phantom"))
    GTEST_SKIP() << "organ_phantom is not built here (it needs CGAL and no sanitizer)";
  const test::ScratchFolder folder;
  const std::string file = folder / "colon.msh";
  ASSERT_EQ(test::Process("organ_phantom", {"--part", "colon", "-o", file}).wait(), 0);
  const geometry::CheckedMesh colon = geometry::check_mesh(geometry::read_mesh(file), 1.0);
  EXPECT_TRUE(colon.warnings.empty());
  EXPECT_GE(colon.mesh.positions.size(), 1400u);
  EXPECT_LE(colon.mesh.positions.size(), 1900u);
  const geometry::Surface skin = geometry::extract_surface(colon.mesh, {});
  const auto edges = 3 * static_cast<int>(skin.triangles.size()) / 2;
  EXPECT_EQ(skin.node_count() - edges + static_cast<int>(skin.triangles.size()), 2) << "no loop is closed";
  constexpr double kOnSurface = 4e-3;  // m: taking slivers away lays single inner nodes bare
  for (const Vec3& p : geometry::surface_positions(colon.mesh, skin))
    EXPECT_LT(std::abs(colon_distance(p)), kOnSurface);
}

}  // namespace
}  // namespace omentum::phantom
