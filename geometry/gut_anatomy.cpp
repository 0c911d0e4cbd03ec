#include "geometry/gut_anatomy.h"

#include "geometry/gut_fit.h"
#include "geometry/gut_intersections.h"
#include "geometry/tetra_mesh.h"

#include <cmath>
#include <cstdio>
#include <numbers>

namespace omentum::geometry {
namespace {

constexpr double kPi = std::numbers::pi;

// Of the gut at each end, over which the mesentery takes a wide share of the vessel: a little more than what
// of the tube is too near along the gut to count (GutNeighbourhood).
constexpr double kLeadRadii = 4;

template <class... Values>
std::string text(const char* format, Values... values) {
  char line[300];
  std::snprintf(line, sizeof line, format, values...);
  return line;
}

void expect(bool holds, const char* key, double value, const std::string& expected) {
  if (!holds) throw InputError(text("%s = %g: expected ", key, value) + expected);
}

void check_sizes(const GutAnatomy& a) {
  expect(a.length_m > 0 && std::isfinite(a.length_m), "length_m", a.length_m, "a length above 0");
  expect(a.tube_radius_m > 0 && std::isfinite(a.tube_radius_m), "tube_radius_m", a.tube_radius_m,
         "a radius above 0");
  expect(a.cylinder_radius_m > 2 * a.tube_radius_m && std::isfinite(a.cylinder_radius_m), "cylinder_radius_m",
         a.cylinder_radius_m, text("more than two radii of the tube, %g", 2 * a.tube_radius_m));
  expect(a.vessel_length_m > 0 && std::isfinite(a.vessel_length_m), "vessel_length_m", a.vessel_length_m,
         "a length above 0");
  expect(a.mesentery_thickness_m >= 0 && std::isfinite(a.mesentery_thickness_m), "mesentery_thickness_m",
         a.mesentery_thickness_m, "0 or more");
  expect(a.rows >= 2 && a.rows <= 100, "rows", a.rows, "2 to 100");
  expect(a.legs >= 3 && a.legs <= 1000, "legs", a.legs, "3 to 1000");
}

void check_folds(const GutAnatomy& a) {
  const double least = GutCurve::least_pitch(a.tube_radius_m);
  expect(a.fold_pitch_m >= least && std::isfinite(a.fold_pitch_m), "fold_pitch_m", a.fold_pitch_m,
         text("at least %.4g: turns would be tighter than the tube of radius %g", least, a.tube_radius_m));
  const double fewest = 1 + std::ceil(a.length_m / a.fold_pitch_m);
  expect(a.columns >= fewest && a.columns <= 100000, "columns", a.columns,
         text("%.0f to 100000: masses at most fold_pitch_m = %g apart", fewest, a.fold_pitch_m));
}

void check_placement(const GutAnatomy& a) {
  if (!a.origin.allFinite()) throw InputError("origin: expected finite numbers");
  const double across = a.along.cross(a.up).norm();
  if (!(across > 1e-6 * a.along.norm() * a.up.norm()) || !std::isfinite(across))
    throw InputError("along and up: expected two directions that are not parallel");
}

GutFolds folds_of(const GutAnatomy& a) {
  return {a.cylinder_radius_m,          a.fold_pitch_m, a.vessel_length_m,
          kLeadRadii * a.tube_radius_m, a.legs,         GutCurve::least_leg(a.cylinder_radius_m)};
}

GutFit fit(const GutAnatomy& a) {
  const auto found = fit_legs(folds_of(a), a.columns - 1, a.length_m / (a.columns - 1));
  if (!found)
    throw InputError(
        text("legs = %d: a gut of %g m is too short for them; expected fewer, or a smaller "
             "cylinder_radius_m than %g",
             a.legs, a.length_m, a.cylinder_radius_m));
  const double most = kPi - std::asin(a.tube_radius_m / a.cylinder_radius_m);
  if (!(found->curve.reach_angle() < most))
    throw InputError(
        text("legs = %d: to hold %g m they reach %.0f degrees to both sides and meet behind the "
             "vessel; expected more legs (at most %.0f degrees)",
             a.legs, a.length_m, found->curve.reach_angle() * 180 / kPi, most * 180 / kPi));
  return *found;
}

// Columns: up, across and along, the curve's x, y and z in W.
Eigen::Matrix3d axes_of(const GutAnatomy& a) {
  Eigen::Matrix3d R_WC;
  R_WC.col(2) = a.along.normalized();
  R_WC.col(1) = R_WC.col(2).cross(a.up).normalized();
  R_WC.col(0) = R_WC.col(1).cross(R_WC.col(2));
  return R_WC;
}

GutShape shape_of(const GutAnatomy& a, const GutFit& fit) {
  GutShape shape{{a.rows, a.columns}, {}, a.tube_radius_m, a.mesentery_thickness_m};
  const Eigen::Matrix3d R_WC = axes_of(a);
  for (std::int32_t row = 0; row < a.rows; ++row) {
    const double share = static_cast<double>(row) / (a.rows - 1);
    for (const double u : fit.places) {
      const Vec3 on_vessel(0, 0, fit.curve.vessel_z(u));
      shape.positions.emplace_back(a.origin + R_WC * ((1 - share) * fit.curve.point(u) + share * on_vessel));
    }
  }
  return shape;
}

void refuse_overlaps(const GutShape& shape) {
  const GutOverlaps found = find_overlaps(shape);
  if (found.empty()) return;
  const bool tube = !found.tube.empty();
  const GutOverlap& first = tube ? found.tube.front() : found.mesentery.front();
  const GutReach reach = reach_of(shape);
  throw InputError(
      text("the gut's folds overlap: segment %d and %s %d are %.4g m apart, expected %.4g; a "
           "greater fold_pitch_m, fewer legs or more columns give them room",
           first.segment, tube ? "segment" : "the mesentery's triangle", first.other, first.distance_m,
           tube ? reach.tube_m : reach.mesentery_m));
}

}  // namespace

GutShape make_gut(const GutAnatomy& anatomy) {
  check_sizes(anatomy);
  check_folds(anatomy);
  check_placement(anatomy);
  GutShape shape = shape_of(anatomy, fit(anatomy));
  refuse_overlaps(shape);
  return shape;
}

}  // namespace omentum::geometry
