// From where a dent is looked at: a side from which it is seen.
#include "render_node/close_up.h"

#include "ball_organ.h"
#include "geometry/closest_points.h"

#include <gtest/gtest.h>

#include <numbers>

namespace omentum::render {
namespace {

constexpr double kRadius = 0.05;
constexpr double kDepth_m = 0.006;
constexpr double kGround_m = -0.06;
const Vec3 kTop(0, 0, kRadius);
const Camera kFamiliar{Vec3(0, -0.4, 0.3), Vec3::Zero()};

/// A wall of two triangles, which stands on the ball `off_m` from its top and is higher than wide sights are:
/// all its nodes lie beside whoever looks across it.
void add_wall(OrganShape& shape, double azimuth, double off_m, double height_m, double half_width_m) {
  const Vec3 out(std::cos(azimuth), std::sin(azimuth), 0), along(-out.y(), out.x(), 0);
  const Vec3 foot = kTop + off_m * out;
  std::array<geometry::SurfaceId, 4> corner;
  for (int i = 0; i < 4; ++i) {
    corner[i] = geometry::SurfaceId(static_cast<std::int32_t>(shape.rest.size()));
    shape.rest.push_back(foot + (i % 2 ? 1 : -1) * half_width_m * along +
                         Vec3(0, 0, i / 2 ? height_m : -kRadius));
    shape.surface.node.push_back(geometry::NodeId(static_cast<std::int32_t>(shape.rest.size())));
  }
  shape.surface.mobile_count = static_cast<std::int32_t>(shape.rest.size());
  shape.surface.triangles.push_back({corner[0], corner[1], corner[2]});
  shape.surface.triangles.push_back({corner[1], corner[3], corner[2]});
}

struct Stage {
  explicit Stage(const OrganShape& shape) : skin(shape.surface, shape.rest) {
    skin.deform(test::dent(shape, kTop, kDepth_m, 0.006));
    dent = {kDepth_m, (kTop - Vec3(0, 0, kDepth_m)).cast<float>(), Vec3f::UnitZ()};
  }
  Camera camera(const Camera& familiar = kFamiliar, std::span<const Shaft> shafts = {}) const {
    const MeshData* const organs[] = {&skin.mesh()};
    return close_up_of(dent, organs, shafts, familiar, kGround_m);
  }
  OrganSkin skin;
  Dent dent;
};

bool seen(const OrganSkin& skin, const Vec3& point, const Vec3& eye) {
  for (const MeshTriangle& t : skin.mesh().triangles) {
    const auto corner = [&](int i) -> Vec3 { return skin.mesh().vertices[t[i]].position.cast<double>(); };
    if (geometry::intersect_segment_triangle(point, eye, corner(0), corner(1), corner(2))) return false;
  }
  return true;
}

void expect_seen(const Stage& stage) {
  const Camera camera = stage.camera();
  EXPECT_TRUE(seen(stage.skin, camera.target, camera.eye)) << "the eye is at " << camera.eye.transpose();
}

TEST(CloseUp, LooksFromTheFamiliarSideWhereNothingIsInTheWay) {
  const Camera camera = Stage(test::ball_organ(kRadius, 4)).camera();
  EXPECT_GT((camera.eye - camera.target).normalized().dot(-Vec3::UnitY()), 0.85);
}

TEST(CloseUp, LooksPastTissueWhoseNodesLieBesideTheSight) {
  constexpr int kPlaces = 16;
  for (int k = 0; k < kPlaces; ++k) {
    OrganShape shape = test::ball_organ(kRadius, 4);
    add_wall(shape, 2 * std::numbers::pi * k / kPlaces, 0.03, 0.05, 0.04);
    SCOPED_TRACE(k);
    expect_seen(Stage(shape));
  }
}

TEST(CloseUp, LooksIntoAWellFromAbove) {
  constexpr int kWalls = 6;
  OrganShape shape = test::ball_organ(kRadius, 4);
  for (int k = 0; k < kWalls; ++k) add_wall(shape, 2 * std::numbers::pi * k / kWalls, 0.025, 0.02, 0.02);
  expect_seen(Stage(shape));
}

// The tip of the other hand's tool lies beside the sight, and its handle crosses it.
TEST(CloseUp, LooksPastAnotherToolsHandle) {
  const Stage stage(test::ball_organ(kRadius, 4));
  const Vec3 sight = (stage.camera().eye - kTop).normalized();
  const Shaft other{kTop + 0.05 * sight - 0.04 * Vec3::UnitX(), Vec3::UnitX()};
  const Camera camera = stage.camera(kFamiliar, {&other, 1});
  constexpr double kClear_m = 0.005;
  for (double share = 0; share <= 1; share += 0.01) {
    const Vec3 p = camera.target + share * (camera.eye - camera.target) - other.tip;
    const double on_shaft = std::max(0.0, p.dot(other.towards_handle));
    EXPECT_GT((p - on_shaft * other.towards_handle).norm(), kClear_m) << share;
  }
}

TEST(CloseUp, IsAboveTheTableWhenTheOrgansSideIsPressed) {
  Stage stage(test::ball_organ(kRadius, 4));
  stage.dent = {0, Vec3f(0, -static_cast<float>(kRadius), 0), -Vec3f::UnitY()};
  const Camera low{Vec3(0, -0.4, -0.01),
                   Vec3::Zero()};  // sees the side from straight ahead and slightly below
  EXPECT_GT(stage.camera(low).eye.z(), kGround_m);
}

}  // namespace
}  // namespace omentum::render
