#include "physics/intestine/gut_forces.h"

#include "tests/physics/intestine/gut_shapes.h"

#include <gtest/gtest.h>

namespace omentum::physics {
namespace {

using geometry::GutLayout;
using geometry::GutShape;
using geometry::Vec3;
using Points = std::vector<Vec3>;

// Two rows, more than four, and more springs than the loops take at once.
const std::vector<GutLayout> kLayouts{{2, 9}, {4, 100}, {5, 300}, {4, 4}};

constexpr double kRounding = 1e-12;  // of the largest force: sums in another order

double largest(const Points& f) {
  double most = 0;
  for (const Vec3& p : f) most = std::max(most, p.norm());
  return most;
}

void expect_alike(const Points& f, const Points& reference, const GutLayout& layout) {
  for (std::size_t i = 0; i < f.size(); ++i) {
    if (layout.is_held(geometry::MassId(i))) continue;  // a spring between two of them may be left out
    EXPECT_LT((f[i] - reference[i]).norm(), kRounding * largest(reference)) << "mass " << i;
  }
}

TEST(GutForces, ExplicitOnesAreThoseOfTheSprings) {
  for (const GutLayout& layout : kLayouts) {
    const GutShape shape = test::curtain(layout);
    const GutSprings springs(shape, {});
    const Points x = test::shaken(shape, 0.01), v = test::deviates(layout, 0.3, 2);
    GutPlanes at(x.size()), rate(x.size()), f(x.size());
    at.take(x);
    rate.take(v);
    GutForces forces(springs);
    forces.add_explicit(at, rate, f);
    Points found(x.size()), expected(x.size());
    f.give(found);
    springs.forces(x, v, expected);
    expect_alike(found, expected, layout);
  }
}

TEST(GutForces, ImplicitOnesWithoutDampingAreThoseOfTheSpringsAtRest) {
  for (const GutLayout& layout : kLayouts) {
    const GutShape shape = test::curtain(layout);
    const GutSprings springs(shape, {.spring_damping_s = 0});
    const Points x = test::shaken(shape, 0.01);
    GutPlanes at(x.size()), f(x.size());
    at.take(x);
    GutForces forces(springs);
    forces.begin_step(5e-3);
    forces.add_implicit(at, f);
    Points found(x.size()), expected(x.size());
    f.give(found);
    springs.forces(x, Points(x.size(), Vec3::Zero()), expected);
    expect_alike(found, expected, layout);
  }
}

// Along a spring the way of a small step is its velocity times the step.
TEST(GutForces, ImplicitDampingTendsToThatOfTheSprings) {
  constexpr double kStep_s = 1e-7;
  const GutShape shape = test::curtain({4, 30});
  const GutSprings springs(shape, {});
  const Points x = test::shaken(shape, 0.01), v = test::deviates(shape.layout, 0.3, 2);
  Points before = x;
  for (std::size_t i = 0; i < x.size(); ++i) before[i] -= kStep_s * v[i];
  GutPlanes at(x.size()), f(x.size());
  GutForces forces(springs);
  at.take(before);
  forces.measure(at);
  forces.begin_step(kStep_s);
  at.take(x);
  forces.add_implicit(at, f);
  Points found(x.size()), expected(x.size());
  f.give(found);
  springs.forces(x, v, expected);
  for (std::size_t i = 0; i < x.size(); ++i) {
    EXPECT_LT((found[i] - expected[i]).norm(), 1e-4 * largest(expected)) << "mass " << i;
  }
}

TEST(GutForces, MeasuresTheEnergyOfTheSprings) {
  for (const GutLayout& layout : kLayouts) {
    const GutShape shape = test::curtain(layout);
    const GutSprings springs(shape, {});
    const Points x = test::shaken(shape, 0.01);
    GutPlanes at(x.size());
    at.take(x);
    EXPECT_NEAR(GutForces(springs).measure(at), springs.energy(x), 1e-12 * springs.energy(x));
  }
}

}  // namespace
}  // namespace omentum::physics
