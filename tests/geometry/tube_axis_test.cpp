#include "geometry/tube_axis.h"

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include <cmath>
#include <numbers>

namespace omentum::geometry {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kRounding = 1e-12;

/// A helix of `turns`, sampled by masses.
struct Helix {
  double radius = 0.05, rise_per_rad = 0.02, turns = 3;
  std::vector<Vec3> masses(int count) const {
    std::vector<Vec3> points;
    for (int i = 0; i < count; ++i) {
      const double a = 2 * kPi * turns * i / (count - 1);
      points.emplace_back(radius * std::cos(a), radius * std::sin(a), rise_per_rad * a);
    }
    return points;
  }
  double length() const { return 2 * kPi * turns * std::hypot(radius, rise_per_rad); }
  double torsion() const { return rise_per_rad / (radius * radius + rise_per_rad * rise_per_rad); }
};

/// Two straight arms, 0.4 m each, and a half circle of radius 0.02 m between them.
std::vector<Vec3> hairpin() {
  constexpr double kArm = 0.4, kBend = 0.02, kStep = 0.01;
  std::vector<Vec3> points;
  for (int i = 0; i < 40; ++i) points.emplace_back(kStep * i, 0, 0);
  for (int i = 0; i <= 6; ++i)
    points.emplace_back(kArm + kBend * std::sin(kPi * i / 6), kBend - kBend * std::cos(kPi * i / 6), 0);
  for (int i = 39; i >= 0; --i) points.emplace_back(kStep * i, 2 * kBend, 0);
  return points;
}

TubeAxis axis_through(const std::vector<Vec3>& masses) {
  TubeAxis axis(masses.size());
  axis.set(masses);
  return axis;
}

std::vector<double> sampled(const std::vector<Vec3>& masses, double bend_m, std::size_t count) {
  std::vector<double> u(count);
  AxisSampling(masses.size(), bend_m).place(axis_through(masses), u);
  return u;
}

std::vector<TubeFrame> frames_of(const std::vector<Vec3>& masses, std::size_t count,
                                 const TubeFrame& last_first = {}) {
  const std::vector<double> u = sampled(masses, 0.02, count);
  std::vector<TubeFrame> frames(count);
  carry_frames(axis_through(masses), u, last_first, frames);
  return frames;
}

/// Of a tube that begins along x.
TubeFrame first_across(const Vec3& k) {
  return {Vec3::Zero(), Vec3::UnitX(), k, Vec3::UnitX().cross(k)};
}

/// Of the triangle of great arcs between three unit vectors: its sign is that of a x b towards c.
double area_on_sphere(const Vec3& a, const Vec3& b, const Vec3& c) {
  return 2 * std::atan2(a.dot(b.cross(c)), 1 + a.dot(b) + b.dot(c) + c.dot(a));
}

/// The angle about `to`'s axis by which `from`'s k is ahead of its own, after the least turn of one axis to
/// the other.
double ahead_about_axis(const TubeFrame& from, const TubeFrame& to) {
  const Eigen::Quaterniond turn = Eigen::Quaterniond::FromTwoVectors(from.t, to.t);
  const Vec3 k = turn * from.k;
  return std::atan2(to.b.dot(k), to.k.dot(k));
}

void expect_right_handed(const TubeFrame& f) {
  EXPECT_LT((f.k.cross(f.b) - f.t).norm(), kRounding);
  for (const Vec3& unit : {f.t, f.k, f.b}) EXPECT_NEAR(unit.norm(), 1, kRounding);
}

TEST(TubeAxis, PassesThroughItsMassesWithTheSlopeOfTheirNeighbours) {
  const std::vector<Vec3> masses = Helix().masses(30);
  const TubeAxis axis = axis_through(masses);
  for (std::size_t i = 0; i < masses.size(); ++i) {
    const AxisPoint point = axis.at(static_cast<double>(i));
    EXPECT_LT((point.place - masses[i]).norm(), kRounding);
    if (i == 0 || i + 1 == masses.size()) continue;
    EXPECT_LT((point.slope - 0.5 * (masses[i + 1] - masses[i - 1])).norm(), kRounding);
  }
}

TEST(TubeAxis, SlopeIsTheDerivativeAndDoesNotBreakAtAMass) {
  const TubeAxis axis = axis_through(Helix().masses(12));
  constexpr double kStep = 1e-5;
  for (double u = kStep; u < axis.end() - kStep; u += 0.173) {
    const Vec3 difference = (axis.at(u + kStep).place - axis.at(u - kStep).place) / (2 * kStep);
    EXPECT_LT((difference - axis.at(u).slope).norm(), 1e-9) << u;
  }
  for (int i = 1; i < 11; ++i)
    EXPECT_LT((axis.at(i - 1e-12).slope - axis.at(i).slope).norm(), 1e-10) << "mass " << i;
}

TEST(TubeAxis, FollowsAParabolaExactlyUpToItsEnds) {
  // the ghosts lie on the parabola through three masses, and a cardinal spline reproduces quadratics
  const auto parabola = [](double u) { return Vec3(u, 0.5 * u * u - u, 2 - 0.25 * u * u); };
  std::vector<Vec3> masses;
  for (int i = 0; i < 6; ++i) masses.push_back(parabola(i));
  const TubeAxis axis = axis_through(masses);
  for (double u = 0; u <= axis.end(); u += 0.05)
    EXPECT_LT((axis.at(u).place - parabola(u)).norm(), kRounding) << u;
}

TEST(TubeAxis, TurnsWithItsMasses) {
  std::vector<Vec3> masses = Helix().masses(15), moved = masses;
  const Eigen::Quaterniond turn(Eigen::AngleAxisd(1.1, Vec3(1, 2, 3).normalized()));
  for (Vec3& p : moved) p = turn * p + Vec3(0.3, -0.1, 2);
  const TubeAxis axis = axis_through(masses), turned = axis_through(moved);
  for (double u = 0; u <= axis.end(); u += 0.21)
    EXPECT_LT((turned.at(u).place - turn * axis.at(u).place - Vec3(0.3, -0.1, 2)).norm(), kRounding);
}

TEST(AxisSampling, SamplesFromEndToEndInOrder) {
  const std::vector<double> u = sampled(hairpin(), 0.04, 300);
  EXPECT_EQ(u.front(), 0);
  EXPECT_EQ(u.back(), static_cast<double>(hairpin().size() - 1));
  for (std::size_t j = 1; j < u.size(); ++j) EXPECT_LT(u[j - 1], u[j]);
}

TEST(AxisSampling, SamplesAreDenserWhereTheAxisBends) {
  const TubeAxis axis = axis_through(hairpin());
  const std::vector<double> u = sampled(hairpin(), 0.04, 300);
  double on_arm = 0, in_bend = 0;
  for (std::size_t j = 1; j < u.size(); ++j) {
    const double step = (axis.at(u[j]).place - axis.at(u[j - 1]).place).norm();
    (u[j] < 30 ? on_arm : in_bend) = step;
    if (u[j] > 43) break;  // the middle of the bend
  }
  // a radius of 0.02 m, a bend that counts 0.04 m per radian: three samples for one
  EXPECT_NEAR(on_arm / in_bend, 3, 0.5);
}

TEST(AxisSampling, WhatHasNoLengthIsSampledEvenly) {
  const std::vector<double> u = sampled(std::vector<Vec3>(5, Vec3(1, 2, 3)), 0.04, 9);
  for (std::size_t j = 0; j < u.size(); ++j) EXPECT_DOUBLE_EQ(u[j], 0.5 * static_cast<double>(j));
}

TEST(TubeFrames, ArePerpendicularAndFaceForward) {
  for (const auto& masses : {Helix().masses(60), hairpin()}) {
    const TubeAxis axis = axis_through(masses);
    const std::vector<double> u = sampled(masses, 0.02, 200);
    std::vector<TubeFrame> frames(u.size());
    carry_frames(axis, u, {}, frames);
    for (std::size_t j = 0; j < u.size(); ++j) {
      expect_right_handed(frames[j]);
      EXPECT_LT((frames[j].t - axis.at(u[j]).slope.normalized()).norm(), kRounding);
    }
  }
}

TEST(TubeFrames, KeepTheNormalOfAPlaneTheyBendIn) {
  const std::vector<TubeFrame> frames = frames_of(hairpin(), 200, first_across({0, 0, 1}));
  for (const TubeFrame& frame : frames) EXPECT_LT((frame.k - Vec3(0, 0, 1)).norm(), kRounding);
}

TEST(TubeFrames, KeepTheirAngleToAPlaneTheyBendInHoweverFewTheyAre) {
  for (const std::size_t count : {8u, 20u, 200u}) {
    const Vec3 first_k(0, std::cos(0.8), std::sin(0.8));
    for (const TubeFrame& frame : frames_of(hairpin(), count, first_across(first_k)))
      EXPECT_NEAR(frame.k.z(), first_k.z(), 1e-10) << count;
  }
}

TEST(TubeFrames, TurnFromStateToStateByWhatTheirDirectionsSweepAndByNothingElse) {
  // what is carried around a loop on the sphere of directions comes back turned by the loop's area: here
  // along the tube's last state, over to this one, and back to its first frame
  constexpr std::size_t kCount = 60;
  std::vector<TubeFrame> last = frames_of(Helix().masses(40), kCount);
  double most = 0;
  for (int s = 1; s <= 20; ++s) {
    std::vector<Vec3> masses = Helix().masses(40);
    for (std::size_t i = 0; i < masses.size(); ++i)
      masses[i] +=
          0.03 * Vec3(std::sin(0.3 * s + 0.2 * static_cast<double>(i)), std::cos(0.5 * s), std::sin(0.2 * s));
    const std::vector<TubeFrame> now = frames_of(masses, kCount, last.front());
    double swept = 0;
    EXPECT_NEAR(ahead_about_axis(last.front(), now.front()), 0, 1e-9);
    for (std::size_t j = 1; j < kCount; ++j) {
      const Vec3 &a = last[j - 1].t, &b = last[j].t, &c = now[j].t, &d = now[j - 1].t;
      swept += area_on_sphere(a, b, c) + area_on_sphere(a, c, d);
      ASSERT_NEAR(std::remainder(ahead_about_axis(last[j], now[j]) - swept, 2 * kPi), 0, 1e-9)
          << s << ' ' << j;
    }
    most = std::max(most, std::abs(swept));
    last = now;
  }
  EXPECT_GT(most, 0.05) << "they do sweep";
}

TEST(TubeFrames, TurnAboutAHelixAsLittleAsCanBe) {
  // towards Frenet's frame, one that turns least goes back by the torsion's integral
  const Helix helix{.radius = 0.05, .rise_per_rad = 0.02, .turns = 2};
  const std::vector<TubeFrame> frames = frames_of(helix.masses(200), 4000);
  const auto to_middle = [](const TubeFrame& f) {  // angle of Frenet's normal from k, about t
    const Vec3 inwards = -Vec3(f.origin.x(), f.origin.y(), 0).normalized();
    return std::atan2(f.b.dot(inwards), f.k.dot(inwards));
  };
  const double expected = helix.torsion() * helix.length();
  const double turned = to_middle(frames.back()) - to_middle(frames.front());
  EXPECT_NEAR(std::remainder(turned - expected, 2 * kPi), 0, 0.01);
}

TEST(TubeFrames, DoNotSwimFromStateToState) {
  // a gut that sways: each state goes on from the frame of the last one, and comes back to where it was
  constexpr int kStates = 100;
  const std::vector<TubeFrame> first = frames_of(Helix().masses(60), 100);
  std::vector<TubeFrame> now = first;
  for (int s = 1; s <= kStates; ++s) {
    std::vector<Vec3> masses = Helix().masses(60);
    for (std::size_t i = 0; i < masses.size(); ++i)
      masses[i].x() += 0.01 * std::sin(2 * kPi * s / kStates) * std::sin(0.2 * static_cast<double>(i));
    const std::vector<TubeFrame> next = frames_of(masses, 100, now.front());
    for (std::size_t j = 0; j < next.size(); ++j) ASSERT_GT(next[j].k.dot(now[j].k), 0.99) << s << " " << j;
    now = next;
  }
  for (std::size_t j = 0; j < now.size(); ++j) EXPECT_GT(now[j].k.dot(first[j].k), 0.999);
}

TEST(TubeFrames, OfMassesInOnePlaceAreFinite) {
  std::vector<Vec3> masses = Helix().masses(12);
  masses[5] = masses[6] = masses[7] = masses[4];
  masses[0] = masses[1] = masses[2];
  for (const auto& degenerate : {masses, std::vector<Vec3>(4, Vec3::Zero())})
    for (const TubeFrame& frame : frames_of(degenerate, 50)) {
      expect_right_handed(frame);
      EXPECT_TRUE(frame.origin.allFinite());
    }
}

TEST(TubeFrames, GoOnWhereTheAxisTurnsIntoK) {
  const std::vector<Vec3> corner{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 1, 0}, {2, 2, 0}};
  std::vector<TubeFrame> frames(2);
  const std::vector<double> u{0, 4};
  carry_frames(axis_through(corner), u, first_across({0, 1, 0}), frames);
  for (const TubeFrame& frame : frames) expect_right_handed(frame);
  EXPECT_LT((frames[1].b - frames[0].b).norm(), 0.2);
}

}  // namespace
}  // namespace omentum::geometry
