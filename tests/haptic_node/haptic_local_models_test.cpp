// haptic_node's loop with an organ that is felt by local models: what it hears, what it feels of it, what it
// drops.
#include "tests/haptic_node/haptic_stage.h"
#include "tests/support/organ_patch.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <limits>

namespace omentum::haptic {
namespace {

using haptic_test::HapticLoopTest;
using haptic_test::kAbove;
using haptic_test::kPressed;
using haptic_test::kRate_hz;
using haptic_test::newton;
using haptic_test::Node;
using testing::Contains;
using testing::Each;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;
using testing::StartsWith;

constexpr std::array kByLocalModels{
    scene::OrganModelWord{"quasi-static", scene::OrganKind::kTetrahedralMesh, scene::Feel::kLocalModels}};
constexpr int kTicksPerModel = 10;
constexpr double kSlew_n = 2000 / kRate_hz;  // of a tick, by the scene's default

class LocalModelsTest : public HapticLoopTest {
 protected:
  void SetUp() override { options_.models = kByLocalModels; }

  static const organ::Organ& organ() {
    static const organ::Organ organ = block().organ();
    return organ;
  }
  static const std::vector<Vec3>& rest() {
    static const std::vector<Vec3> rest = geometry::surface_positions(organ().mesh, organ().surface);
    return rest;
  }

  /// The block around a place at rest, moved by `shift`.
  msg::LocalModel model_at(const Vec3& place, const Vec3& shift = Vec3::Zero()) {
    const test::OrganPatch patch = test::nearest_patch(organ().surface, rest(), place, 40);
    msg::LocalModel model{};
    model.seq = ++models_;
    for (const geometry::SurfaceId n : patch.nodes) {
      const Vec3 x = rest()[n] + shift;
      model.nodes.push_back(static_cast<std::uint32_t>(organ().mesh.file_node[organ().surface.node[n]]));
      model.positions.push_back({x.x(), x.y(), x.z()});
    }
    model.forces.resize(patch.nodes.size());
    for (const auto& t : patch.triangles) model.triangles.insert(model.triangles.end(), t.begin(), t.end());
    for (std::size_t i = 0; i < 3 * patch.nodes.size(); ++i) {
      for (std::size_t j = i; j < 3 * patch.nodes.size(); ++j)
        model.compliance.push_back(static_cast<float>(
            organ().compliance->block(patch.nodes[i / 3], patch.nodes[j / 3])(i % 3, j % 3)));
    }
    return model;
  }

  /// As HapticLoopTest's, with a model each hundredth of a second.
  void hold_with_models(Node& node, const Vec3& tip, int ticks,
                        const std::function<void(msg::LocalModel&)>& spoil = {}) {
    for (int i = 0; i < ticks; ++i) {
      if (i % kTicksPerModel == 0) {
        msg::LocalModel model = model_at(kPressed);
        if (spoil) spoil(model);
        bus_.post(model);
      }
      hold(node, tip, 1);
    }
  }
  std::unique_ptr<Node> pressing_model() {
    auto node = serving();
    hold_with_models(*node, kAbove, 20);
    for (int i = 1; i <= 90; ++i) hold_with_models(*node, kAbove + (kPressed - kAbove) * i / 90, 1);
    hold_with_models(*node, kPressed, 300);
    return node;
  }
  double plain_n() {
    options_.models = scene::kOrganModels;
    const auto node = pressing();
    hold(*node, kPressed, 1);
    options_.models = kByLocalModels;
    return newton(*bus_.newest<msg::ToolForce>());
  }
  nlohmann::json counted(Node& node) {
    EXPECT_EQ(node.end(), "");
    return node.loop().report()["local_models"];
  }

  std::uint64_t models_ = 0;
};

TEST_F(LocalModelsTest, WithoutAModelThereIsNothingToFeel) {
  const auto node = pressing();
  hold(*node, kPressed, 1);
  EXPECT_EQ(newton(*bus_.newest<msg::ToolForce>()), 0);
  EXPECT_THAT(faults(), IsEmpty());
}

TEST_F(LocalModelsTest, AToolFeelsWhatTheLinearModelSays) {
  const double plain = plain_n();
  ASSERT_GT(plain, 0.1);
  const auto node = pressing_model();
  hold(*node, kPressed, 1);
  EXPECT_NEAR(newton(*bus_.newest<msg::ToolForce>()), plain, 1e-3 * plain);
  const auto counts = counted(*node);
  EXPECT_EQ(counts["dropped"], 0);
  EXPECT_EQ(counts["gone"], 0);
}

TEST_F(LocalModelsTest, ContactsNameTheModelsVersionAndTheMeshFilesNodes) {
  const auto node = pressing_model();
  hold_with_models(*node, kPressed, 20, [](msg::LocalModel& model) { model.topology_version = 7; });
  bus_.take_all<msg::Contact>();
  hold(*node, kPressed, 8);
  const auto contact = last_of_tool<msg::Contact>(0);
  ASSERT_TRUE(contact);
  EXPECT_EQ(contact->topology_version, 7u);
  ASSERT_THAT(contact->nodes, testing::Not(IsEmpty()));
  const auto of_file = organ().surface_of_file_node();
  for (const std::uint32_t n : contact->nodes) EXPECT_TRUE(of_file[n].valid());
}

TEST_F(LocalModelsTest, ContactsTellDisplacementsFromTheOrgansRest) {
  const auto node = serving();
  const Vec3 sunk(0.001, 0, -0.003);  // the whole organ; the tip presses the rest of its 6 mm
  for (int i = 0; i < 300; ++i) {
    if (i % kTicksPerModel == 0) bus_.post(model_at(kPressed, sunk));
    hold(*node, kAbove + (kPressed - kAbove) * std::min(i, 90) / 90, 1);
  }
  const auto contact = last_of_tool<msg::Contact>(0);
  ASSERT_TRUE(contact);
  ASSERT_THAT(contact->nodes, testing::Not(IsEmpty()));
  const auto of_file = organ().surface_of_file_node();
  for (std::size_t i = 0; i < contact->nodes.size(); ++i) {
    Vec3 u = sunk;
    for (std::size_t j = 0; j < contact->nodes.size(); ++j)
      u += organ().compliance->block(of_file[contact->nodes[i]], of_file[contact->nodes[j]]) *
           haptic_test::vector(contact->forces[j]);
    EXPECT_LE((haptic_test::vector(contact->displacements[i]) - u).norm(), 1e-4 * u.norm());
  }
}

TEST_F(LocalModelsTest, AToolTouchesNoOtherToolsPatch) {
  const auto node = serving();
  for (int i = 0; i < 200; ++i) {
    hold_with_models(*node, kAbove + (kPressed - kAbove) * std::min(i, 100) / 100, 1,
                     [](msg::LocalModel& model) { model.patch = 3; });
  }
  EXPECT_EQ(newton(*bus_.newest<msg::ToolForce>()), 0);
}

TEST_F(LocalModelsTest, SilenceEmptiesAndTheForceDecays) {
  const auto node = pressing_model();
  hold(*node, kPressed, 150);
  double before = newton(*bus_.newest<msg::ToolForce>());
  EXPECT_GT(before, 0.1) << "a late model is no gone one";
  for (int i = 0; i < 150; ++i) {
    hold(*node, kPressed, 1);
    const double now = newton(*bus_.newest<msg::ToolForce>());
    EXPECT_GE(now, before - kSlew_n - 1e-9);
    before = now;
  }
  EXPECT_EQ(before, 0);
  EXPECT_EQ(counted(*node)["gone"], 1);
}

TEST_F(LocalModelsTest, APatchWithoutNodesIsGoneAtOnce) {
  const auto node = pressing_model();
  msg::LocalModel none{};
  none.seq = ++models_;
  bus_.post(none);
  hold(*node, kPressed, 20);
  EXPECT_EQ(newton(*bus_.newest<msg::ToolForce>()), 0);
  EXPECT_THAT(last_of_tool<msg::Contact>(0)->nodes, IsEmpty());
}

TEST_F(LocalModelsTest, AnotherModelIsNoStepOfTheForce) {
  const auto node = pressing_model();
  hold(*node, kPressed, 1);
  double before = newton(*bus_.newest<msg::ToolForce>());
  const double plain = before;
  // a surface that is a millimetre lower all at once
  bus_.post(model_at(kPressed, Vec3(0, 0, -1e-3)));
  double largest_step = 0;
  for (int i = 0; i < 40; ++i) {
    hold(*node, kPressed, 1);
    const double now = newton(*bus_.newest<msg::ToolForce>());
    largest_step = std::max(largest_step, std::abs(now - before));
    before = now;
  }
  EXPECT_LT(before, 0.9 * plain);
  EXPECT_LT(largest_step, 1.5 * (plain - before) * 1e-3 / kBlend_s) << "it comes within the blend";
}

TEST_F(LocalModelsTest, ASurfaceThatMovesIsMetWhereItIsByNow) {
  const auto node = pressing_model();
  // comes up with 0.1 m/s, and is told late
  msg::LocalModel model = model_at(kPressed);
  model.velocities.assign(model.nodes.size(), {.x = 0, .y = 0, .z = 0.1});
  hold(*node, kPressed, 1);
  const double before = newton(*bus_.newest<msg::ToolForce>());
  bus_.post(model);
  hold(*node, kPressed, 15);
  const double risen = newton(*bus_.newest<msg::ToolForce>());
  EXPECT_GT(risen, before * (1 + 0.5 * 1.5 / 6)) << "1.4 mm on 6";
  hold(*node, kPressed, 50);
  const double stands = newton(*bus_.newest<msg::ToolForce>());
  EXPECT_GT(stands, risen);
  hold(*node, kPressed, 50);
  EXPECT_NEAR(newton(*bus_.newest<msg::ToolForce>()), stands, 1e-3 * stands) << "not for ever";
}

TEST_F(LocalModelsTest, AnOlderVersionAnOldSampleAndAStrangersAreDroppedAndCounted) {
  const auto node = pressing_model();
  hold_with_models(*node, kPressed, 20, [](msg::LocalModel& model) { model.topology_version = 7; });
  hold(*node, kPressed, 1);
  const double before = newton(*bus_.newest<msg::ToolForce>());
  std::vector<msg::LocalModel> bad(4, model_at(kPressed, Vec3(0, 0, 5e-3)));
  for (msg::LocalModel& model : bad) model.topology_version = 7;
  bad[0].topology_version = 6;
  bad[1].seq = 1;
  bad[2].organ = 1;
  bad[3].patch = 5;
  for (const msg::LocalModel& model : bad) bus_.post(model);
  hold(*node, kPressed, 15);
  EXPECT_NEAR(newton(*bus_.newest<msg::ToolForce>()), before, 1e-3 * before);
  hold(*node, kPressed, 200);
  EXPECT_THAT(faults(), SizeIs(4));
  EXPECT_THAT(faults(), Each(StartsWith("local model dropped: ")));
  EXPECT_EQ(counted(*node)["dropped"], 4);
}

// Models leave one by one: when one tool's names the newest cut already, another tool's need not yet.
TEST_F(LocalModelsTest, AnotherToolsNewerVersionMakesNoModelOld) {
  const auto node = serving();
  std::uint64_t of_other = 0;
  for (int i = 0; i < 400; ++i) {
    if (i % kTicksPerModel == 0) {
      msg::LocalModel other = model_at(kAbove);
      other.patch = 3;
      other.seq = ++of_other;
      other.topology_version = std::numeric_limits<std::uint64_t>::max();
      bus_.post(other);
    }
    hold_with_models(*node, kAbove + (kPressed - kAbove) * std::min(i, 90) / 90, 1);
  }
  EXPECT_GT(newton(*bus_.newest<msg::ToolForce>()), 0.1);
  EXPECT_THAT(faults(), IsEmpty());
  EXPECT_EQ(counted(*node)["dropped"], 0);
}

// Between one and two of an organ's diagonals a loose piece still falls.
TEST_F(LocalModelsTest, APieceOnItsWayDownIsAModel) {
  Eigen::AlignedBox3d box;
  for (const Vec3& x : organ().mesh.positions) box.extend(x);
  const Vec3 diagonal_down(0, 0, -box.diagonal().norm());
  const auto node = serving();
  bus_.post(model_at(kPressed, 1.5 * diagonal_down));
  hold(*node, kAbove, 20);
  EXPECT_THAT(faults(), IsEmpty());
  bus_.post(model_at(kPressed, 2.5 * diagonal_down));
  hold(*node, kAbove, 20);
  EXPECT_EQ(counted(*node)["dropped"], 1);
}

TEST_F(LocalModelsTest, AnOrganThatIsFeltByItsTensorsIsFeltByNothingElse) {
  options_.models = scene::kOrganModels;
  const auto node = pressing();
  hold(*node, kPressed, 1);
  EXPECT_GT(newton(*bus_.newest<msg::ToolForce>()), 0.1);
  EXPECT_EQ(node->end(), "");
  EXPECT_EQ(node->loop().report()["local_models"]["heard"], 0);
}

TEST_F(LocalModelsTest, WhoNumbersAnewAfterASilenceIsHeard) {
  const auto node = pressing_model();
  hold_with_models(*node, kPressed, 20, [](msg::LocalModel& model) { model.topology_version = 7; });
  hold(*node, kAbove, 400);
  models_ = 0;
  hold_with_models(*node, kAbove, 20);
  for (int i = 1; i <= 90; ++i) hold_with_models(*node, kAbove + (kPressed - kAbove) * i / 90, 1);
  EXPECT_GT(newton(*bus_.newest<msg::ToolForce>()), 0.1);
}

// Whatever comes instead of models: no force that was not there before, and none that is no number.
TEST_F(LocalModelsTest, HostileModelsNeverMoveAHand) {
  using Spoil = std::function<void(msg::LocalModel&)>;
  const std::vector<Spoil> hostile = {
      [](auto& m) { m.positions[1].z = std::numeric_limits<double>::quiet_NaN(); },
      [](auto& m) { m.positions[1].z = 1e30; },
      [](auto& m) {
        for (auto& x : m.positions) x.z += 0.5;
      },
      [](auto& m) { m.velocities.assign(m.nodes.size(), {.x = 0, .y = 0, .z = 1e6}); },
      [](auto& m) { m.velocities.resize(2); },
      [](auto& m) { m.forces[0].x = std::numeric_limits<double>::infinity(); },
      [](auto& m) { m.forces.assign(m.nodes.size(), {.x = 0, .y = 0, .z = 1e9}); },
      [](auto& m) {
        for (float& c : m.compliance) c = -c;
      },
      [](auto& m) { m.compliance[0] = 1e20f; },
      [](auto& m) { m.compliance.pop_back(); },
      [](auto& m) { m.triangles[0] = 200; },
      [](auto& m) { m.triangles.clear(); },
      [](auto& m) { m.nodes[0] = 1u << 31; },
      [](auto& m) { m.positions.pop_back(); },
  };
  const auto node = pressing_model();
  hold(*node, kPressed, 1);
  const double before = newton(*bus_.newest<msg::ToolForce>());
  for (const Spoil& spoil : hostile) {
    msg::LocalModel model = model_at(kPressed);
    spoil(model);
    // numbers that no genuine model has, which must not shut out those
    model.seq = model.topology_version = std::numeric_limits<std::uint64_t>::max();
    bus_.post(model);
    hold(*node, kPressed, 3);
    ASSERT_NEAR(newton(*bus_.newest<msg::ToolForce>()), before, 1e-2 * before);
    bus_.post(model_at(kPressed));
    hold(*node, kPressed, 1);
  }
  hold_with_models(*node, kPressed, 200);
  EXPECT_THAT(faults(), testing::Not(IsEmpty()));
  EXPECT_THAT(faults(), Each(testing::AnyOf(HasSubstr("local model dropped"), HasSubstr("further"))));
  EXPECT_EQ(counted(*node)["dropped"], hostile.size());
}

}  // namespace
}  // namespace omentum::haptic
