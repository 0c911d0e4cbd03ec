// A beam of two meshes that share no nodes, as a scene makes it of an organ file.
#include "deform_node/local_patch.h"
#include "deform_node/model_table.h"
#include "organ/joined_parts.h"
#include "tests/deform_node/hybrid_organ.h"
#include "tests/deform_node/rates.h"
#include "tests/support/meshes.h"

#include <gmock/gmock.h>

#include <random>

namespace omentum::deform {
namespace {

constexpr double kTiedBorder_m = 0.06;

class TiedModelTest : public testing::Test {
 protected:
  TiedModelTest() {
    geometry::TetraMesh coarse = test::make_box_mesh(4, 2, 2, {kTiedBorder_m, 0.03, 0.03});
    for (Vec3& p : coarse.positions) p.x() += kTiedBorder_m;
    organ::JoinedParts joined =
        organ::join_parts(test::make_box_mesh(6, 4, 4, {kTiedBorder_m, 0.03, 0.03}), coarse, 0, "");
    physics::FixedComponents fixed = test::held_at_low_x(joined.mesh, 1e-9);
    organ::build_organ(organ::make_organ("organ", std::move(joined.mesh), physics::Material{20000, 0.4, 1000},
                                         std::move(fixed), organ::Storage::kFloat, std::move(joined.dynamic),
                                         std::move(joined.border)),
                       folder_ / "organ.h5", {});
    source_.organ = organ::load_organ(folder_ / "organ.h5", organ::Load::kWithPart);
    source_.rest = geometry::surface_positions(source_.organ.mesh, source_.organ.surface);
    spec_.dynamics.emplace();
    spec_.dynamics->gravity_m_s2 = Vec3(0, 0, -9.81);
    spec_.dynamics->mass_damping_per_s = 10;
  }
  std::unique_ptr<OrganModel> make() const {
    return find_model(model_table(), "hybrid").make(source_, spec_);
  }
  static void pass_time(OrganModel& model, int ticks) {
    for (int i = 0; i < ticks; ++i) {
      model.step({}, kTick_s);
      ASSERT_FALSE(model.status().diverged) << "after " << i << " ticks";
      ASSERT_EQ(model.status().fault, "") << "after " << i << " ticks";
    }
  }
  // As a bit each: dynamic tetrahedra that `is_gone` says, by their centres.
  template <class IsGone>
  std::vector<std::uint8_t> bits(IsGone&& is_gone) const {
    const geometry::TetraMesh& mesh = source_.organ.mesh;
    std::vector<std::uint8_t> bits((mesh.tetrahedra.size() + 7) / 8, 0);
    for (std::size_t t = 0; t < mesh.tetrahedra.size(); ++t) {
      Vec3 centre = Vec3::Zero();
      for (const NodeId n : mesh.tetrahedra[t]) centre += mesh.positions[n] / 4;
      if (source_.organ.split->dynamic[t] != 0 && is_gone(centre))
        bits[t / 8] = static_cast<std::uint8_t>(bits[t / 8] | 1 << t % 8);
    }
    return bits;
  }

  test::ScratchFolder folder_;
  node::OrganSource source_{.kind = scene::OrganKind::kTetrahedralMesh, .organ = {}, .rest = {}};
  scene::OrganSpec spec_;
};

TEST_F(TiedModelTest, ItHangsWithoutAGapAtItsBorder) {
  const auto model = make();
  pass_time(*model, 300);
  // both have nodes at the ends of the border's lower edge
  const auto at_edge = [&](double y, bool of_dynamic) {
    const auto& mesh = source_.organ.mesh;
    for (std::size_t n = 0; n < mesh.positions.size(); ++n) {
      const bool is_there = (mesh.positions[n] - Vec3(kTiedBorder_m, y, 0)).norm() < 1e-9;
      if (is_there && source_.organ.split->parts.dynamic.own_node[n].valid() == of_dynamic)
        return Vec3(model->view().body_u.data() + 3 * n);
    }
    return Vec3(NAN, NAN, NAN);
  };
  const double sag = at_edge(0, true).norm();
  EXPECT_GT(sag, 1e-4);
  for (const double y : {0.0, 0.03})
    EXPECT_LE((at_edge(y, true) - at_edge(y, false)).norm(), 1e-5 * sag) << y;
}

TEST_F(TiedModelTest, TheBorderIsNoSurfaceUntilACutBaresIt) {
  const auto model = make();
  const Vec3 inside(kTiedBorder_m, 0.016, 0.014);
  LocalPatch patch(model->sizes().local_nodes);
  EXPECT_FALSE(model->local_model({.centre = inside, .radius_m = 0.005}, patch)) << "a wall inside the organ";
  model->take_up(bits([](const Vec3& x) { return x.x() < 0.075; }), {}, 1);
  pass_time(*model, 1);
  ASSERT_TRUE(model->local_model({.centre = inside, .radius_m = 0.005}, patch));
  EXPECT_GT(patch.triangle_count, 0u);
  for (std::size_t i = 0; i < patch.node_count; ++i)
    EXPECT_FALSE(source_.organ.split->parts.dynamic.own_node[patch.nodes[i]].valid());
  model->reset();
  EXPECT_FALSE(model->local_model({.centre = inside, .radius_m = 0.005}, patch));
}

TEST_F(TiedModelTest, RandomCutsAtTheBorderLeaveItFiniteAndBounded) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> share(0, 1);
  for (int trial = 0; trial < 20; ++trial) {
    const auto model = make();
    model->take_up(bits([&](const Vec3& x) { return x.x() < 0.08 && share(random) < 0.3; }), {}, 1);
    pass_time(*model, 20);
    for (std::size_t n = 0; n < source_.organ.mesh.positions.size(); ++n) {
      if (source_.organ.split->parts.dynamic.own_node[n].valid()) continue;
      for (std::size_t i = 0; i < 3; ++i)
        ASSERT_LT(std::abs(model->view().body_u[3 * n + i]), 0.05) << "node " << n << " of trial " << trial;
    }
  }
}

}  // namespace
}  // namespace omentum::deform
