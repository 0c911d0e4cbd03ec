// How deep a dent is: what a tool adds to the movement of the whole organ.
#include "render_node/dent.h"

#include "ball_organ.h"

#include <gtest/gtest.h>

namespace omentum::render {
namespace {

constexpr double kBallRadius = 0.09;  // the size of a liver
constexpr double kFloat_m = 1e-6;
const geometry::SurfaceId kTopNode(4);

struct Ball90 {
  OrganShape shape = test::ball_organ(kBallRadius, 4);
  OrganSkin skin{shape.surface, shape.rest};

  double dent(std::vector<float> displacements) {
    skin.deform(displacements);
    const PressedNode pressed[] = {{kTopNode, 1.5f}};
    const auto dent = measure_dent(skin, pressed);
    return dent ? dent->depth_m : -1;
  }
  std::vector<float> pressed(double depth_m) const { return test::dent(shape, shape.rest[4], depth_m, 0.01); }
};

TEST(Dent, IsAsDeepAsTheSurfaceIsPressed) {
  Ball90 ball;
  EXPECT_NEAR(ball.dent(ball.pressed(0.007)), 0.007, kFloat_m);
}

TEST(Dent, MovementOfTheWholeOrganDoesNotCount) {
  Ball90 ball;
  std::vector<float> all = ball.pressed(0.007);
  for (std::size_t i = 0; i < all.size(); i += 3) all[i + 2] -= 0.02f;  // sinks by 20 mm
  EXPECT_NEAR(ball.dent(all), 0.007, kFloat_m);
  EXPECT_NEAR(ball.skin.largest_displacement_m(), 0.027, kFloat_m);
}

TEST(Dent, TiltOfTheOrganDoesNotCount) {
  Ball90 ball;
  std::vector<float> all = ball.pressed(0.007);
  for (std::size_t s = 0; s < ball.shape.rest.size(); ++s)
    all[3 * s + 2] += static_cast<float>(0.2 * ball.shape.rest[s].x());
  EXPECT_NEAR(ball.dent(all), 0.007, 1e-4) << "a ring of nodes is not perfectly even";
}

TEST(Dent, FarSideOfTheOrganIsNotItsSurroundings) {
  // a slab of 2 cm: its lower face lies within the ring's distance
  OrganShape thin = test::ball_organ(kBallRadius, 4);
  for (Vec3& p : thin.rest) p.z() *= 0.1;
  OrganSkin skin(thin.surface, thin.rest);
  std::vector<float> u = test::dent(thin, thin.rest[4], 0.006, 0.01);
  for (std::size_t s = 0; s < thin.rest.size(); ++s)
    if (thin.rest[s].z() < 0) u[3 * s + 2] = -0.05f;
  skin.deform(u);
  const PressedNode pressed[] = {{kTopNode, 1}};
  EXPECT_NEAR(measure_dent(skin, pressed)->depth_m, 0.006, 1e-4);
}

TEST(Dent, IsWhereTheForceIs) {
  Ball90 ball;
  ball.skin.deform(ball.pressed(0.007));
  const PressedNode pressed[] = {{kTopNode, 1}, {geometry::SurfaceId(0), 0}};
  EXPECT_LT((measure_dent(ball.skin, pressed)->bottom - ball.skin.position(kTopNode)).norm(), kFloat_m);
}

TEST(Dent, NeitherWithoutForceNorOutwards) {
  Ball90 ball;
  EXPECT_FALSE(measure_dent(ball.skin, {}));
  const PressedNode idle[] = {{kTopNode, 0}};
  EXPECT_FALSE(measure_dent(ball.skin, idle));
  EXPECT_EQ(ball.dent(ball.pressed(-0.003)), 0) << "a bulge is no dent";
}

}  // namespace
}  // namespace omentum::render
