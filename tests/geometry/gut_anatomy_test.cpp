#include "geometry/gut_anatomy.h"

#include "geometry/gut_fit.h"
#include "geometry/gut_intersections.h"
#include "geometry/tetra_mesh.h"

#include "tests/support/effort.h"

#include <gmock/gmock.h>

#include <cmath>
#include <functional>
#include <random>

namespace omentum::geometry {
namespace {

using testing::HasSubstr;

const Vec3& at(const GutShape& gut, MassId m) {
  return gut.positions[static_cast<std::size_t>(m)];
}

double segment_length(const GutShape& gut, std::int32_t i) {
  const auto [a, b] = gut.layout.segment(i);
  return (at(gut, b) - at(gut, a)).norm();
}

GutAnatomy fine_anatomy(std::int32_t columns) {
  GutAnatomy anatomy;
  anatomy.columns = columns;
  return anatomy;
}

TEST(GutAnatomy, IsFourMetresOfEquallySpacedMasses) {
  for (const std::int32_t columns : {100, 237, 1000}) {
    const GutShape gut = make_gut(fine_anatomy(columns));
    ASSERT_EQ(std::ssize(gut.positions), 4 * columns);
    double length = 0;
    for (std::int32_t i = 0; i < gut.layout.segment_count(); ++i) {
      length += segment_length(gut, i);
      EXPECT_NEAR(segment_length(gut, i), 4.0 / (columns - 1), 1e-9) << i;
    }
    EXPECT_NEAR(length, 4, 1e-9);
  }
}

TEST(GutAnatomy, HangsOnAStraightVesselOfTenCentimetresAndHasNoWidthAtItsEnds) {
  const GutShape gut = make_gut({});
  const std::int32_t last = gut.layout.columns - 1, vessel = gut.layout.rows - 1;
  for (std::int32_t row = 0; row < gut.layout.rows; ++row) {
    EXPECT_LT((at(gut, gut.layout.mass(row, 0)) - Vec3(0, 0.05, 0)).norm(), 1e-12);
    EXPECT_LT((at(gut, gut.layout.mass(row, last)) - Vec3(0, -0.05, 0)).norm(), 1e-12);
  }
  for (std::int32_t c = 1; c <= last; ++c) {
    const Vec3 here = at(gut, gut.layout.mass(vessel, c));
    EXPECT_LT(Vec3(here.x(), 0, here.z()).norm(), 1e-12);
    EXPECT_LT(here.y(), at(gut, gut.layout.mass(vessel, c - 1)).y()) << "lines that never cross";
  }
}

// Raghupathi 2004, section 3.1: on a cylinder of 15 cm, its axis the vessel.
TEST(GutAnatomy, LiesOnTheCylinderBetweenItsFirstAndItsLastWay) {
  const GutAnatomy anatomy;
  const GutShape gut = make_gut(anatomy);
  const double lead = GutCurve::least_leg(anatomy.cylinder_radius_m);
  const auto lead_columns = static_cast<std::int32_t>(lead / segment_length(gut, 0)) + 1;
  for (std::int32_t c = 0; c < gut.layout.columns; ++c) {
    const Vec3 p = at(gut, gut.layout.mass(0, c));
    const double radius = std::hypot(p.x(), p.z());
    EXPECT_LT(radius, anatomy.cylinder_radius_m + 1e-9);
    if (c >= lead_columns && c + lead_columns < gut.layout.columns) {
      EXPECT_NEAR(radius, anatomy.cylinder_radius_m, 1e-9) << c;
    }
  }
}

TEST(GutAnatomy, RowsDivideTheLinesFromTheGutToTheVessel) {
  GutAnatomy anatomy;
  anatomy.rows = 6;
  const GutShape gut = make_gut(anatomy);
  for (std::int32_t c = 0; c < gut.layout.columns; ++c) {
    const Vec3 gut_place = at(gut, gut.layout.mass(0, c)), on_vessel = at(gut, gut.layout.mass(5, c));
    for (std::int32_t row = 1; row < 5; ++row) {
      const Vec3 expected = gut_place + row / 5.0 * (on_vessel - gut_place);
      EXPECT_LT((at(gut, gut.layout.mass(row, c)) - expected).norm(), 1e-12);
    }
  }
}

// The circle through three near points of the curve.
double bend_radius(const Vec3& a, const Vec3& b, const Vec3& c) {
  const double twice_area = (b - a).cross(c - a).norm();
  return (b - a).norm() * (c - b).norm() * (a - c).norm() / (2 * twice_area);
}

TEST(GutAnatomy, NoBendIsTighterThanTheTube) {
  GutAnatomy anatomy;
  for (const double pitch : {GutCurve::least_pitch(anatomy.tube_radius_m), anatomy.fold_pitch_m}) {
    GutFolds folds{anatomy.cylinder_radius_m, pitch, anatomy.vessel_length_m, 0.08, anatomy.legs, 0.5};
    const GutCurve curve(folds);
    constexpr double kStep = 1e-4;  // m
    double tightest = 1;
    for (double u = kStep; u + kStep < curve.length_m(); u += kStep)
      tightest =
          std::min(tightest, bend_radius(curve.point(u - kStep), curve.point(u), curve.point(u + kStep)));
    EXPECT_GT(tightest, anatomy.tube_radius_m * (1 - 1e-4)) << pitch;
  }
}

TEST(GutAnatomy, ByDefaultNoPartsOverlap) {
  for (const std::int32_t columns : {100, 150, test::tried(1000)}) {
    const GutShape gut = make_gut(fine_anatomy(columns));
    const GutReach free = smallest_distances(gut), reach = reach_of(gut);
    EXPECT_TRUE(all_overlaps(gut).empty()) << columns;
    EXPECT_GE(free.tube_m, reach.tube_m);
    EXPECT_GE(free.mesentery_m, reach.mesentery_m);
  }
}

// What the generator lets through is free of overlaps; it lets through what it should.
TEST(GutAnatomy, OnAGridOfNumbersEveryGutIsFreeOrRefused) {
  constexpr int kGrid = 3 * 2 * 3 * 5;
  int number = 0, made = 0, refused = 0;
  for (const double length : {2.5, 4.0, 6.0})
    for (const double tube : {0.012, 0.02})
      for (const double cylinder : {0.12, 0.15, 0.2})
        for (const std::int32_t legs : {4, 5, 6, 7, 9}) {
          if (number++ % (kGrid / test::tried(kGrid)) != 0) continue;
          GutAnatomy a;
          a.length_m = length, a.tube_radius_m = tube, a.cylinder_radius_m = cylinder, a.legs = legs;
          a.columns = 151;
          try {
            EXPECT_TRUE(all_overlaps(make_gut(a)).empty()) << length << " " << tube << " " << legs;
            ++made;
          } catch (const InputError&) {
            ++refused;
          }
        }
  EXPECT_GT(made, test::tried(25));
  EXPECT_GT(refused, test::tried(10));
}

TEST(GutAnatomy, LiesWhereItIsPlaced) {
  const GutShape rest = make_gut({});
  GutAnatomy placed;
  placed.origin = {0.1, -0.3, 0.2};
  placed.along = {1, 2, 0};
  placed.up = {0.3, 0, 2};  // need not be across: its part across `along` counts
  const GutShape gut = make_gut(placed);
  const auto vessel = [](const GutShape& g) {
    return Vec3(at(g, g.layout.mass(3, g.layout.columns - 1)) - at(g, g.layout.mass(3, 0)));
  };
  EXPECT_LT((vessel(gut) - 0.1 * placed.along.normalized()).norm(), 1e-12);
  for (std::size_t i = 0; i + 1 < gut.positions.size(); ++i)
    EXPECT_NEAR((gut.positions[i + 1] - gut.positions[i]).norm(),
                (rest.positions[i + 1] - rest.positions[i]).norm(), 1e-12);
  Vec3 mean = Vec3::Zero();
  for (const Vec3& p : gut.positions) mean += (p - placed.origin) / std::ssize(gut.positions);
  EXPECT_GT(mean.dot(placed.up), 0) << "the folds lie on the side of `up`";
}

TEST(GutAnatomy, FourGutsLieInOneCavityByTheirPlacement) {
  std::vector<Eigen::AlignedBox3d> boxes;
  for (const double x : {-0.18, 0.18}) {
    for (const double y : {-0.16, 0.16}) {
      GutAnatomy anatomy = fine_anatomy(1000);
      anatomy.origin = {x, y, 0};
      const GutShape gut = make_gut(anatomy);
      Eigen::AlignedBox3d box;
      for (const Vec3& p : gut.positions) {
        box.extend(p + Vec3::Constant(gut.tube_radius_m));
        box.extend(p - Vec3::Constant(gut.tube_radius_m));
      }
      for (const auto& other : boxes) EXPECT_TRUE(box.intersection(other).isEmpty());
      boxes.push_back(box);
    }
  }
}

TEST(GutAnatomy, OnePassThroughAnotherFoldIsFoundByBothChecks) {
  GutShape gut = make_gut({});
  const MassId moved = gut.layout.mass(0, 40);
  // the place of the axis that is nearest and far enough along the gut
  std::int32_t nearest = 0;
  double least = 1;
  for (std::int32_t i = 0; i < gut.layout.segment_count(); ++i) {
    const double d = distance_of_segments(gut.layout, gut.positions, 40, i);
    if (std::abs(i - 40) > 5 && d < least) least = d, nearest = i;
  }
  const Vec3 way = at(gut, gut.layout.mass(0, nearest)) - at(gut, moved);
  gut.positions[static_cast<std::size_t>(moved)] += 1.3 * way;
  const GutOverlaps all = all_overlaps(gut), found = find_overlaps(gut);
  EXPECT_FALSE(all.tube.empty());
  EXPECT_FALSE(all.mesentery.empty());
  EXPECT_EQ(found.tube.size(), all.tube.size());
  EXPECT_EQ(found.mesentery.size(), all.mesentery.size());
}

TEST(GutAnatomy, BoxesFindWhatEveryPairFinds) {
  std::mt19937 random(3);
  std::normal_distribution<double> shake(0, 0.01);  // m
  for (const std::int32_t columns : {100, 311}) {
    GutShape gut = make_gut(fine_anatomy(columns));
    for (Vec3& p : gut.positions) p += Vec3(shake(random), shake(random), shake(random));
    const GutOverlaps all = all_overlaps(gut), found = find_overlaps(gut);
    EXPECT_GT(all.tube.size(), 10u);
    EXPECT_GT(all.mesentery.size(), 10u);
    const auto same = [](const std::vector<GutOverlap>& a, const std::vector<GutOverlap>& b) {
      return std::ranges::equal(a, b, [](const GutOverlap& x, const GutOverlap& y) {
        return x.segment == y.segment && x.other == y.other && x.distance_m == y.distance_m;
      });
    };
    EXPECT_TRUE(same(all.tube, found.tube));
    EXPECT_TRUE(same(all.mesentery, found.mesentery));
  }
}

TEST(GutNeighbourhood, WhatHangsTogetherWithinHalfATurnNeverTouches) {
  const GutNeighbourhood coarse = neighbourhood(make_gut({}));
  EXPECT_EQ(coarse.columns_apart, 3);
  EXPECT_FALSE(coarse.may_touch(10, 12));
  EXPECT_TRUE(coarse.may_touch(10, 13));
  EXPECT_TRUE(coarse.may_touch(13, 10));
  // pi r = 62.8 mm: 16 segments of 4.004 mm lie between them
  EXPECT_EQ(neighbourhood(make_gut(fine_anatomy(1000))).columns_apart, 17);
  const GutLayout layout{4, 100};
  EXPECT_EQ(segment_above(layout, 0), 0);
  EXPECT_EQ(segment_above(layout, 2 * (99 + 7) + 1), 7);
  EXPECT_EQ(exhaustive_tests(layout, coarse), 96 * 97 / 2 + 96 * 97 * 6);
}

struct Impossible {
  const char* name;
  std::function<void(GutAnatomy&)> change;
  const char* message;
};

void PrintTo(const Impossible& impossible, std::ostream* out) {
  *out << impossible.name;
}

class ImpossibleAnatomy : public testing::TestWithParam<Impossible> {};

TEST_P(ImpossibleAnatomy, IsRefusedWithTheKeyAndWhatWouldBePossible) {
  GutAnatomy anatomy;
  GetParam().change(anatomy);
  try {
    make_gut(anatomy);
    ADD_FAILURE() << "no exception";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr(GetParam().message));
  }
}

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

INSTANTIATE_TEST_SUITE_P(
    Keys, ImpossibleAnatomy,
    testing::Values(
        Impossible{"Length", [](GutAnatomy& a) { a.length_m = 0; },
                   "length_m = 0: expected a length above 0"},
        Impossible{"LengthNan", [](GutAnatomy& a) { a.length_m = kNaN; }, "length_m = nan: expected"},
        Impossible{"Tube", [](GutAnatomy& a) { a.tube_radius_m = -0.01; }, "tube_radius_m = -0.01: expected"},
        Impossible{"Cylinder", [](GutAnatomy& a) { a.cylinder_radius_m = 0.03; },
                   "cylinder_radius_m = 0.03: expected more than two radii of the tube, 0.04"},
        Impossible{"Vessel", [](GutAnatomy& a) { a.vessel_length_m = 0; }, "vessel_length_m = 0: expected"},
        Impossible{"Thickness", [](GutAnatomy& a) { a.mesentery_thickness_m = -1; },
                   "mesentery_thickness_m = -1: expected 0 or more"},
        Impossible{"Turn", [](GutAnatomy& a) { a.fold_pitch_m = 0.04; },
                   "fold_pitch_m = 0.04: expected at least 0.04658: turns would be tighter than the tube"},
        Impossible{"Rows", [](GutAnatomy& a) { a.rows = 1; }, "rows = 1: expected 2 to 100"},
        Impossible{"Columns", [](GutAnatomy& a) { a.columns = 60; }, "columns = 60: expected 81 to 100000"},
        Impossible{"Legs", [](GutAnatomy& a) { a.legs = 2; }, "legs = 2: expected 3 to 1000"},
        Impossible{"FewLegs", [](GutAnatomy& a) { a.legs = 4; },
                   "legs = 4: to hold 4 m they reach 200 degrees to both sides"},
        Impossible{"ManyLegs", [](GutAnatomy& a) { a.legs = 20; }, "legs = 20: a gut of 4 m is too short"},
        Impossible{"Origin", [](GutAnatomy& a) { a.origin.x() = kNaN; }, "origin: expected finite numbers"},
        Impossible{"Parallel", [](GutAnatomy& a) { a.up = 2 * a.along; }, "along and up: expected"},
        Impossible{"Thick", [](GutAnatomy& a) { a.mesentery_thickness_m = 0.1; },
                   "the gut's folds overlap: segment 0 and the mesentery's triangle"}),
    [](const auto& info) { return info.param.name; });

}  // namespace
}  // namespace omentum::geometry
