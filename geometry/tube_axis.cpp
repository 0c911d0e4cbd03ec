#include "geometry/tube_axis.h"

#include "geometry/precondition.h"

#include <algorithm>
#include <cmath>

namespace omentum::geometry {
namespace {

constexpr double kStraightBack = 1e-6;  // 1 + cosine of a turn that has no plane but by rounding

Vec3 direction(const Vec3& slope, const Vec3& otherwise) {
  const double length = slope.norm();
  return length > 0 ? Vec3(slope / length) : otherwise;
}

// `k`, across `from`, after the smallest turn that takes `from` to `to`. Straight back it stays as it is.
Vec3 turned_along(const Vec3& k, const Vec3& from, const Vec3& to) {
  const double forwards = 1 + from.dot(to);
  return forwards > kStraightBack ? Vec3(k - k.dot(to) / forwards * (from + to)) : k;
}

}  // namespace

Eigen::Vector4d cardinal_weights(double t) {
  const double t2 = t * t, t3 = t2 * t;
  return 0.5 * Eigen::Vector4d(-t3 + 2 * t2 - t, 3 * t3 - 5 * t2 + 2, -3 * t3 + 4 * t2 + t, t3 - t2);
}

Eigen::Vector4d cardinal_slopes(double t) {
  const double t2 = t * t;
  return 0.5 * Eigen::Vector4d(-3 * t2 + 4 * t - 1, 9 * t2 - 10 * t, -9 * t2 + 8 * t + 1, 3 * t2 - 2 * t);
}

TubeAxis::TubeAxis(std::size_t mass_count) : points_(mass_count + 2, Vec3::Zero()) {
  require(mass_count >= 3, "three masses of an axis");
}

void TubeAxis::set(std::span<const Vec3> masses) {
  require(masses.size() + 2 == points_.size(), "as many masses as the axis has");
  std::copy(masses.begin(), masses.end(), points_.begin() + 1);
  const std::size_t n = points_.size();
  points_.front() = ghost_before(points_[1], points_[2], points_[3]);
  points_.back() = ghost_before(points_[n - 2], points_[n - 3], points_[n - 4]);
}

AxisPoint TubeAxis::at(double u) const {
  const double segment = std::clamp(std::floor(u), 0.0, end() - 1);
  const auto i = static_cast<std::size_t>(segment);
  const Eigen::Vector4d w = cardinal_weights(u - segment), s = cardinal_slopes(u - segment);
  AxisPoint point{Vec3::Zero(), Vec3::Zero()};
  for (std::size_t c = 0; c < 4; ++c) {
    point.place += w[static_cast<Eigen::Index>(c)] * points_[i + c];
    point.slope += s[static_cast<Eigen::Index>(c)] * points_[i + c];
  }
  return point;
}

AxisCubic TubeAxis::cubic(std::size_t segment) const {
  const Vec3 &before = points_[segment], &from = points_[segment + 1], &to = points_[segment + 2],
             &after = points_[segment + 3];
  return {from, 0.5 * (to - before), 0.5 * (2 * before - 5 * from + 4 * to - after),
          0.5 * (after - before + 3 * (from - to))};
}

double TubeAxis::turn_at(std::size_t mass) const {
  const Vec3 in = points_[mass + 1] - points_[mass], out = points_[mass + 2] - points_[mass + 1];
  const double squares = in.squaredNorm() * out.squaredNorm();
  return squares > 0 ? std::clamp((1 - in.dot(out) / std::sqrt(squares)) / 2, 0.0, 1.0) : 0;
}

AxisSampling::AxisSampling(std::size_t mass_count, double bend_m)
    : bend_m_(bend_m), sum_(kPieces * (mass_count - 1) + 1, 0.0) {}

void AxisSampling::measure(const TubeAxis& axis) {
  AxisPoint before = axis.at(0);
  for (std::size_t c = 1; c < sum_.size(); ++c) {
    const AxisPoint now = axis.at(static_cast<double>(c) / kPieces);
    const double turn = std::atan2(before.slope.cross(now.slope).norm(), before.slope.dot(now.slope));
    sum_[c] = sum_[c - 1] + (now.place - before.place).norm() + bend_m_ * turn;
    before = now;
  }
}

void AxisSampling::place(const TubeAxis& axis, std::span<double> u) {
  require(sum_.size() - 1 == static_cast<std::size_t>(kPieces * axis.end()), "an axis of as many masses");
  measure(axis);
  const double steps = static_cast<double>(u.size() - 1);
  std::size_t c = 1;
  for (std::size_t j = 0; j < u.size(); ++j) {
    const double share = static_cast<double>(j) / steps, wanted = share * sum_.back();
    while (c + 1 < sum_.size() && sum_[c] < wanted) ++c;
    const double piece = sum_[c] - sum_[c - 1];
    const double within = piece > 0 ? std::clamp((wanted - sum_[c - 1]) / piece, 0.0, 1.0) : 0;
    u[j] = sum_.back() > 0 ? (static_cast<double>(c - 1) + within) / kPieces : share * axis.end();
  }
  u.back() = axis.end();
}

TubeFrame frame_after(const TubeFrame& before, const AxisPoint& point) {
  TubeFrame frame;
  frame.origin = point.place;
  frame.t = direction(point.slope, before.t);
  const Vec3 k = turned_along(before.k, before.t, frame.t);
  const Vec3 across = k - k.dot(frame.t) * frame.t;  // rounding does not add up
  frame.k = before.k.isZero(0) ? frame.t.unitOrthogonal() : Vec3(across.normalized());
  frame.b = frame.t.cross(frame.k);
  return frame;
}

void carry_frames(const TubeAxis& axis, std::span<const double> u, const TubeFrame& last_first,
                  std::span<TubeFrame> frames, std::span<double> speeds) {
  require(u.size() == frames.size(), "a frame for each parameter");
  require(speeds.empty() || speeds.size() == u.size(), "a speed for each parameter");
  TubeFrame before = last_first;
  for (std::size_t j = 0; j < u.size(); ++j) {
    const AxisPoint point = axis.at(u[j]);
    before = frames[j] = frame_after(before, point);
    if (!speeds.empty()) speeds[j] = point.slope.norm();
  }
}

}  // namespace omentum::geometry
