// The pattern on a gut's wall sticks to it, while the gut moves and is drawn from ever other pieces.
#include "render_node/tube_compare/tube_trial.h"
#include "render_node/tube_cylinder.h"
#include "render_node/tube_frames.h"

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include <algorithm>
#include <numbers>
#include <optional>

namespace omentum::render {
namespace {

using geometry::Vec3;

constexpr double kBowel_m = 0.012;       // radius
constexpr double kMassSpacing_m = 0.02;  // at rest
constexpr int kBowelMasses = 30;

// How far off its material point a pattern is drawn at most, of the radius: a tenth of a millimetre on this
// bowel. Of two sections a piece is a chord, and its wall's pattern lies evenly along it.
constexpr double kPatternOff = 0.015, kPatternOffOfChords = 0.08;
constexpr double kTurnRounding = 2e-3;  // rad: of floats, and of looking across between two sections

std::vector<Vec3> straight_bowel() {
  std::vector<Vec3> masses;
  for (int i = 0; i < kBowelMasses; ++i) masses.emplace_back(kMassSpacing_m * i, 0, 0);
  return masses;
}

// Bent in space, stretched unevenly and carried away, each at a rate of its own.
std::vector<Vec3> wandering(double time_s) {
  std::vector<Vec3> masses{0.05 * time_s * Vec3(1, -2, 0.5)};
  for (int i = 1; i < kBowelMasses; ++i) {
    const double yaw = 1.1 * std::sin(0.5 * i + 1.3 * time_s);
    const double pitch = 0.7 * std::sin(0.37 * i - 0.9 * time_s);
    const double length_m = kMassSpacing_m * (1 + 0.25 * std::sin(0.8 * i + 2 * time_s));
    masses.push_back(masses.back() + length_m * Vec3(std::cos(yaw) * std::cos(pitch),
                                                     std::sin(yaw) * std::cos(pitch), std::sin(pitch)));
  }
  return masses;
}

// A place of the wall's pattern: where its section's middle is drawn, and which way it lies from there.
struct PatternPlace {
  Vec3 middle, across;
  double along;  // rest.x of its vertex
};

// All sections as the vertex shader computes them, at one angle around.
std::vector<PatternPlace> drawn_at(const TubeFrames& tube, int n, double angle) {
  const int sections = 2 << n;
  std::vector<PatternPlace> line;
  const std::span<const SkinFrame> frames = tube.frames();
  for (std::size_t j = 0; j + 1 < frames.size(); ++j) {
    for (int s = 0; s < sections; ++s) {
      CylinderVertex at{static_cast<float>(std::cos(angle)), static_cast<float>(std::sin(angle)),
                        static_cast<float>(s) / static_cast<float>(sections - 1)};
      const Vertex wall = skinned(frames[j], frames[j + 1], tube.radius_m(), at);
      at.outwards = 0;
      const Vertex middle = skinned(frames[j], frames[j + 1], tube.radius_m(), at);
      line.push_back(
          {middle.position.cast<double>(), (wall.position - middle.position).cast<double>(), wall.rest.x()});
    }
  }
  return line;
}

// What is drawn nearest to a place of the axis.
PatternPlace nearest_to(const Vec3& place, const std::vector<PatternPlace>& line) {
  PatternPlace nearest = line.front();
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    const PatternPlace &from = line[i], &to = line[i + 1];
    const Vec3 way = to.middle - from.middle;
    if (!(way.norm() > 1e-6)) continue;  // the same section of two pieces
    const double share = std::clamp(way.dot(place - from.middle) / way.squaredNorm(), 0.0, 1.0);
    const Vec3 middle = from.middle + share * way;
    if ((middle - place).norm() >= (nearest.middle - place).norm()) continue;
    nearest = {middle, (1 - share) * from.across + share * to.across, std::lerp(from.along, to.along, share)};
  }
  return nearest;
}

// What a blend of two directions across is off, at most, in the middle of a piece that turns by so much.
double blend_turn(const TubeFrames& tube) {
  const std::span<const SkinFrame> frames = tube.frames();
  float least = 1;
  for (std::size_t j = 0; j + 1 < frames.size(); ++j)
    least = std::min(least, frames[j].t.dot(frames[j + 1].t));
  return std::atan(1 / std::sqrt(0.5 * (1 + least))) - std::numbers::pi / 4;
}

// Material places of the bowel, along it, and where the axis' spline has them now, with frames that are
// carried to there as those are that the tube is cut at.
struct MaterialPlace {
  double along;
  geometry::TubeFrame frame;
};
std::vector<MaterialPlace> places_of(const TubeFrames& tube, const std::vector<Vec3>& masses) {
  geometry::TubeAxis axis(masses.size());
  axis.set(masses);
  std::vector<double> stations(geometry::TubeSplit::kThirds * (masses.size() - 1) + 1);
  for (std::size_t s = 0; s < stations.size(); ++s)
    stations[s] = static_cast<double>(s) / geometry::TubeSplit::kThirds;
  std::vector<geometry::TubeFrame> frames(stations.size());
  const SkinFrame& first = tube.frames().front();
  const Vec3 t = first.t.cast<double>(), k = first.k.cast<double>();
  geometry::carry_frames(axis, stations, {Vec3::Zero(), t, k, t.cross(k)}, frames);
  std::vector<MaterialPlace> places;
  for (double u = 0.1; u < axis.end(); u += 0.23) {
    const auto before = static_cast<std::size_t>(u * geometry::TubeSplit::kThirds);
    places.push_back({u * kMassSpacing_m, geometry::frame_after(frames[before], axis.at(u))});
  }
  return places;
}

double angle_of(const Vec3& across, const geometry::TubeFrame& frame) {
  return std::atan2(across.dot(frame.b), across.dot(frame.k));
}

TEST(TubePattern, StaysAtItsPlaceOfTheWallWhateverPiecesTheGutIsDrawnFrom) {
  TubeFrames tube(straight_bowel(), kBowel_m);
  std::size_t fewest = 1000, most = 0;
  for (double time_s = 0; time_s < 3; time_s += 0.5) {
    const std::vector<Vec3> masses = wandering(time_s);
    tube.deform(masses);
    const std::vector<MaterialPlace> places = places_of(tube, masses);
    for (const TubeResolution& resolution : kTubeLadder) {
      tube.set_eps(resolution.eps);
      fewest = std::min(fewest, tube.frames().size());
      most = std::max(most, tube.frames().size());
      const double off_m = kBowel_m * (resolution.n == 0 ? kPatternOffOfChords : kPatternOff);
      const double turned = blend_turn(tube) + kTurnRounding;
      for (const double angle : {0.0, 0.8, 2.2, 3.6, 5.1}) {
        const std::vector<PatternPlace> line = drawn_at(tube, resolution.n, angle);
        for (const auto& [along, frame] : places) {
          const PatternPlace drawn = nearest_to(frame.origin, line);
          ASSERT_NEAR(drawn.along, along, off_m) << resolution.eps << ' ' << resolution.n;
          const double ahead = angle_of(drawn.across, frame) - angle;
          ASSERT_NEAR(std::remainder(ahead, 2 * std::numbers::pi), 0, turned) << resolution.eps;
        }
      }
    }
  }
  EXPECT_GT(most, fewest + 20) << "it is cut anew all the time";
}

TEST(TubePattern, DoesNotTurnWhileTheGutFoldsInAPlane) {
  for (const double tilt : {0.4, 0.8, 1.2}) {  // of the plane, from the first direction across
    const Eigen::AngleAxisd tilted(tilt, Vec3::UnitX());
    const Vec3f normal = (tilted * Vec3::UnitZ()).cast<float>();
    std::optional<TubeFrames> tube;
    for (const double folded : {0.0, 0.2, 0.4, 0.6, 0.8, 1.0, 0.5, 0.0}) {
      std::vector<Vec3> masses = trial::folding_axis(60, folded);
      for (Vec3& mass : masses) mass = tilted * Vec3(mass.x(), mass.y(), 0);
      if (!tube) tube.emplace(masses, trial::kRadius_m);
      tube->deform(masses);
      for (const SkinFrame& frame : tube->frames())
        ASSERT_NEAR(frame.k.dot(normal), std::sin(-tilt), 1e-5) << tilt << ' ' << folded;
    }
  }
}

}  // namespace
}  // namespace omentum::render
