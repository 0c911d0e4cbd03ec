#include "physics/intestine/gut_springs.h"

#include "tests/physics/intestine/gut_shapes.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace omentum::physics {
namespace {

using geometry::GutLayout;
using geometry::GutShape;
using geometry::MassId;
using geometry::Vec3;
using Points = std::vector<Vec3>;

Points forces(const GutSprings& springs, const Points& x, const Points& v) {
  Points f(x.size());
  springs.forces(x, v, f);
  return f;
}

Points still(const Points& x) {
  return Points(x.size(), Vec3::Zero());
}

Points any_velocity(const GutShape& shape) {
  return test::deviates(shape.layout, 0.3, 7);
}

TEST(GutSprings, RestHasNeitherForceNorEnergy) {
  const GutShape shape = test::curtain({});
  const GutSprings springs(shape, {});
  EXPECT_LT(springs.energy(shape.positions), 1e-25);
  for (const Vec3& f : forces(springs, shape.positions, still(shape.positions))) EXPECT_LT(f.norm(), 1e-12);
}

TEST(GutSprings, ForceIsMinusTheGradientOfEnergy) {
  const GutShape shape = test::curtain({4, 20});
  const GutSprings springs(shape, {});
  const Points x = test::shaken(shape, 0.01);
  const Points f = forces(springs, x, still(x));
  constexpr double kStep_m = 1e-6;
  for (std::size_t i = 0; i < x.size(); ++i) {
    for (int k = 0; k < 3; ++k) {
      Points ahead = x, behind = x;
      ahead[i][k] += kStep_m;
      behind[i][k] -= kStep_m;
      const double slope = (springs.energy(ahead) - springs.energy(behind)) / (2 * kStep_m);
      EXPECT_NEAR(f[i][k], -slope, 1e-5 * (1 + std::abs(slope))) << "mass " << i;
    }
  }
}

TEST(GutSprings, InternalForcesKeepMomentumAndAngularMomentum) {
  const GutShape shape = test::curtain({});
  const Points x = test::shaken(shape, 0.01);
  Vec3 sum = Vec3::Zero(), torque = Vec3::Zero();
  double size = 0;
  const Points f = forces(GutSprings(shape, {}), x, any_velocity(shape));
  for (std::size_t i = 0; i < x.size(); ++i) {
    sum += f[i];
    torque += x[i].cross(f[i]);
    size += f[i].norm();
  }
  EXPECT_LT(sum.norm(), 1e-13 * size);
  EXPECT_LT(torque.norm(), 1e-13 * size);
}

TEST(GutSprings, DampingOnlyTakesEnergy) {
  const GutShape shape = test::curtain({});
  const GutSprings springs(shape, {});
  const Points x = test::shaken(shape, 0.01), v = any_velocity(shape);
  const Points elastic = forces(springs, x, still(x)), all = forces(springs, x, v);
  double power = 0;
  for (std::size_t i = 0; i < x.size(); ++i) power += (all[i] - elastic[i]).dot(v[i]);
  EXPECT_LT(power, 0);
}

TEST(GutSprings, AMotionOfTheWholeGutIsNotDamped) {
  const GutShape shape = test::curtain({});
  const GutSprings springs(shape, {});
  Points v;
  for (const Vec3& x : shape.positions) v.push_back(Vec3(1, 2, 3) + Vec3(3, -1, 2).cross(x));
  for (const Vec3& f : forces(springs, shape.positions, v)) EXPECT_LT(f.norm(), 1e-9);
}

double total_mass(const GutSprings& springs) {
  double sum = 0;
  for (const double m : springs.mass()) sum += m;
  return sum;
}

TEST(GutSprings, MassDoesNotDependOnTheResolution) {
  const GutSprings coarse(test::curtain({4, 100}), {}), fine(test::curtain({4, 1000}), {});
  EXPECT_NEAR(total_mass(coarse), total_mass(fine), 0.03 * total_mass(fine));
}

// What a uniform strain of a flat strip stores, per area: the membrane's Y strain^2 / 2.
class FlatStrip {
 public:
  FlatStrip(GutLayout layout, double length_m, double width_m) : shape_{layout, {}, 0.02, 0.001} {
    shape_.positions.resize(static_cast<std::size_t>(layout.mass_count()));
    for (std::int32_t m = 0; m < layout.mass_count(); ++m) {
      shape_.positions[static_cast<std::size_t>(m)] =
          Vec3(length_m * layout.column(MassId(m)) / (layout.columns - 1),
               width_m * layout.row(MassId(m)) / (layout.rows - 1), 0);
    }
  }
  // between the outermost cells, whose springs are partly between held masses and left out
  double energy_across(double strain) const {
    const GutSprings springs(shape_, {.mesentery_stretch_n_m = 1000});
    Points x = shape_.positions;
    for (Vec3& p : x) p.y() *= 1 + strain;
    return springs.energy(x);
  }

 private:
  GutShape shape_;
};

TEST(GutSprings, AStripPulledAcrossHoldsTheMembranesEnergyAtAnyResolution) {
  constexpr double kStrain = 1e-4, kLength_m = 2, kWidth_m = 0.15;
  for (const GutLayout layout : {GutLayout{4, 60}, GutLayout{4, 600}, GutLayout{7, 300}}) {
    // the first and the last column are held: half a cell of springs across is not there at either end
    const double cells = layout.columns - 2;
    const double area = kLength_m * kWidth_m * cells / (layout.columns - 1);
    EXPECT_NEAR(FlatStrip(layout, kLength_m, kWidth_m).energy_across(kStrain),
                0.5 * 1000 * kStrain * kStrain * area, 0.02 * 0.5 * 1000 * kStrain * kStrain * area)
        << layout.rows << " x " << layout.columns;
  }
}

std::string refusal(const GutMaterial& material) {
  try {
    GutSprings(test::curtain({}), material);
  } catch (const std::invalid_argument& wrong) {
    return wrong.what();
  }
  return "";
}

TEST(GutSprings, AMaterialThatCannotBeIsRefusedByName) {
  EXPECT_NE(refusal({.gut_mass_kg_m = 0}).find("gut_mass_kg_m"), std::string::npos);
  EXPECT_NE(refusal({.gut_stretch_n = -1}).find("gut_stretch_n"), std::string::npos);
  EXPECT_NE(refusal({.gut_bending_n_m2 = std::nan("")}).find("gut_bending_n_m2"), std::string::npos);
  EXPECT_NE(refusal({.mesentery_mass_kg_m2 = 0}).find("mesentery_mass_kg_m2"), std::string::npos);
  EXPECT_NE(refusal({.mesentery_stretch_n_m = 0}).find("mesentery_stretch_n_m"), std::string::npos);
  EXPECT_NE(refusal({.spring_damping_s = -1}).find("spring_damping_s"), std::string::npos);
  EXPECT_NE(refusal({.calming_time_s = 0}).find("calming_time_s"), std::string::npos);
}

}  // namespace
}  // namespace omentum::physics
