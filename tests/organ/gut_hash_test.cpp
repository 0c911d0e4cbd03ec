#include "organ/gut_hash.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <set>
#include <string>
#include <vector>

namespace omentum::organ {
namespace {

using geometry::GutAnatomy;

TEST(GutHash, EveryNumberOfTheAnatomyIsInIt) {
  const std::vector<std::function<void(GutAnatomy&)>> changes{
      [](GutAnatomy&) {},
      [](GutAnatomy& a) { a.length_m += 1e-6; },
      [](GutAnatomy& a) { a.tube_radius_m += 1e-8; },
      [](GutAnatomy& a) { a.cylinder_radius_m += 1e-8; },
      [](GutAnatomy& a) { a.vessel_length_m += 1e-8; },
      [](GutAnatomy& a) { a.mesentery_thickness_m += 1e-8; },
      [](GutAnatomy& a) { a.fold_pitch_m += 1e-8; },
      [](GutAnatomy& a) { ++a.legs; },
      [](GutAnatomy& a) { ++a.rows; },
      [](GutAnatomy& a) { ++a.columns; },
      [](GutAnatomy& a) { a.origin.z() += 1e-8; },
      [](GutAnatomy& a) { a.along.x() += 1e-8; },
      [](GutAnatomy& a) { a.up.y() += 1e-8; }};
  std::set<std::string> hashes;
  for (const auto& change : changes) {
    GutAnatomy anatomy;
    change(anatomy);
    hashes.insert(gut_hash(anatomy));
  }
  EXPECT_EQ(hashes.size(), changes.size());
}

// A sine or a root in between may end otherwise on another machine.
TEST(GutHash, TheLastBitOfANumberIsNot) {
  GutAnatomy anatomy;
  const std::string hash = gut_hash(anatomy);
  anatomy.length_m = std::nextafter(anatomy.length_m, 5);
  anatomy.up.z() = std::nextafter(1.0, 0);
  anatomy.origin.x() = -0.0;
  EXPECT_EQ(gut_hash(anatomy), hash);
}

// Sums over the places of all masses, m and m^2: whoever changes make_gut() so that they move raises
// kGutVersion with them.
TEST(GutHash, TheVersionIsThatOfTheShapeThatIsMade) {
  constexpr double kRounding = 1e-6;  // of places to a nanometre
  ASSERT_EQ(kGutVersion, 1);
  geometry::Vec3 sum = geometry::Vec3::Zero();
  double of_squares = 0;
  for (const geometry::Vec3& x : geometry::make_gut({}).positions) {
    sum += x;
    of_squares += x.squaredNorm();
  }
  EXPECT_LT((sum - geometry::Vec3(-2.609372353, 0, 9.453159337)).norm(), kRounding);
  EXPECT_NEAR(of_squares, 4.184830954, kRounding);
}

}  // namespace
}  // namespace omentum::organ
