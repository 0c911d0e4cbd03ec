#include "deform_node/organ_group.h"

#include "organ/build_organ.h"
#include "tests/deform_node/deform_fixtures.h"
#include "tests/deform_node/deform_toy.h"
#include "tests/deform_node/rates.h"
#include "tests/support/heap_count.h"
#include "tests/support/meshes.h"
#include "tests/support/process.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>
#include <thread>

namespace omentum::deform {
namespace {

using deform_test::contact_on;
using deform_test::HangingMass;
using deform_test::kNs_per_s;
using ::testing::HasSubstr;

// Brings a mass 0.495 m far in a tick, of which its damping takes a fifth.
constexpr double kMeeting_m_s =
    0.495 / kTick_s / (1 - HangingMass::kDamping_n_s_m * kTick_s / HangingMass::kMass_kg);

TEST(ModelTable, MakesEveryModelThatAScenesWordsName) {
  std::set<std::string_view> made, words;
  for (const ModelEntry& entry : model_table()) made.insert(entry.word);
  for (const auto& model : scene::kOrganModels) words.insert(model.word);
  EXPECT_EQ(made, words);
  EXPECT_EQ(made.size(), model_table().size()) << "each once";
}

TEST(ModelTable, AWordThatNoEntryHasIsNamed) {
  try {
    find_model(model_table(), "jelly");
    FAIL() << "it was found";
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), HasSubstr("jelly"));
  }
}

/// A scene of one organ with a file, moved by whatever model.
class SceneOfOneBlock {
 public:
  explicit SceneOfOneBlock(const std::string& model) {
    const geometry::TetraMesh mesh = test::make_box_mesh(2, 2, 2, Vec3::Constant(0.1));
    organ::FixedComponents fixed(mesh.positions.size(), 0);
    for (std::size_t n = 0; n < fixed.size(); ++n)
      if (mesh.positions[n].z() < 0.001) fixed[n] = 7;
    organ::build_organ(
        organ::make_organ("block", mesh, physics::Material{1e4, 0.45, 1000}, fixed, organ::Storage::kFloat),
        folder_ / "block.h5", {});
    scene::OrganSpec& spec = scene.organs.emplace_back();
    spec.name = "block";
    spec.model = model;
    spec.file = folder_ / "block.h5";
  }
  scene::Scene scene;

 private:
  test::ScratchFolder folder_;
};

TEST(LoadOrgans, TheSceneChoosesTheModel) {
  const SceneOfOneBlock block("quasi-static");
  const std::vector<ServedOrgan> organs = load_organs(block.scene);
  ASSERT_EQ(organs.size(), 1u);
  EXPECT_EQ(organs[0].source->kind, scene::OrganKind::kTetrahedralMesh);
  EXPECT_EQ(organs[0].model->view().values.size(), 3 * organs[0].source->rest.size());
  EXPECT_NE(numbers_of(*organs[0].source).compliance, nullptr);
}

TEST(LoadOrgans, AToyTakesPartByAnEntryOfItsOwnWithoutTensors) {
  const SceneOfOneBlock block("hanging mass");
  std::vector<ModelEntry> table(model_table().begin(), model_table().end());
  table.push_back(deform_test::kHangingMass);
  const std::vector<ServedOrgan> organs = load_organs(block.scene, table);
  ASSERT_EQ(organs.size(), 1u);
  EXPECT_EQ(organs[0].model->view().kind, StateKind::kTube);
  EXPECT_EQ(numbers_of(*organs[0].source).compliance, nullptr) << "nobody asked for the tensors";
  EXPECT_THROW(load_organs(block.scene), std::runtime_error) << "the table without it";
}

TEST(LoadOrgans, AnOrganWithoutAFileIsRefusedNamingSceneAndOrgan) {
  scene::Scene scene;
  scene.file = "s.toml";
  scene.organs.emplace_back().name = "liver";
  try {
    load_organs(scene);
    FAIL() << "it was loaded";
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), HasSubstr("s.toml: organ liver has no file"));
  }
}

// Its topology needs more bits than a message has.
class LargeMass final : public OrganModel {
 public:
  ModelSizes sizes() const override { return {.values = 3, .removed_bytes = msg::MAX_REMOVED_BYTES + 1}; }
  void step(const TickLoads& /*loads*/, double /*dt_s*/) noexcept override {}
  void reset() noexcept override {}
  OrganView view() const noexcept override { return {}; }
  ModelStatus status() const noexcept override { return {}; }
};

TEST(LoadOrgans, AnOrganWhoseCutsNoMessageHoldsIsRefusedNamingSceneAndOrgan) {
  SceneOfOneBlock block("large mass");
  block.scene.file = "s.toml";
  const std::vector<ModelEntry> table{
      {"large mass", organ::Load::kMeshOnly,
       [](const node::OrganSource&, const scene::OrganSpec&) -> std::unique_ptr<OrganModel> {
         return std::make_unique<LargeMass>();
       }}};
  try {
    load_organs(block.scene, table);
    FAIL() << "it was loaded";
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), HasSubstr("s.toml: organ block can be cut"));
    EXPECT_THAT(error.what(), HasSubstr("8388608"));
  }
}

class OrganGroupTest : public ::testing::Test {
 protected:
  static std::vector<ServedOrgan> two_masses() {
    std::vector<ServedOrgan> organs;
    organs.push_back(deform_test::hanging_organ("left"));
    organs.push_back(deform_test::hanging_organ("right", Vec3(1, 0, 0)));
    return organs;
  }
  HangingMass& mass(std::size_t i) { return static_cast<HangingMass&>(*group_.organs()[i].model); }
  void press(std::uint32_t organ, const Vec3& force_n) {
    msg::Contact contact = contact_on(0, {0}, {force_n});
    contact.organ = organ;
    book_.take(contact, kNs_per_s);
    book_.advance(kNs_per_s);
  }
  bool has_fault(const std::string& text) const {
    const auto faults = faults_.list();
    return std::any_of(faults.begin(), faults.end(), [&](const auto& fault) { return fault.text == text; });
  }

  runtime::FaultList faults_;
  OrganGroup group_{two_masses(), faults_};
  ContactBook book_{{numbers(), numbers()}, {.tools = 1, .max_force_n = 10}, faults_};

 private:
  static OrganNumbers numbers() {
    OrganNumbers numbers = deform_test::odd_numbers(1, 0);
    numbers.reach_m = 1;
    return numbers;
  }
};

TEST_F(OrganGroupTest, AnOrganFollowsItsOwnLoads) {
  press(1, {0, 0, -1});
  for (int tick = 0; tick < 1000; ++tick) group_.step(book_, kTick_s);
  EXPECT_NEAR(mass(1).position().z(), -1 / HangingMass::kSpring_n_m, 1e-9);
  EXPECT_EQ(mass(0).position(), Vec3::Zero());
  EXPECT_EQ(group_.steps(), 2000u);
}

TEST_F(OrganGroupTest, WhatAModelSaysIsWrongIsAFaultOfItsOrgan) {
  press(0, {20, 0, 0});
  for (int tick = 0; tick < 30; ++tick) group_.step(book_, kTick_s);
  EXPECT_TRUE(has_fault("organ left: stretched far"));
}

TEST_F(OrganGroupTest, WhoDivergedIsBackAtRestBeforeAnybodySeesIt) {
  mass(0).push(Vec3(1e9, 0, 0));
  group_.step(book_, kTick_s);
  EXPECT_EQ(mass(0).position(), Vec3::Zero());
  EXPECT_FALSE(mass(0).status().diverged);
  EXPECT_TRUE(has_fault("organ left: diverged, back to rest"));
}

TEST_F(OrganGroupTest, OrgansThatMeetPushEachOtherApart) {
  // towards each other, so that they overlap by half after a tick
  mass(0).push(Vec3(kMeeting_m_s, 0, 0));
  mass(1).push(Vec3(-kMeeting_m_s, 0, 0));
  group_.step(book_, kTick_s);
  EXPECT_LE((mass(0).velocity() + mass(1).velocity()).norm(), 1e-9) << "momentum is kept";
  EXPECT_GT((mass(1).velocity() - mass(0).velocity()).x(), 0) << "and they part";
}

TEST_F(OrganGroupTest, ResetBringsAllToRestAndKeepsTheCounts) {
  press(0, {0, 0, -1});
  group_.step(book_, kTick_s);
  group_.reset(book_);
  EXPECT_EQ(mass(0).position(), Vec3::Zero());
  EXPECT_EQ(group_.steps(), 2u);
}

TEST(OrganGroup, ARunAfterAResetIsTheSameRunAlsoWhereOrgansTouch) {
  std::vector<ServedOrgan> organs;
  organs.push_back(deform_test::hanging_organ("left"));
  organs.push_back(deform_test::hanging_organ("right", Vec3(1.5 * HangingMass::kRadius_m, 0, 0)));
  runtime::FaultList faults;
  OrganGroup group(std::move(organs), faults);
  const OrganNumbers numbers = deform_test::odd_numbers(1, 0);
  ContactBook book({numbers, numbers}, {.tools = 1, .max_force_n = 10}, faults);
  const auto run = [&] {
    std::vector<Vec3> seen;
    for (int tick = 0; tick < 20; ++tick) {
      group.step(book, kTick_s);
      seen.push_back(static_cast<HangingMass&>(*group.organs()[1].model).velocity());
    }
    return seen;
  };
  const std::vector<Vec3> first = run();
  EXPECT_GT(first[0].x(), 0) << "they touch";
  group.reset(book);
  EXPECT_EQ(run(), first);
}

/// Costs, and notes on which thread its newest step was made.
class CostlyMass final : public OrganModel {
 public:
  explicit CostlyMass(const Vec3& rest) : mass_(rest) {}
  ModelSizes sizes() const override {
    ModelSizes sizes = mass_.sizes();
    sizes.costs = true;
    return sizes;
  }
  void step(const TickLoads& loads, double dt_s) noexcept override {
    mass_.step(loads, dt_s);
    stepped_on_ = std::this_thread::get_id();
  }
  void reset() noexcept override { mass_.reset(); }
  OrganView view() const noexcept override { return mass_.view(); }
  ModelStatus status() const noexcept override { return mass_.status(); }
  std::span<const CollisionSphere> collidable() const noexcept override { return mass_.collidable(); }
  void respond(std::span<const OrganContact> contacts) noexcept override { mass_.respond(contacts); }

  const Vec3& velocity() const { return mass_.velocity(); }
  std::thread::id stepped_on() const { return stepped_on_; }

 private:
  HangingMass mass_;
  std::thread::id stepped_on_;
};

/// Four in a row, each of which touches the next.
struct CostlyRow {
  explicit CostlyRow(std::size_t most_threads) : group(masses(), faults, most_threads) {}
  static std::vector<ServedOrgan> masses() {
    std::vector<ServedOrgan> organs;
    for (int i = 0; i < 4; ++i) {
      organs.push_back(deform_test::hanging_organ("organ " + std::to_string(i)));
      organs.back().model = std::make_unique<CostlyMass>(Vec3(1.5 * i * HangingMass::kRadius_m, 0, 0));
    }
    return organs;
  }
  static OrganNumbers numbers() { return deform_test::odd_numbers(1, 0); }
  CostlyMass& mass(std::size_t i) { return static_cast<CostlyMass&>(*group.organs()[i].model); }
  std::vector<Vec3> step() {
    group.step(book, kTick_s);
    std::vector<Vec3> velocities;
    for (std::size_t i = 0; i < 4; ++i) velocities.push_back(mass(i).velocity());
    return velocities;
  }

  runtime::FaultList faults;
  OrganGroup group;
  ContactBook book{{numbers(), numbers(), numbers(), numbers()}, {.tools = 1, .max_force_n = 10}, faults};
};

TEST(OrganGroup, OnSeveralThreadsOrgansDoWhatTheyDoOnOne) {
  CostlyRow alone(1), together(3);
  for (int tick = 0; tick < 200; ++tick) {
    const std::vector<Vec3> expected = alone.step();
    ASSERT_EQ(together.step(), expected) << "tick " << tick;
    if (tick == 0) {
      EXPECT_NE(expected[3], Vec3::Zero()) << "they meet";
    }
  }
}

TEST(OrganGroup, OneThreadStaysOne) {
  CostlyRow row(1);
  row.step();
  for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(row.mass(i).stepped_on(), std::this_thread::get_id());
}

TEST(OrganGroup, OnSeveralThreadsAStepTakesNoMemory) {
  CostlyRow row(2);
  row.group.step(row.book, kTick_s);
  const std::size_t before = test::heap_allocations();
  for (int tick = 0; tick < 100; ++tick) row.group.step(row.book, kTick_s);
  EXPECT_EQ(test::heap_allocations(), before);
}

TEST_F(OrganGroupTest, AStepTakesNoMemoryAlsoWhereOrgansMeetAndFail) {
  press(0, {20, 0, 0});
  mass(1).push(Vec3(-2 * kMeeting_m_s, 0, 0));
  const std::size_t before = test::heap_allocations();
  for (int tick = 0; tick < 100; ++tick) group_.step(book_, kTick_s);
  EXPECT_EQ(test::heap_allocations(), before);
}

}  // namespace
}  // namespace omentum::deform
