#include "deform_node/dynamic_maker.h"

#include "deform_node/model_table.h"
#include "tests/deform_node/rates.h"
#include "tests/support/meshes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace omentum::deform {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr double kBeam_m = 0.12;

// the last one has explicit integrators only
constexpr std::array kDynamic{"tensor-mass", "corotational", "spring-mass"};
constexpr std::array kExplicit{"symplectic", "euler", "rk4"};

/// A soft beam, held at one end, and what a scene says of it.
class DynamicMakerTest : public testing::Test {
 protected:
  DynamicMakerTest() {
    organ::Organ& organ = source_.organ;
    organ.mesh = test::make_box_mesh(6, 2, 2, Vec3(kBeam_m, 0.04, 0.04));
    organ.material = physics::Material{.young_pa = 20000, .poisson = 0.3, .density_kg_m3 = 1000};
    for (const Vec3& x : organ.mesh.positions) organ.fixed.push_back(x.x() < 1e-9 ? physics::kPinned : 0);
    organ.surface = geometry::extract_surface(organ.mesh, physics::pinned_nodes(organ.fixed));
    spec_.dynamics.emplace();
    spec_.dynamics->gravity_m_s2 = Vec3(0, 0, -9.81);
    spec_.dynamics->where = "scene.toml:7";
  }

  std::unique_ptr<OrganModel> make(const std::string& model, const std::string& integrator) {
    spec_.model = model;
    spec_.dynamics->integrator = integrator;
    return find_model(model_table(), model).make(source_, spec_);
  }
  std::string refusal(const std::string& model, const std::string& integrator) {
    try {
      make(model, integrator);
    } catch (const std::runtime_error& e) {
      return e.what();
    }
    return "accepted";
  }
  static void pass(OrganModel& model, double seconds) {
    for (int i = 0; i < std::lround(seconds / kTick_s); ++i) {
      model.step({}, kTick_s);
      ASSERT_FALSE(model.status().diverged) << "after " << i << " ticks";
      ASSERT_EQ(model.status().fault, "") << "after " << i << " ticks";
    }
  }
  /// How far the free end hangs down, m.
  double sag(const OrganModel& model) const {
    const auto& surface = source_.organ.surface;
    double lowest = 0;
    for (std::size_t s = 0; s < surface.node.size(); ++s)
      lowest = std::min<double>(lowest, model.view().values[3 * s + 2]);
    return -lowest;
  }

  node::OrganSource source_;
  scene::OrganSpec spec_;
};

TEST_F(DynamicMakerTest, AllIntegratorsOfALawComeToTheSameRest) {
  spec_.dynamics->mass_damping_per_s = 10;
  for (const std::string model : kDynamic) {
    const auto first = make(model, "symplectic");
    pass(*first, 5);
    const double expected = sag(*first);
    EXPECT_GT(expected, 0.001) << model;
    for (const std::string integrator : {"implicit", "euler", "rk4"}) {
      if (model == "spring-mass" && integrator == "implicit") continue;
      const auto other = make(model, integrator);
      pass(*other, 5);
      EXPECT_NEAR(sag(*other), expected, 1e-3 * expected) << model << ", " << integrator;
    }
  }
}

// The linear law lengthens what turns; in turning frames a beam that hangs down keeps its length.
TEST_F(DynamicMakerTest, ACorotationalBeamHangsDownAndComesToRest) {
  source_.organ.material = physics::Material{.young_pa = 4000, .poisson = 0.3, .density_kg_m3 = 1000};
  const auto turning = make("corotational", "implicit"), linear = make("tensor-mass", "implicit");
  pass(*turning, 10);
  pass(*linear, 10);
  EXPECT_GT(sag(*turning), 0.5 * kBeam_m);
  EXPECT_LT(sag(*turning), 1.3 * kBeam_m);
  EXPECT_GT(sag(*linear), sag(*turning));
  const double at_rest = sag(*turning);
  pass(*turning, 0.5);
  EXPECT_NEAR(sag(*turning), at_rest, 1e-4 * at_rest);
}

TEST_F(DynamicMakerTest, AStepThatIsNotStableIsRefusedWithItsLine) {
  spec_.dynamics->step_s = 0.02;
  for (const std::string model : kDynamic) {
    for (const std::string integrator : kExplicit)
      EXPECT_THAT(refusal(model, integrator),
                  AllOf(HasSubstr("scene.toml:7: step_s: found 0.02, expected less than"),
                        HasSubstr("\"" + integrator + "\"")));
    if (model != "spring-mass") {
      EXPECT_EQ(refusal(model, "implicit"), "accepted");
    }
  }
}

TEST_F(DynamicMakerTest, ForwardEulerNeedsDamping) {
  spec_.dynamics->mass_damping_per_s = spec_.dynamics->stiffness_damping_s = 0;
  EXPECT_THAT(refusal("tensor-mass", "euler"), HasSubstr("scene.toml:7: "));
  EXPECT_EQ(refusal("tensor-mass", "symplectic"), "accepted");
}

TEST_F(DynamicMakerTest, CutAndResetEveryLawIsWhatItWas) {
  for (const std::string model : kDynamic) {
    for (const std::string integrator : {"implicit", "symplectic"}) {
      if (model == "spring-mass" && integrator == "implicit") continue;
      const auto cut = make(model, integrator), never = make(model, integrator);
      const CutStroke stroke{.tool = 0,
                             .cut = 1,
                             .from = {Vec3(0.05, -1, -1), Vec3(0.05, -1, 1)},
                             .to = {Vec3(0.05, 1, -1), Vec3(0.05, 1, 1)}};
      cut->step({.presses = {}, .cuts = {&stroke, 1}}, kTick_s);
      pass(*cut, 0.2);
      EXPECT_GT(cut->status().removed_tetrahedra, 0u) << model;
      cut->reset();
      pass(*cut, 0.3);
      pass(*never, 0.3);
      ASSERT_EQ(cut->view().values.size(), never->view().values.size());
      for (std::size_t i = 0; i < never->view().values.size(); ++i)
        EXPECT_NEAR(cut->view().values[i], never->view().values[i], 1e-6) << model << ", " << integrator;
    }
  }
}

}  // namespace
}  // namespace omentum::deform
