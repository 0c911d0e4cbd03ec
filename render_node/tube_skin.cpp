#include "render_node/tube_skin.h"

#include "geometry/precondition.h"
#include "render_node/between_points.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace omentum::render {
namespace {

constexpr double kBend = 2;  // radii of length that a turn of one radian counts: three sections for one where
                             // the axis bends as tightly as the tube is wide
constexpr std::size_t kFewestSections = 16, kMostSections = 2500;  // 15 m of gut, two centimetres wide
constexpr float kCapDepth = 0.6f;                                  // of the radius: what is tied off is blunt

// The inner side of a bend reaches no farther than to its centre, or sections would cross: from the first
// share of the way it gives way, softly, and never gets to the sum.
constexpr float kFreeBend = 0.6f, kGivenBend = 0.3f;

constexpr std::size_t kShadeStride = FoldShade::kStride;
constexpr int kShadeAround = TubeSkin::kAround / 2;

// Cosine and sine of each vertex of a section.
const std::array<Eigen::Vector2f, TubeSkin::kAround>& circle() {
  static const auto points_around = [] {
    std::array<Eigen::Vector2f, TubeSkin::kAround> points;
    for (std::size_t a = 0; a < points.size(); ++a) {
      const float angle = 2 * std::numbers::pi_v<float> * static_cast<float>(a) / TubeSkin::kAround;
      points[a] = {std::cos(angle), std::sin(angle)};
    }
    return points;
  }();
  return points_around;
}

std::vector<double> lengths_along(std::span<const geometry::Vec3> masses) {
  std::vector<double> at(masses.size(), 0.0);
  for (std::size_t i = 1; i < masses.size(); ++i) at[i] = at[i - 1] + (masses[i] - masses[i - 1]).norm();
  return at;
}

std::size_t sections_for(double length_m, double radius_m) {
  const double wanted = std::ceil(length_m / (TubeSkin::kStep * radius_m));
  const auto most = static_cast<double>(kMostSections);
  return std::max(kFewestSections, static_cast<std::size_t>(std::min(wanted, most)));
}

// How far out the wall is where the bend reaches `bend` = radius times curvature towards there.
float give_way(float bend) {
  if (bend <= kFreeBend) return 1;
  return (kFreeBend + kGivenBend * std::tanh((bend - kFreeBend) / kGivenBend)) / bend;
}

}  // namespace

TubeSkin::TubeSkin(std::span<const geometry::Vec3> rest, double radius_m)
    : radius_m_(radius_m),
      axis_(rest.size()),
      sampling_(rest.size(), kBend * radius_m),
      rest_at_(lengths_along(rest)),
      shares_(rest.size(), 0.0f),
      u_(sections_for(rest_at_.back(), radius_m)),
      frames_(u_.size()),
      bend_(u_.size(), Vec3f::Zero()),
      walls_(((u_.size() - 1) / kShadeStride + 2) * kShadeAround, 1.0f),
      shade_(radius_m) {
  make_rings(u_.size());
  make_triangles();
  deform(rest);
}

void TubeSkin::make_rings(std::size_t sections) {
  const auto cap = [&](std::size_t section, int ring, float side) {
    const float angle = std::numbers::pi_v<float> / 2 * static_cast<float>(ring) / (kCapRings + 1);
    rings_.push_back({section, std::cos(angle), side * std::sin(angle)});
  };
  for (int r = kCapRings; r > 0; --r) cap(0, r, -1);
  for (std::size_t s = 0; s < sections; ++s) rings_.push_back({s, 1, 0});
  for (int r = 1; r <= kCapRings; ++r) cap(sections - 1, r, 1);
  mesh_.vertices.resize(rings_.size() * kAround + 2);
}

void TubeSkin::make_triangles() {
  const auto vertex = [](std::size_t ring, int a) {
    return static_cast<std::uint32_t>(ring * kAround + static_cast<std::size_t>(a % kAround));
  };
  const auto last = static_cast<std::uint32_t>(mesh_.vertices.size() - 1);
  for (int a = 0; a < kAround; ++a) {
    mesh_.triangles.push_back({last - 1, vertex(0, a + 1), vertex(0, a)});
    for (std::size_t r = 0; r + 1 < rings_.size(); ++r) {
      mesh_.triangles.push_back({vertex(r, a), vertex(r, a + 1), vertex(r + 1, a + 1)});
      mesh_.triangles.push_back({vertex(r, a), vertex(r + 1, a + 1), vertex(r + 1, a)});
    }
    mesh_.triangles.push_back({last, vertex(rings_.size() - 1, a), vertex(rings_.size() - 1, a + 1)});
  }
}

void TubeSkin::deform(std::span<const geometry::Vec3> masses) {
  geometry::require(masses.size() == rest_at_.size(), "as many masses as at rest");
  axis_.set(masses);
  sampling_.place(axis_, u_);
  geometry::carry_frames(axis_, u_, frames_.front(), frames_);
  find_bends();
  length_m_ = lengths_along(masses).back();
  for (std::size_t ring = 0; ring < rings_.size(); ++ring) write_ring(ring);
  write_poles();
  shade_.set(frames_);
  shade_walls();
  spread_shade();
}

// The tighter one of both sides: the section must clear both neighbours.
void TubeSkin::find_bends() {
  std::fill(bend_.begin(), bend_.end(), Vec3f::Zero());
  for (std::size_t j = 0; j + 1 < frames_.size(); ++j) {
    const double way = (frames_[j + 1].origin - frames_[j].origin).norm();
    if (!(way > 0)) continue;
    const Vec3f turn = ((frames_[j + 1].t - frames_[j].t) / way).cast<float>();
    for (const std::size_t s : {j, j + 1})
      if (turn.squaredNorm() > bend_[s].squaredNorm()) bend_[s] = turn;
  }
}

void TubeSkin::map(std::span<const float> shares) {
  geometry::require(shares.size() == shares_.size(), "a share for each mass");
  std::ranges::copy(shares, shares_.begin());
}

void TubeSkin::write_ring(std::size_t ring) {
  const auto& [section, outwards, forward] = rings_[ring];
  const Vec3f origin = frames_[section].origin.cast<float>(), t = frames_[section].t.cast<float>();
  const Vec3f k = frames_[section].k.cast<float>(), b = frames_[section].b.cast<float>();
  const auto radius = static_cast<float>(radius_m_);
  const float along = between<double>(rest_at_, u_[section]), share = between<float>(shares_, u_[section]);
  const bool bends = radius * bend_[section].norm() > kFreeBend;
  for (std::size_t a = 0; a < kAround; ++a) {
    const Eigen::Vector2f& at = circle()[a];
    const Vec3f across = at.x() * k + at.y() * b;
    const float out = radius * outwards * (bends ? give_way(radius * across.dot(bend_[section])) : 1);
    Vertex& vertex = mesh_.vertices[ring * kAround + a];
    vertex.position = origin + out * across + kCapDepth * radius * forward * t;
    vertex.normal = forward == 0 ? across : (outwards * across + forward / kCapDepth * t).normalized();
    vertex.rest = {along + kCapDepth * radius * forward, radius * outwards * at.x(),
                   radius * outwards * at.y()};
    vertex.share = share;
  }
}

void TubeSkin::write_poles() {
  for (const bool end : {false, true}) {
    const geometry::TubeFrame& frame = end ? frames_.back() : frames_.front();
    const Vec3f outwards = (end ? frame.t : geometry::Vec3(-frame.t)).cast<float>();
    const float depth = kCapDepth * static_cast<float>(radius_m_);
    Vertex& pole = mesh_.vertices[mesh_.vertices.size() - (end ? 1 : 2)];
    pole.position = frame.origin.cast<float>() + depth * outwards;
    pole.normal = outwards;
    pole.share = end ? shares_.back() : shares_.front();
    pole.rest = {end ? static_cast<float>(rest_at_.back()) + depth : -depth, 0, 0};
  }
}

// Of some sections only, in half as many directions: light from all around changes slowly.
void TubeSkin::shade_walls() {
  for (std::size_t w = 0; w < walls_.size() / kShadeAround; ++w) {
    const std::size_t section = std::min(w * kShadeStride, frames_.size() - 1);
    shade_.stand_at(frames_[section].origin.cast<float>());
    for (int a = 0; a < kShadeAround; ++a) {
      const std::size_t ring = section + kCapRings;
      const Vertex& vertex = mesh_.vertices[ring * kAround + 2 * static_cast<std::size_t>(a)];
      walls_[w * kShadeAround + static_cast<std::size_t>(a)] =
          shade_.openness(vertex.position, vertex.normal);
    }
  }
}

void TubeSkin::spread_shade() {
  for (std::size_t ring = 0; ring < rings_.size(); ++ring) {
    const std::size_t section = rings_[ring].section, w = section / kShadeStride;
    const float share = static_cast<float>(section % kShadeStride) / kShadeStride;
    const auto at = [&](int a) {
      const auto place = w * kShadeAround + static_cast<std::size_t>(a % kShadeAround);
      return std::lerp(walls_[place], walls_[place + kShadeAround], share);
    };
    for (int a = 0; a < kAround; ++a)
      mesh_.vertices[ring * kAround + static_cast<std::size_t>(a)].openness =
          0.5f * (at(a / 2) + at((a + 1) / 2));
  }
}

}  // namespace omentum::render
