#include "render_node/tube_frames.h"

#include "geometry/precondition.h"
#include "render_node/between_points.h"

#include <algorithm>
#include <cmath>

namespace omentum::render {
namespace {

constexpr double kClosest =
    0.6;  // radii: of control points; the spline between them is smoother than the tube
constexpr double kBallSpacing = 1.0;  // radii: of the balls that stand for it when it shades
constexpr std::size_t kFewestPoints = 3;
constexpr float kLeastWay = 0.05f;  // radii, from frame to frame: less is no bend but a knot

double length_of(std::span<const geometry::Vec3> line) {
  double sum = 0;
  for (std::size_t i = 1; i < line.size(); ++i) sum += (line[i] - line[i - 1]).norm();
  return sum;
}

std::size_t stride_of(std::span<const geometry::Vec3> rest, double radius_m) {
  geometry::require(rest.size() >= kFewestPoints, "three masses of an axis");
  const double spacing = length_of(rest) / static_cast<double>(rest.size() - 1);
  const double wanted = spacing > 0 ? std::floor(kClosest * radius_m / spacing) : 1;
  const std::size_t most = (rest.size() - 1) / (kFewestPoints - 1);
  return static_cast<std::size_t>(std::clamp(wanted, 1.0, static_cast<double>(most)));
}

// Of so many masses, the last one always.
std::size_t point_count(std::size_t masses, std::size_t stride) {
  return (masses - 2) / stride + 2;
}

}  // namespace

TubeFrames::TubeFrames(std::span<const geometry::Vec3> rest, double radius_m)
    : radius_m_(radius_m),
      stride_(stride_of(rest, radius_m)),
      shares_(point_count(rest.size(), stride_), 0.0f),
      points_(shares_.size()),
      axis_(points_.size()),
      split_(points_.size()),
      u_(geometry::TubeSplit::kThirds * (points_.size() - 1) + 1),
      speeds_(u_.size()),
      stations_(u_.size()),
      shade_(radius_m),
      pale_(points_.size() - 1, 0) {
  for (std::size_t s = 0; s < u_.size(); ++s) u_[s] = static_cast<double>(s) / geometry::TubeSplit::kThirds;
  frames_.reserve(geometry::TubeSplit::kMostCuts * points_.size());
  for (std::size_t i = 0, m = 0; i < points_.size(); ++i, m += stride_) {
    points_[i] = rest[std::min(m, rest.size() - 1)];
    rest_at_.push_back(i == 0 ? 0 : rest_at_.back() + (points_[i] - points_[i - 1]).norm());
  }
  deform(rest);
  pallor_.emplace(stations_, radius_m);
}

void TubeFrames::deform(std::span<const geometry::Vec3> masses) {
  geometry::require(point_count(masses.size(), stride_) == points_.size(), "as many masses as at rest");
  for (std::size_t i = 0; i < points_.size(); ++i)
    points_[i] = masses[std::min(i * stride_, masses.size() - 1)];
  length_m_ = length_of(masses);
  axis_.set(points_);
  geometry::carry_frames(axis_, u_, stations_.front(), stations_, speeds_);
  const double station_m = rest_at_.back() / static_cast<double>(u_.size() - 1);
  const double stride = station_m > 0 ? std::round(kBallSpacing * radius_m_ / station_m) : 1;
  shade_.set(stations_,
             static_cast<std::size_t>(std::clamp(stride, 1.0, static_cast<double>(u_.size() - 1))));
  write_frames();
}

void TubeFrames::map(std::span<const float> shares) {
  geometry::require(point_count(shares.size(), stride_) == shares_.size(), "a share for each mass");
  for (std::size_t i = 0; i < shares_.size(); ++i)
    shares_[i] = shares[std::min(i * stride_, shares.size() - 1)];
}

bool TubeFrames::live(std::span<const Press> presses, double dt_s) {
  if (!pallor_->advance(presses, dt_s, stations_)) return false;
  want_pale_frames();
  write_frames();
  return true;
}

// Where nothing of it bends a piece may be as long as a segment, and pallor is as wide as a fingertip.
void TubeFrames::want_pale_frames() {
  for (std::size_t i = 0; i < pale_.size(); ++i) {
    const std::size_t first = geometry::TubeSplit::kThirds * i;
    pale_[i] = pallor_->is_pale(first, first + geometry::TubeSplit::kThirds) ? 1 : 0;
  }
}

void TubeFrames::set_eps(double eps) {
  const double wanted = clamped({eps, 0}).eps;
  if (wanted == eps_) return;
  eps_ = wanted;
  write_frames();
}

void TubeFrames::write_frames() {
  split_.split(axis_, eps_, pale_);
  frames_.clear();
  double before = 0, speed_before = 0;
  for (const double u : split_.cuts()) {
    double speed = 0;
    write(frame_at(u, speed), u);
    if (frames_.size() > 1) {
      const double half = (u - before) / 2;
      frames_[frames_.size() - 2].ahead = static_cast<float>(half * speed_before);
      frames_.back().behind = static_cast<float>(half * speed);
      bend();
    }
    before = u;
    speed_before = speed;
  }
  if (pallor_ && pallor_->is_pale()) write_pallor();
}

void TubeFrames::write_pallor() {
  const std::span<const double> cuts = split_.cuts();
  for (std::size_t c = 0; c < cuts.size(); ++c) {
    const double before = cuts[c > 0 ? c - 1 : 0], after = cuts[std::min(c + 1, cuts.size() - 1)];
    const auto pallor =
        pallor_->at(geometry::TubeSplit::kThirds * cuts[c], geometry::TubeSplit::kThirds * before,
                    geometry::TubeSplit::kThirds * after);
    for (std::size_t d = 0; d < SkinFrame::kDirections; ++d) frames_[c].walls[d] += kFullPallor * pallor[d];
  }
}

// A station, as a rule.
geometry::TubeFrame TubeFrames::frame_at(double u, double& speed) const {
  constexpr double kRounding = 1e-9;
  const double station = u * geometry::TubeSplit::kThirds, nearest = std::round(station);
  if (std::abs(station - nearest) < kRounding) {
    const auto s = static_cast<std::size_t>(nearest);
    speed = speeds_[s];
    return stations_[s];
  }
  const geometry::AxisPoint point = axis_.at(u);
  speed = point.slope.norm();
  return geometry::frame_after(stations_[static_cast<std::size_t>(station)], point);
}

void TubeFrames::write(const geometry::TubeFrame& frame, double u) {
  SkinFrame& skin = frames_.emplace_back();
  skin.origin = frame.origin.cast<float>();
  skin.t = frame.t.cast<float>();
  skin.k = frame.k.cast<float>();
  skin.along = between<double>(rest_at_, u);
  skin.share = between<float>(shares_, u);
  const auto before = std::min(static_cast<std::size_t>(u), split_.turns().size() - 2);
  skin.turn = static_cast<float>(std::max(split_.turns()[before], split_.turns()[before + 1]));
  shade_.stand_at(skin.origin);
  const auto openness = shade_.around(skin.origin, skin.k, frame.b.cast<float>());
  for (std::size_t d = 0; d < SkinFrame::kDirections; ++d) skin.walls[d] = pack_wall(openness[d], 0);
}

// Between the last two frames: each takes the tighter one of its sides, since it must clear both neighbours.
void TubeFrames::bend() {
  SkinFrame &first = frames_[frames_.size() - 2], &second = frames_.back();
  const Vec3f way = second.origin - first.origin, turn = second.t - first.t;
  const float bend = radius_m() * turn.norm() / std::max(way.norm(), kLeastWay * radius_m());
  for (SkinFrame* frame : {&first, &second}) {
    if (bend <= std::hypot(frame->bend_k, frame->bend_b)) continue;
    // all of it towards where it points across: walls of both frames approach each other by the whole turn
    const float k = turn.dot(frame->k), b = turn.dot(frame->t.cross(frame->k)), across = std::hypot(k, b);
    if (!(across > 0)) continue;
    frame->bend_k = bend * k / across;
    frame->bend_b = bend * b / across;
  }
}

}  // namespace omentum::render
