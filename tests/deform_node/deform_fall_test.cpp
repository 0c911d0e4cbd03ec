// How what is cut off falls: as any body does, whatever was removed around it.
#include "deform_node/dynamic_maker.h"
#include "deform_node/dynamic_model.h"
#include "geometry/mesh_editor.h"
#include "tests/deform_node/hybrid_cut_trials.h"
#include "tests/support/meshes.h"

#include <gtest/gtest.h>

namespace omentum::deform {
namespace {

constexpr double kFallTick_s = 0.005, kGravity_m_s2 = 9.81;
constexpr int kFallTicks = 20;
const physics::Material kFallingTissue{20000, 0.4, 1000};

class FallTest : public testing::Test {
 protected:
  std::unique_ptr<OrganModel> dynamic(bool warped) {
    const SteppedBody body{
        mesh_, material_, {.mass = physics::lumped_masses(mesh_, material_), .fixed = fixed_}};
    DynamicParts parts{
        .body = body,
        .uncut_surface = organ_.source.organ.surface.node,
        .stepper = warped ? make_warped_stepper(body, kFallTick_s) : make_implicit_stepper(body, kFallTick_s),
        .tears = std::vector<physics::TearLimits>(mesh_.tetrahedra.size()),
        .cut_delay_s = 0,
        .cut_rate_per_s = 1e6};
    parts.gravity_m_s2 = Vec3(0, 0, -kGravity_m_s2);
    return std::make_unique<DynamicModel>(std::move(parts));
  }
  std::unique_ptr<OrganModel> hybrid(const std::string& law) {
    organ_.spec.dynamics->law = law;
    organ_.spec.dynamics->step_s = kFallTick_s;
    organ_.spec.dynamics->mass_damping_per_s = 0;
    organ_.spec.dynamics->stiffness_damping_s = 0;
    return make_hybrid(organ_.source, organ_.spec);
  }

  /// The centre of mass of what lies beyond the cut, of tetrahedra that are left, as displacement, m.
  Vec3 centre(const OrganModel& model) const {
    const OrganView view = model.view();
    Vec3 moment = Vec3::Zero();
    double volume_m3 = 0;
    for (std::size_t t = 0; t < mesh_.tetrahedra.size(); ++t) {
      if (view.removed_bits[t / 8] >> t % 8 & 1 || middle(t) < kCut_m) continue;
      const auto& [a, b, c, d] = mesh_.tetrahedra[geometry::TetId(t)];
      const auto& x = mesh_.positions;
      const double share_m3 = geometry::signed_volume(x[a], x[b], x[c], x[d]);
      for (const NodeId n : {a, b, c, d})
        moment += share_m3 / 4 * Vec3::Map(view.body_u.data() + 3 * static_cast<std::size_t>(n));
      volume_m3 += share_m3;
    }
    return moment / volume_m3;
  }
  double middle(std::size_t t) const {
    double x = 0;
    for (const NodeId n : mesh_.tetrahedra[geometry::TetId(t)]) x += mesh_.positions[n].x() / 4;
    return x;
  }

  /// The mean acceleration over a tenth of a second, m/s^2.
  Vec3 fall(OrganModel& model) const {
    const CutStroke stroke{.tool = 0,
                           .cut = 1,
                           .from = {Vec3(kCut_m, -1, -1), Vec3(kCut_m, -1, 1)},
                           .to = {Vec3(kCut_m, 1, -1), Vec3(kCut_m, 1, 1)}};
    model.step({.presses = {}, .cuts = {&stroke, 1}}, kFallTick_s);
    EXPECT_GT(model.status().removed_tetrahedra, 10u);
    const auto velocity = [&] {
      const Vec3 before = centre(model);
      model.step({}, kFallTick_s);
      return Vec3((centre(model) - before) / kFallTick_s);
    };
    for (int i = 0; i < 5; ++i) model.step({}, kFallTick_s);
    const Vec3 first = velocity();
    for (int i = 0; i < kFallTicks - 1; ++i) model.step({}, kFallTick_s);
    const Vec3 last = velocity();
    EXPECT_FALSE(model.status().diverged);
    EXPECT_EQ(model.status().fault, std::string_view());
    return (last - first) / (kFallTicks * kFallTick_s);
  }
  void expect_free_fall(OrganModel& model, const std::string& law) const {
    // what the equation of a co-rotational step lacks goes to the next one: up to a thousandth of a step's
    // impulse (WarpedOptions::tolerance), at either end of those that are looked at
    const double most_m_s2 = (law == "linear" ? 1e-6 : 2 * 1e-3 / kFallTicks) * kGravity_m_s2;
    const Vec3 g(0, 0, -kGravity_m_s2);
    EXPECT_LT((fall(model) - g).norm(), most_m_s2) << law;
    model.reset();
    EXPECT_LT((fall(model) - g).norm(), most_m_s2) << law << ", after a reset";
  }

  static constexpr double kCut_m = 0.0975;  // inside a layer of cells
  const geometry::TetraMesh box_ = test::make_box_mesh(8, 2, 2, Vec3(0.12, 0.03, 0.03));
  test::HybridOrgan organ_{box_, test::held_at_low_x(box_, 1e-9), "plane:x>0.06", kFallingTissue};
  const geometry::TetraMesh& mesh_ = organ_.source.organ.mesh;  // its nodes in the file's order
  physics::MaterialMap material_{kFallingTissue};
  physics::FixedComponents fixed_ = test::held_at_low_x(mesh_, 1e-9);
};

TEST_F(FallTest, APieceThatIsCutOffFallsWithG) {
  expect_free_fall(*dynamic(false), "linear");
  expect_free_fall(*dynamic(true), "corotational");
}

TEST_F(FallTest, SoDoesAPieceOfAHybridOrgan) {
  expect_free_fall(*hybrid("linear"), "linear");
  expect_free_fall(*hybrid("corotational"), "corotational");
}

}  // namespace
}  // namespace omentum::deform
