#include "physics/intestine/gut_springs.h"

#include "geometry/precondition.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace omentum::physics {

namespace {

using geometry::GutShape;
using geometry::MassId;
using geometry::Vec3;

constexpr double kDiagonalShare =
    0.25;  // of a diagonal in its own direction: half of the tension of long cells
constexpr double kShortest_m =
    1e-9;  // two masses nearer than this are in one place: no spring has a direction

void expect(bool holds, const char* member, const char* expected) {
  if (!holds) throw std::invalid_argument(std::string(member) + ": expected " + expected);
}

void expect_positive(double value, const char* member) {
  expect(std::isfinite(value) && value > 0, member, "a number above 0");
}

const Vec3& at(const GutShape& shape, MassId m) {
  return shape.positions[static_cast<std::size_t>(m)];
}

double distance(const GutShape& shape, MassId a, MassId b) {
  return (at(shape, a) - at(shape, b)).norm();
}

double triangle_area(const GutShape& shape, const std::array<MassId, 3>& t) {
  return 0.5 * (at(shape, t[1]) - at(shape, t[0])).cross(at(shape, t[2]) - at(shape, t[0])).norm();
}

std::size_t columns(const geometry::GutLayout& layout) {
  return static_cast<std::size_t>(layout.columns);
}

Vec3 direction_of(const Vec3& d) {
  const double length = d.norm();
  return length > 0 ? Vec3(d / length) : Vec3::Zero();
}

}  // namespace

void check(const GutMaterial& material) {
  expect_positive(material.gut_mass_kg_m, "gut_mass_kg_m");
  expect_positive(material.gut_stretch_n, "gut_stretch_n");
  expect_positive(material.mesentery_mass_kg_m2, "mesentery_mass_kg_m2");
  expect_positive(material.mesentery_stretch_n_m, "mesentery_stretch_n_m");
  const auto expect_not_below = [](double value, const char* member) {
    expect(std::isfinite(value) && value >= 0, member, "a number not below 0");
  };
  expect_not_below(material.gut_bending_n_m2, "gut_bending_n_m2");
  expect_not_below(material.spring_damping_s, "spring_damping_s");
  expect(material.calming_time_s > 0, "calming_time_s", "a number above 0");
}

GutSprings::GutSprings(const GutShape& shape, const GutMaterial& material)
    : layout_(shape.layout), damping_s_(material.spring_damping_s), drag_per_s_(1 / material.calming_time_s) {
  check(material);
  expect(layout_.rows >= 2 && layout_.columns >= 4, "layout", "two rows and four columns at least");
  expect(shape.positions.size() == static_cast<std::size_t>(layout_.mass_count()), "positions",
         "one for each mass");
  const std::array offsets{1, layout_.columns, layout_.columns + 1, layout_.columns - 1};
  for (std::size_t i = 0; i < families_.size(); ++i) {
    families_[i] = {offsets[i], std::vector<double>(shape.positions.size()),
                    std::vector<double>(shape.positions.size())};
  }
  lay_gut(shape, material);
  for (std::int32_t r = 0; r + 1 < layout_.rows; ++r) {
    for (std::int32_t c = 0; c + 1 < layout_.columns; ++c)
      lay_cell(shape, material.mesentery_stretch_n_m, r, c);
  }
  weigh(shape, material);
}

void GutSprings::lay_gut(const GutShape& shape, const GutMaterial& material) {
  bends_ = {std::vector<double>(columns(layout_)), std::vector<double>(columns(layout_))};
  double last_m = 0;
  for (std::int32_t c = 0; c + 1 < layout_.columns; ++c) {
    const auto [from, to] = layout_.segment(c);
    const double a = distance(shape, from, to);
    expect(a > kShortest_m, "positions", "no two of the gut's axis in one place");
    add(shape, kAlong, from, material.gut_stretch_n / a);
    if (c > 0) {
      const Vec3 middle = 0.5 * (at(shape, layout_.mass(0, c - 1)) + at(shape, to));
      bends_.stiffness_n_m[static_cast<std::size_t>(c)] =
          4 * material.gut_bending_n_m2 / std::pow(0.5 * (a + last_m), 3);
      bends_.rest_m[static_cast<std::size_t>(c)] = (middle - at(shape, from)).norm();
    }
    last_m = a;
  }
}

void GutSprings::add(const GutShape& shape, Direction direction, MassId from, double stiffness) {
  GutSpringFamily& family = families_[direction];
  const MassId to(from + family.offset);
  if (layout_.is_held(from) && layout_.is_held(to)) return;
  family.stiffness_n_m[static_cast<std::size_t>(from)] += stiffness;
  family.rest_m[static_cast<std::size_t>(from)] = distance(shape, from, to);
}

// A cell of a membrane, a long and b wide, as springs: under strain along (or across) alone its sides and
// diagonals together hold the membrane's energy Y a b strain^2 / 2, whatever the cell's proportions.
void GutSprings::lay_cell(const GutShape& shape, double stretch_n_m, std::int32_t row, std::int32_t column) {
  const MassId near[2] = {layout_.mass(row, column), layout_.mass(row, column + 1)};
  const MassId far[2] = {layout_.mass(row + 1, column), layout_.mass(row + 1, column + 1)};
  const double a = 0.5 * (distance(shape, near[0], near[1]) + distance(shape, far[0], far[1]));
  const double b = 0.5 * (distance(shape, near[0], far[0]) + distance(shape, near[1], far[1]));
  if (a < kShortest_m || b < kShortest_m) return;
  // nothing of a sheet bends and stretches within its own thickness: so no cell is stiffer across than that
  const double wide = std::max(b, shape.mesentery_thickness_m);
  const double square = a * a + b * b;
  const double diagonal = kDiagonalShare * stretch_n_m * a * b / square;
  const auto side = [&](double length, double other) {
    return 0.5 * stretch_n_m * other / length *
           (1 - 2 * kDiagonalShare * std::pow(length * length / square, 2));
  };
  add(shape, kAlong, near[0], side(a, b));
  add(shape, kAlong, far[0], side(a, b));
  add(shape, kAcross, near[0], side(b, a) * b / wide);
  add(shape, kAcross, near[1], side(b, a) * b / wide);
  add(shape, kFalling, near[0], diagonal);
  add(shape, kRising, near[1], diagonal);
}

void GutSprings::weigh(const GutShape& shape, const GutMaterial& material) {
  mass_.assign(shape.positions.size(), 0);
  for (std::int32_t i = 0; i < layout_.segment_count(); ++i) {
    const auto [a, b] = layout_.segment(i);
    for (const MassId m : {a, b})
      mass_[static_cast<std::size_t>(m)] += 0.5 * material.gut_mass_kg_m * distance(shape, a, b);
  }
  for (std::int32_t t = 0; t < layout_.triangle_count(); ++t) {
    const double third = material.mesentery_mass_kg_m2 * triangle_area(shape, layout_.triangle(t)) / 3;
    for (const MassId m : layout_.triangle(t)) mass_[static_cast<std::size_t>(m)] += third;
  }
  inverse_mass_.assign(mass_.size(), 0);
  for (std::int32_t m = 0; m < layout_.mass_count(); ++m) {
    const auto i = static_cast<std::size_t>(m);
    const bool held = layout_.is_held(MassId(m));
    expect(held || mass_[i] > 0, "positions", "some area of the mesentery at each mass that is not held");
    if (!held) inverse_mass_[i] = 1 / mass_[i];
    // at an end without width there is no sheet; what is held there moves by no equation, but is a mass
    if (mass_[i] == 0) mass_[i] = mass_[0];
  }
}

void GutSprings::forces(std::span<const Vec3> x, std::span<const Vec3> v, std::span<Vec3> f) const noexcept {
  geometry::require(x.size() == mass_.size() && v.size() == x.size() && f.size() == x.size(),
                    "a value for each mass");
  std::fill(f.begin(), f.end(), Vec3::Zero());
  const auto pull = [this](double k, double rest, const Vec3& d, const Vec3& rate) -> Vec3 {
    const Vec3 n = direction_of(d);
    return k * (n.dot(d) - rest + damping_s_ * n.dot(rate)) * n;
  };
  for (const auto& [offset, stiffness, rest] : families_) {
    for (std::size_t a = 0; a < x.size(); ++a) {
      if (stiffness[a] == 0) continue;
      const std::size_t b = a + static_cast<std::size_t>(offset);
      const Vec3 on_a = pull(stiffness[a], rest[a], x[b] - x[a], v[b] - v[a]);
      f[a] += on_a;
      f[b] -= on_a;
    }
  }
  for (std::size_t c = 1; c + 1 < columns(layout_); ++c) {
    const Vec3 on_middle = pull(bends_.stiffness_n_m[c], bends_.rest_m[c], 0.5 * (x[c - 1] + x[c + 1]) - x[c],
                                0.5 * (v[c - 1] + v[c + 1]) - v[c]);
    f[c] += on_middle;
    f[c - 1] -= 0.5 * on_middle;
    f[c + 1] -= 0.5 * on_middle;
  }
}

double GutSprings::energy(std::span<const Vec3> x) const noexcept {
  const auto of = [](double k, double stretch) { return 0.5 * k * stretch * stretch; };
  double sum = 0;
  for (const auto& [offset, stiffness, rest] : families_) {
    for (std::size_t a = 0; a < x.size(); ++a) {
      if (stiffness[a] > 0)
        sum += of(stiffness[a], (x[a + static_cast<std::size_t>(offset)] - x[a]).norm() - rest[a]);
    }
  }
  for (std::size_t c = 1; c + 1 < columns(layout_); ++c) {
    sum += of(bends_.stiffness_n_m[c], (0.5 * (x[c - 1] + x[c + 1]) - x[c]).norm() - bends_.rest_m[c]);
  }
  return sum;
}

double kinetic_energy(const GutSprings& springs, std::span<const Vec3> v) noexcept {
  double sum = 0;
  for (std::size_t i = 0; i < v.size(); ++i) sum += 0.5 * springs.mass()[i] * v[i].squaredNorm();
  return sum;
}

}  // namespace omentum::physics
