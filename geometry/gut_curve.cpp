#include "geometry/gut_curve.h"

#include <array>
#include <cmath>
#include <numbers>

namespace omentum::geometry {
namespace {

constexpr double kPi = std::numbers::pi, kRightAngle = kPi / 2;
constexpr int kTerms = 9;  // of the series below: J_18(pi/2) is below 1e-17

// The share of the vessel at each end that the mesentery of the first and last lead_m takes: there the gut is
// near the vessel, and lines that ended side by side would come nearer to it than it is thick.
constexpr double kLeadShare = 0.44;

// The first leg leaves the vessel on a spiral that meets the cylinder after this angle. Tighter, it leaves
// its own mesentery sooner; wider, it falls more gently from the vessel's end to its leg.
constexpr double kLeadAngle = 0.8 * kPi;

// J_n(pi/2)
double bessel(int order) {
  static const auto values = [] {
    std::array<double, 2 * kTerms> j{};
    for (std::size_t n = 0; n < j.size(); ++n) j[n] = std::cyl_bessel_j(static_cast<double>(n), kRightAngle);
    return j;
  }();
  return values[static_cast<std::size_t>(order)];
}

// Integrals over t of cos(pi/2 cos t) and sin(pi/2 cos t): the series of Jacobi and Anger, term by term.
double along_turn(double t) {
  double sum = bessel(0) * t;
  for (int n = 1; n < kTerms; ++n)
    sum += (n % 2 == 0 ? 2 : -2) * bessel(2 * n) * std::sin(2 * n * t) / (2 * n);
  return sum;
}

double across_turn(double t) {
  double sum = 0;
  for (int n = 0; n < kTerms; ++n) {
    const int odd = 2 * n + 1;
    sum += (n % 2 == 0 ? 2 : -2) * bessel(odd) * std::sin(odd * t) / odd;
  }
  return sum;
}

}  // namespace

GutCurve::GutCurve(const GutFolds& folds)
    : folds_(folds),
      turn_(folds.pitch_m / bessel(0)),
      length_(folds.legs * folds.leg_m + (folds.legs - 1) * turn_) {}

// d theta / d u = (pi/2) (pi / turn) sin t, and turn = pitch / J_0(pi/2)
double GutCurve::least_pitch(double bend_radius_m) {
  return kPi * kRightAngle * bessel(0) * bend_radius_m;
}

double GutCurve::least_leg(double cylinder_radius_m) {
  return kLeadAngle * cylinder_radius_m;
}

double GutCurve::reach_angle() const {
  return (folds_.leg_m / 2 + turn_ / kPi * across_turn(kRightAngle)) / folds_.cylinder_radius_m;
}

GutCurve::Place GutCurve::rolled_out(double u) const {
  const double R = folds_.cylinder_radius_m, period = folds_.leg_m + turn_;
  const double leg = std::floor(u / period), on_leg = u - leg * period;
  const double side = std::fmod(leg, 2) == 0 ? 1 : -1;
  const double z = (leg - (folds_.legs - 1) / 2.0) * folds_.pitch_m;
  if (on_leg <= folds_.leg_m) return {R, side * (on_leg - folds_.leg_m / 2) / R, z};
  const double t = kPi * (on_leg - folds_.leg_m) / turn_, scale = turn_ / kPi;
  return {R, side * (folds_.leg_m / 2 + scale * across_turn(t)) / R, z + scale * along_turn(t)};
}

GutCurve::Place GutCurve::first_half(double u) const {
  Place p = rolled_out(u);
  const double turned = u / folds_.cylinder_radius_m;
  if (turned >= kLeadAngle) return p;
  const double start = -folds_.vessel_length_m / 2, share = std::sin(kRightAngle * turned / kLeadAngle);
  return {share * p.radius, p.angle, start + share * (p.z - start)};
}

GutCurve::Place GutCurve::place(double u) const {
  if (u <= length_ / 2) return first_half(u);
  const Place p = first_half(length_ - u);
  return {p.radius, folds_.legs % 2 == 0 ? p.angle : -p.angle, -p.z};
}

Vec3 GutCurve::point(double u) const {
  const Place p = place(u);
  return {p.radius * std::cos(p.angle), p.radius * std::sin(p.angle), p.z};
}

double GutCurve::vessel_z(double u) const {
  if (u > length_ / 2) return -vessel_z(length_ - u);
  const double half = folds_.vessel_length_m / 2, lead = 2 * half * kLeadShare;
  if (u < folds_.lead_m) return -half + lead * u / folds_.lead_m;
  return (lead - half) * (length_ / 2 - u) / (length_ / 2 - folds_.lead_m);
}

}  // namespace omentum::geometry
