#include "geometry/gut_anatomy.h"
#include "geometry/surface.h"
#include "organ_tools/phantom/colon_shape.h"
#include "organ_tools/phantom/liver_shape.h"
#include "scene/scene.h"
#include "tests/support/process.h"

#include <gmock/gmock.h>

#include <cmath>

namespace omentum::phantom {
namespace {

scene::Scene abdomen() {
  return scene::load_scene(std::filesystem::path(OMENTUM_SOURCE_DIR) / "scenes" / "abdomen.toml");
}

geometry::GutShape gut_of(const scene::Scene& scene) {
  for (const scene::OrganSpec& organ : scene.organs)
    if (organ.intestine) return geometry::make_gut(organ.intestine->anatomy);
  throw std::runtime_error("the abdomen has no intestine");
}

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
  for_points_of(gut_of(abdomen()), [&](const Vec3& p, double reach) {
    to_colon = std::min(to_colon, colon_distance(p) - reach);
    liver_to_gut = std::min(liver_to_gut, liver_distance(p) - reach);
  });
  EXPECT_GT(to_colon, 0.002);
  EXPECT_GT(liver_to_gut, 0.01);
  for (const Vec3& p : colon_axis()) EXPECT_GT(liver_distance(p), 0.05);
}

// The plane stands for what lies behind the gut, the colon's front among it; the ellipsoid is the wall.
TEST(ColonShape, GutAndColonLieInsideTheCavity) {
  const scene::Scene scene = abdomen();
  const auto take = [&](const Vec3& p, double reach, std::string_view shape) {
    for (const scene::ObstacleSpec& obstacle : scene.obstacles) {
      if (obstacle.shape != shape) continue;
      const Vec3 from = p - obstacle.centre;
      if (shape == "plane") {
        ASSERT_GT(from.dot(obstacle.normal), reach) << p.transpose();
      } else {
        const Vec3 outward = from.cwiseQuotient(obstacle.half_axes_m.cwiseAbs2()).normalized();
        ASSERT_LT((from + reach * outward).cwiseQuotient(obstacle.half_axes_m).norm(), 1) << p.transpose();
      }
    }
  };
  for_points_of(gut_of(scene), [&](const Vec3& p, double reach) {
    take(p, reach, "plane");
    take(p, reach, "ellipsoid");
  });
  for (const Vec3& p : colon_axis()) take(p, -colon_distance(p), "ellipsoid");
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
