// Strain and stress of organs, measured beside the loop and only while somebody reads them.
#include "deform_node/strain_gauges.h"

#include "tests/deform_node/deform_toy.h"
#include "tests/deform_node/dynamic_beam.h"
#include "tests/deform_node/rates.h"
#include "tests/deform_node/read_stress.h"
#include "tests/support/heap_count.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace omentum::deform {
namespace {

using ::testing::AllOf;
using ::testing::Each;
using ::testing::Field;
using ::testing::FloatEq;
using ::testing::IsEmpty;
using ::testing::Pointwise;
using ::testing::SizeIs;

constexpr std::int32_t kNodesInABlock = 1000;  // to a block

class StressPublisherTest : public DynamicModelTest {
 protected:
  void serve(DynamicParts parts) {
    organs_.emplace_back().model = std::make_unique<DynamicModel>(std::move(parts));
  }
  static DynamicParts sagging(DynamicParts parts, physics::StressLaw law) {
    parts.gravity_m_s2 = Vec3(0, 0, -9.81);
    parts.stress = law;
    return parts;
  }
  DynamicModel& model() { return static_cast<DynamicModel&>(*organs_[0].model); }
  /// On this thread, within wake().
  StressPublisher make_publisher(std::int32_t nodes_per_block = kNodesInABlock) {
    return {written_, organs_, nodes_per_block, kRate_hz, work_at_once};
  }
  /// What a state's gauge has to say of the model as it is.
  std::pair<std::vector<float>, std::vector<float>> measured(physics::StressLaw law) {
    const OrganView view = model().view();
    std::vector<float> strain(view.surface.size()), stress(view.surface.size());
    physics::NodalStress(mesh_, material_, law)
        .measure({view.body_u, view.removed_bits, view.surface}, strain, stress);
    return {strain, stress};
  }

  std::vector<ServedOrgan> organs_;
  ReadMessages written_;
};

TEST_F(StressPublisherTest, ABodyIsToldInItsStatesOrderAndWithItsNumbers) {
  serve(sagging(parts(), physics::StressLaw::kLinear));
  pass(model(), 0.5);
  written_.readers = 1;
  StressPublisher publisher = make_publisher();
  publisher.offer({.seq = 6, .stamp_ns = 60});
  EXPECT_THAT(written_.all(), IsEmpty()) << "only now it is known that somebody reads";
  publisher.offer({.seq = 7, .stamp_ns = 70});
  ASSERT_THAT(written_.all(), SizeIs(1));
  const msg::OrganStress told = written_.all()[0];
  EXPECT_EQ(told.seq, 7u);
  EXPECT_EQ(told.stamp_ns, 70);
  EXPECT_EQ(told.topology_version, 0u);
  EXPECT_EQ(3 * told.node_count, model().view().values.size());
  const auto [strain, stress] = measured(physics::StressLaw::kLinear);
  EXPECT_THAT(told.strains, Pointwise(FloatEq(), strain));
  EXPECT_THAT(told.stresses, Pointwise(FloatEq(), stress));
  EXPECT_GT(*std::ranges::max_element(told.strains), 0.01F);
  EXPECT_EQ(publisher.measured(), 1u);
}

TEST_F(StressPublisherTest, ABarThatHangsHasInItsMiddleTheWeightBelowOverItsArea) {
  DynamicParts hanging = sagging(parts(), physics::StressLaw::kLinear);
  hanging.gravity_m_s2 = Vec3(9.81, 0, 0);  // along it
  serve(std::move(hanging));
  pass(model(), 3);
  const std::vector<float> stress = measured(physics::StressLaw::kLinear).second;
  double sum = 0;
  int count = 0;
  for (std::size_t s = 0; s < stress.size(); ++s) {
    if (std::abs(mesh_.positions[surface_.node[s]].x() - kLength_m / 2) > 1e-9) continue;
    sum += static_cast<double>(stress[s]);
    ++count;
  }
  ASSERT_GT(count, 0);
  const double expected_pa = kTissue.density_kg_m3 * 9.81 * kLength_m / 2;
  EXPECT_NEAR(sum / count, expected_pa, 0.03 * expected_pa) << "six elements along it";
}

TEST_F(StressPublisherTest, ACutBodyIsToldAsItsNewStatesNumberItsNodes) {
  serve(sagging(parts(), physics::StressLaw::kLinear));
  pass(model(), 0.2);
  const CutStroke stroke = stroke_at(0.6 * kLength_m);
  model().step({.presses = {}, .cuts = {&stroke, 1}}, kTick_s);
  written_.readers = 1;
  StressPublisher publisher = make_publisher();
  for (std::uint64_t seq = 1; seq <= 2; ++seq) publisher.offer({.seq = seq});
  ASSERT_THAT(written_.all(), SizeIs(1));
  const msg::OrganStress told = written_.all()[0];
  EXPECT_GT(told.topology_version, 0u);
  EXPECT_EQ(told.node_count, model().view().surface.size());
  EXPECT_THAT(told.strains, Pointwise(FloatEq(), measured(physics::StressLaw::kLinear).first));
}

TEST_F(StressPublisherTest, SmallBlocksCoverEveryNodeOnce) {
  serve(sagging(parts(), physics::StressLaw::kTurned));
  written_.readers = 1;
  StressPublisher publisher = make_publisher(30);
  for (std::uint64_t seq = 1; seq <= 2; ++seq) publisher.offer({.seq = seq});
  std::size_t next = 0;
  for (const msg::OrganStress& block : written_.all()) {
    EXPECT_EQ(block.first, next);
    EXPECT_EQ(block.block_count, written_.all().size());
    EXPECT_EQ(block.strains.size(), block.stresses.size());
    next += block.strains.size();
  }
  EXPECT_EQ(next, model().view().surface.size());
}

TEST_F(StressPublisherTest, SpringsHaveNoStress) {
  serve(sagging(parts(), physics::StressLaw::kNone));
  written_.readers = 1;
  StressPublisher publisher = make_publisher();
  for (std::uint64_t seq = 1; seq <= 2; ++seq) publisher.offer({.seq = seq});
  EXPECT_THAT(written_.all(), Each(AllOf(Field(&msg::OrganStress::stresses, IsEmpty()),
                                         Field(&msg::OrganStress::strains, Not(IsEmpty())))));
}

TEST_F(StressPublisherTest, NothingIsMeasuredWhileNobodyReads) {
  serve(parts());
  StressPublisher publisher = make_publisher();
  const auto tick = [&](int count) {
    for (int i = 0; i < count; ++i) publisher.offer({});
  };
  tick(100);
  EXPECT_EQ(publisher.measured(), 0u);
  written_.readers = 2;
  tick(100);
  EXPECT_NEAR(static_cast<double>(publisher.measured()), 100, kRate_hz / 10);
  written_.readers = 0;
  tick(100);
  EXPECT_LE(publisher.measured(), 100u);
}

TEST_F(StressPublisherTest, AModelWithoutAGaugeTellsNothing) {
  organs_.push_back(deform_test::hanging_organ("toy"));
  written_.readers = 1;
  StressPublisher publisher = make_publisher();
  for (int i = 0; i < 3; ++i) publisher.offer({});
  EXPECT_THAT(written_.all(), IsEmpty());
}

TEST_F(StressPublisherTest, OfferingTakesNoMemoryInTheLoop) {
  serve(parts());
  struct AtFirst final : runtime::WokenWork {
    explicit AtFirst(const std::function<void()>& work) { work(); }
    void wake() noexcept override {}
  };
  written_.readers = 1;
  StressPublisher publisher(
      written_, organs_, kNodesInABlock, kRate_hz,
      [](const std::function<void()>& work) { return std::make_unique<AtFirst>(work); });
  const std::size_t before = test::heap_allocations();
  for (int i = 0; i < 20; ++i) publisher.offer({});
  EXPECT_EQ(test::heap_allocations(), before);
}

}  // namespace
}  // namespace omentum::deform
