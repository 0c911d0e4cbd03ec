// The strain that an intestine and its mesentery tell.
#include "deform_node/gut_gauge.h"

#include "tests/deform_node/gut_stage.h"
#include "tests/deform_node/read_stress.h"
#include "tests/support/heap_count.h"

#include <gmock/gmock.h>

namespace omentum::deform {
namespace {

using geometry::MassId;
using ::testing::Each;
using ::testing::FloatEq;
using ::testing::FloatNear;
using ::testing::IsEmpty;
using ::testing::Pointwise;
using ::testing::SizeIs;

// Places below a metre in single precision, told apart over segments of a centimetre at the ends.
constexpr float kFloat = 2e-5F;

class GutGaugeTest : public testing::Test {
 protected:
  template <class Place>
  std::vector<float> strain_of(Place&& place) {
    for (std::size_t m = 0; m < rest_.positions.size(); ++m)
      Eigen::Map<Eigen::Vector3f>(shape_.state.values.data() + 3 * m) =
          Vec3(place(rest_.positions[m])).cast<float>();
    std::vector<float> strain(rest_.positions.size(), -1);
    gauge_.measure(shape_, strain, {});
    return strain;
  }
  bool is_end(std::size_t m) const {
    const auto column = rest_.layout.column(MassId(m));
    return column == 0 || column == rest_.layout.columns - 1;
  }

  const geometry::GutShape& rest_ = small_gut();
  GutGauge gauge_{rest_};
  StrainedShape shape_{{.values = 3 * rest_.positions.size()}};
};

TEST_F(GutGaugeTest, ARigidMotionHasNone) {
  const Eigen::Matrix3d R = Eigen::AngleAxisd(2.3, Vec3(1, -2, 0.5).normalized()).toRotationMatrix();
  EXPECT_THAT(strain_of([&](const Vec3& x) -> Vec3 { return R * x + Vec3(0.1, 0.2, -0.1); }),
              Each(FloatNear(0, kFloat)));
}

TEST_F(GutGaugeTest, WhatGrowsEverywhereIsLongerEverywhere) {
  const std::vector<float> strain = strain_of([](const Vec3& x) -> Vec3 { return 1.2 * x; });
  for (std::size_t m = 0; m < strain.size(); ++m) {
    if (!is_end(m)) {
      EXPECT_NEAR(strain[m], 0.2, kFloat) << "mass " << m;
    }
  }
}

TEST_F(GutGaugeTest, TheEndsWithoutAreaTellNothingThatIsNotThere) {
  const std::vector<float> strain = strain_of([](const Vec3& x) -> Vec3 { return 0.8 * x; });
  for (std::size_t m = 0; m < strain.size(); ++m) {
    EXPECT_GE(strain[m], -0.2F - kFloat) << "mass " << m;
    EXPECT_LE(strain[m], kFloat) << "mass " << m;
  }
}

TEST_F(GutGaugeTest, AGutThatIsPulledAlongItselfIsStretchedThere) {
  // one segment twice as long: half of it counts at both of its masses; the mesentery is stretched less
  const MassId from = rest_.layout.mass(0, 19), to = rest_.layout.mass(0, 20);
  const Vec3 along = rest_.positions[to] - rest_.positions[from];
  const std::vector<float> before = strain_of([](const Vec3& x) -> Vec3 { return x; });
  const std::vector<float> strain =
      strain_of([&](const Vec3& x) -> Vec3 { return x == rest_.positions[to] ? Vec3(x + along) : x; });
  const auto length = [&](int i) {
    const auto [a, b] = rest_.layout.segment(i);
    return (rest_.positions[b] - rest_.positions[a]).norm();
  };
  const double elongation = length(19) / (length(18) + length(19));
  EXPECT_NEAR(before[19], 0, kFloat);
  EXPECT_GE(strain[19], elongation - kFloat);
  EXPECT_NEAR(strain[5], 0, kFloat) << "far from it";
}

TEST_F(GutGaugeTest, AMesenteryThatIsPulledTellsItsOwnStrain) {
  // the axis away from the vessel: cells of the first row are longer across, the gut is as long as before
  const geometry::GutLayout& layout = rest_.layout;
  const MassId axis = layout.mass(0, 20), below = layout.mass(1, 20), above_vessel = layout.mass(2, 20);
  const Vec3 away = rest_.positions[axis] - rest_.positions[below];
  const std::vector<float> strain = strain_of([&](const Vec3& x) -> Vec3 {
    const bool is_axis = std::ranges::find(rest_.positions, x) - rest_.positions.begin() < layout.columns;
    return is_axis ? Vec3(x + 0.5 * away) : x;
  });
  EXPECT_GT(strain[below], 0.1F);
  EXPECT_GT(strain[axis], strain[above_vessel]);
}

TEST_F(GutGaugeTest, MeasuringTakesNoMemory) {
  std::vector<float> strain(rest_.positions.size());
  const std::size_t before = test::heap_allocations();
  gauge_.measure(shape_, strain, {});
  EXPECT_EQ(test::heap_allocations(), before);
}

TEST_F(GutGaugeTest, AGutThatHangsTellsItsStrainMassByMassAndNoStress) {
  std::vector<ServedOrgan> organs(1);
  organs[0].model = std::make_unique<GutModel>(gut_model({.gravity_m_s2 = {0, 0, -9.81}}));
  for (int tick = 0; tick < 50; ++tick) organs[0].model->step({}, kGutTick_s);
  ReadMessages written;
  written.readers = 1;
  StressPublisher publisher(written, organs, 1000, 1 / kGutTick_s, work_at_once);
  for (std::uint64_t seq = 1; seq <= 2; ++seq) publisher.offer({.seq = seq});
  ASSERT_THAT(written.all(), SizeIs(1));
  const msg::OrganStress told = written.all()[0];
  EXPECT_EQ(3 * told.node_count, organs[0].model->view().values.size());
  EXPECT_THAT(told.stresses, IsEmpty());
  shape_.take(organs[0].model->view());
  std::vector<float> expected(rest_.positions.size());
  gauge_.measure(shape_, expected, {});
  EXPECT_THAT(told.strains, Pointwise(FloatEq(), expected));
  EXPECT_GT(*std::ranges::max_element(told.strains), 0.01F);
}

}  // namespace
}  // namespace omentum::deform
