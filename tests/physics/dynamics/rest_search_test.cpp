#include "physics/dynamics/rest_search.h"

#include "physics/dynamics/corotational.h"
#include "physics/dynamics/spring_mesh.h"
#include "physics/dynamics/tensor_mass.h"
#include "tests/physics/dynamics/force_law_properties.h"
#include "tests/physics/dynamics/kept_factor_fixtures.h"

namespace omentum::physics {
namespace {

using test::HeldBody;
using test::Values;

KeptFactor kept_for_rest(const HeldBody& body) {
  return {body.mesh, test::kTissue, body.inertia.fixed, body.inertia.mass, {1, 1}};
}

Values weight_of(const HeldBody& body, double gravity) {
  Values f(body.components());
  for (std::size_t n = 0; n < body.inertia.mass.size(); ++n) f[3 * n + 1] = gravity * body.inertia.mass[n];
  return f;
}

// The largest free component of what is not balanced, as a part of the weight's.
double imbalance(const HeldBody& body, ForceLaw& law, const Values& u, const Values& weight) {
  const Values f = test::forces_of(law, u);
  double off = 0, size = 0;
  for (std::size_t c = 0; c < f.size(); ++c) {
    size = std::max(size, std::abs(weight[c]));
    if (!body.held(c)) off = std::max(off, std::abs(f[c] + weight[c]));
  }
  return off / size;
}

void expect_rest(const HeldBody& body, ForceLaw& law, double gravity) {
  KeptFactor factor = kept_for_rest(body);
  const Values weight = weight_of(body, gravity);
  Values u(body.components());
  ASSERT_TRUE(search_rest(law, factor, weight, u));
  EXPECT_LE(imbalance(body, law, u, weight), 1e-5);
  EXPECT_LT(law.energy(u) - test::dot(weight, u), 0);
}

TEST(RestSearchTest, EveryLawRestsUnderItsWeight) {
  const HeldBody body = test::held_box();
  TensorMass linear(body.mesh, test::kTissue, TensorMass::Arithmetic::kDouble);
  Corotational turning(body.mesh, test::kTissue);
  SpringMesh springs(body.mesh, test::kTissue);
  expect_rest(body, linear, -9.81);
  expect_rest(body, turning, -9.81);
  expect_rest(body, springs, -9.81);
}

TEST(RestSearchTest, ABodyThatTurnsFarAndWasCutRests) {
  const HeldBody body = test::held_box();
  Corotational law(body.mesh, test::kTissue);
  KeptFactor factor = kept_for_rest(body);
  const std::vector<geometry::TetId> order = body.any_order();
  ASSERT_TRUE(factor.remove({order.data(), 3}));
  for (int i = 0; i < 3; ++i) law.remove(order[i]);
  const Values weight = weight_of(body, -40);
  Values u(body.components());
  ASSERT_TRUE(search_rest(law, factor, weight, u));
  EXPECT_LE(imbalance(body, law, u, weight), 1e-5);
}

TEST(RestSearchTest, WhatHeldComponentsAreGivenTheyKeep) {
  const HeldBody body = test::held_box();
  Corotational law(body.mesh, test::kTissue);
  KeptFactor factor = kept_for_rest(body);
  Values u(body.components());
  for (std::size_t c = 0; c < u.size(); ++c) u[c] = body.held(c) ? 1e-3 : 0;
  ASSERT_TRUE(search_rest(law, factor, Values(u.size()), u));
  for (std::size_t c = 0; c < u.size(); ++c) {
    if (body.held(c)) {
      EXPECT_EQ(u[c], 1e-3) << c;
    }
  }
}

TEST(RestSearchTest, ALoadBeyondAllNumbersHasNoRest) {
  const HeldBody body = test::held_box();
  Corotational law(body.mesh, test::kTissue);
  KeptFactor factor = kept_for_rest(body);
  Values u(body.components());
  EXPECT_FALSE(search_rest(law, factor, Values(u.size(), std::numeric_limits<double>::infinity()), u));
}

}  // namespace
}  // namespace omentum::physics
