#include "render_node/bleeding.h"

#include "render_node/chance.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace omentum::render {
namespace {

using geometry::Triangle;

// Which of a triangle's numbers is for what.
enum Use : std::uint32_t { kBleeds, kWhereOne, kWhereOther, kSize, kRun };

constexpr float kBeadHeight = 0.42f;   // of its radius: water on wet tissue lies flat
constexpr float kBeadLength = 1.25f;   // along the way that it ran
constexpr float kTrailWidth = 0.5f;    // of the bead's radius
constexpr float kTrailHeight = 0.45f;  // of the trail's width
constexpr float kSunk = 0.12f;         // of its height a rim lies below the surface: no gap is seen

// The same whatever the order of the corners and the numbers of the states.
std::uint64_t seed_of(const Triangle& t, const CutShape& shape) {
  std::array<std::uint64_t, 3> nodes;
  for (std::size_t c = 0; c < 3; ++c)
    nodes[c] = static_cast<std::uint64_t>(shape.node[static_cast<std::size_t>(t[c])]);
  std::ranges::sort(nodes);
  return mixed(mixed(mixed(nodes[0]) ^ nodes[1]) ^ nodes[2]);
}

bool burnt(const Triangle& t, const CutShape& shape) {
  return std::ranges::any_of(
      t, [&](geometry::SurfaceId s) { return shape.burnt[static_cast<std::size_t>(s)] > 0; });
}

float area_of(const Triangle& t, std::span<const Vec3f> rest) {
  return 0.5f * (rest[t[1]] - rest[t[0]]).cross(rest[t[2]] - rest[t[0]]).norm();
}

// Even over a triangle.
Vec3f place_within(std::uint64_t seed) {
  float a = chance(seed, kWhereOne), b = chance(seed, kWhereOther);
  if (a + b > 1) a = 1 - a, b = 1 - b;
  return {1 - a - b, a, b};
}

using Wound = std::pair<std::uint64_t, std::size_t>;  // seed and triangle

// Those that a drop may reach: a way over a few does not need the neighbours of all.
std::vector<Triangle> triangles_around(std::span<const Wound> wounds, std::span<const Triangle> triangles,
                                       std::span<const Vec3f> rest, std::vector<std::size_t>& place) {
  Eigen::AlignedBox3f reach;
  for (const auto& [seed, t] : wounds)
    for (const geometry::SurfaceId s : triangles[t]) reach.extend(rest[s]);
  reach.min().array() -= Bleeding::kLongestRun_m;
  reach.max().array() += Bleeding::kLongestRun_m;
  std::vector<Triangle> around;
  for (const auto& [seed, t] : wounds) {
    place.push_back(around.size());
    around.push_back(triangles[t]);
  }
  for (const Triangle& t : triangles) {
    const auto near = [&](geometry::SurfaceId s) { return reach.contains(rest[s]); };
    if (std::ranges::any_of(t, near)) around.push_back(t);
  }
  return around;
}

}  // namespace

void Bleeding::cut(const CutShape& shape, std::span<const Triangle> triangles, std::size_t first_bared,
                   std::span<const Vec3f> rest) {
  std::vector<Wound> wounds;
  for (std::size_t t = first_bared; t < triangles.size(); ++t) {
    if (burnt(triangles[t], shape)) continue;
    const std::uint64_t seed = seed_of(triangles[t], shape);
    if (chance(seed, kBleeds) * kAreaPerDrop_m2 < area_of(triangles[t], rest)) wounds.emplace_back(seed, t);
  }
  std::ranges::sort(wounds);
  wounds.resize(std::min(wounds.size(), kMostDrops));

  const std::vector<Drop> before = std::exchange(drops_, {});
  if (!wounds.empty() && mesh_.vertices.empty()) make_triangles();
  if (wounds.empty()) return;
  std::vector<std::size_t> place;  // of each wound among those
  const std::vector<Triangle> around = triangles_around(wounds, triangles, rest, place);
  const Downhill downhill(around, rest);
  for (std::size_t w = 0; w < wounds.size(); ++w) {
    drops_.push_back(make_drop(wounds[w].first, place[w], downhill, rest));
    const auto was = std::ranges::find(before, wounds[w].first, &Drop::seed);
    if (was != before.end()) drops_.back().ran_s = was->ran_s;
  }
}

Bleeding::Drop Bleeding::make_drop(std::uint64_t seed, std::size_t triangle, const Downhill& downhill,
                                   std::span<const Vec3f> rest) {
  Drop drop;
  drop.seed = seed;
  drop.radius_m = std::lerp(kSmallest_m, kLargest_m, chance(seed, kSize));
  const float most_m = std::lerp(kShortestRun_m, kLongestRun_m, chance(seed, kRun));
  drop.way = downhill.way(triangle, place_within(seed), most_m, kWayPoints);
  drop.length_m.push_back(0);
  for (std::size_t i = 1; i < drop.way.size(); ++i)
    drop.length_m.push_back(drop.length_m.back() +
                            (at(drop.way[i], rest) - at(drop.way[i - 1], rest)).norm());
  return drop;
}

bool Bleeding::run(double dt_s) {
  bool moved = false;
  for (Drop& drop : drops_) {
    if (drop.ran_s >= kRun_s) continue;
    drop.ran_s = std::min(kRun_s, drop.ran_s + dt_s);
    moved = true;
  }
  return moved;
}

void Bleeding::make_triangles() {
  mesh_.vertices.resize(kMostDrops * kDropVertices);
  const auto strip = [&](std::size_t a, std::size_t b, std::size_t below_a, std::size_t below_b) {
    const auto id = [](std::size_t i) { return static_cast<std::uint32_t>(i); };
    mesh_.triangles.push_back({id(a), id(below_a), id(below_b)});
    mesh_.triangles.push_back({id(a), id(below_b), id(b)});
  };
  for (std::size_t d = 0; d < kMostDrops; ++d) {
    const std::size_t top = d * kDropVertices, rings = top + 1, trail = rings + kRings * kAround;
    for (std::size_t a = 0; a < kAround; ++a) {
      const std::size_t next = (a + 1) % kAround;
      mesh_.triangles.push_back({static_cast<std::uint32_t>(top), static_cast<std::uint32_t>(rings + a),
                                 static_cast<std::uint32_t>(rings + next)});
      for (std::size_t r = 0; r + 1 < kRings; ++r)
        strip(rings + r * kAround + a, rings + r * kAround + next, rings + (r + 1) * kAround + a,
              rings + (r + 1) * kAround + next);
    }
    for (std::size_t i = 0; i + 1 < kWayPoints; ++i)
      for (std::size_t c = 0; c + 1 < kAcross; ++c) {
        const std::size_t here = trail + i * kAcross + c;
        strip(here, here + 1, here + kAcross, here + 1 + kAcross);
      }
  }
}

void Bleeding::deform(std::span<const Vec3f> positions, std::span<const Vec3f> normals) {
  for (std::size_t d = 0; d < mesh_.vertices.size() / kDropVertices; ++d) {
    const auto out = std::span(mesh_.vertices).subspan(d * kDropVertices, kDropVertices);
    if (d < drops_.size()) {
      place(drops_[d], positions, normals, out);
    } else {
      std::ranges::fill(out, Vertex{Vec3f::Zero(), Vec3f::UnitZ(), Vec3f::Zero()});
    }
  }
}

std::size_t Bleeding::feet_of(const Drop& drop, std::span<const Vec3f> positions,
                              std::span<const Vec3f> normals, std::array<Foot, kWayPoints>& feet) {
  const auto foot = [&](const SurfacePoint& point) {
    const Vec3f normal = at(point, normals);
    return Foot{SurfaceRefinement::curved(point, positions, normals),
                normal.norm() > 0 ? Vec3f(normal.normalized()) : Vec3f::UnitZ()};
  };
  const auto ran = static_cast<float>(drop.ran_s / kRun_s);
  const float to_m = ran * (2 - ran) * drop.length_m.back();  // it slows down
  std::size_t last = 0;
  feet[0] = foot(drop.way[0]);
  for (std::size_t i = 1; i < drop.way.size() && drop.length_m[i - 1] < to_m; ++i) {
    const Foot next = foot(drop.way[i]), before = feet[i - 1];
    const float leg_m = drop.length_m[i] - drop.length_m[i - 1];
    const float share = leg_m > 0 ? std::min(1.0f, (to_m - drop.length_m[i - 1]) / leg_m) : 1;
    feet[i] = {before.place + share * (next.place - before.place),
               (before.normal + share * (next.normal - before.normal)).normalized()};
    last = i;
  }
  for (std::size_t i = last + 1; i < kWayPoints; ++i) feet[i] = feet[last];
  return last;
}

void Bleeding::place(const Drop& drop, std::span<const Vec3f> positions, std::span<const Vec3f> normals,
                     std::span<Vertex> out) const {
  std::array<Foot, kWayPoints> feet;
  const std::size_t last = feet_of(drop, positions, normals, feet);
  const Vec3f& normal = feet[last].normal;
  Vec3f along = last > 0 ? Vec3f(feet[last].place - feet[last - 1].place) : normal.unitOrthogonal();
  along -= along.dot(normal) * normal;
  along = along.norm() > 0 ? along.normalized() : normal.unitOrthogonal();
  const auto ran = static_cast<float>(drop.ran_s / kRun_s);
  const float radius_m = drop.radius_m * std::sqrt(std::min(1.0f, 4 * ran));  // it wells up first
  place_bead(feet[last], along, radius_m, out.first(1 + kRings * kAround));
  place_trail(feet, kTrailWidth * radius_m, out.subspan(1 + kRings * kAround));
}

// The cap of an ellipsoid.
void Bleeding::place_bead(const Foot& foot, const Vec3f& along, float radius_m, std::span<Vertex> out) {
  const Vec3f across = foot.normal.cross(along);
  const auto put = [&](Vertex& vertex, float x, float y, float z) {
    vertex.position = foot.place + radius_m * (kBeadLength * x * along + y * across +
                                               kBeadHeight * (z - kSunk) * foot.normal);
    vertex.normal = (x / kBeadLength * along + y * across + z / kBeadHeight * foot.normal).normalized();
    vertex.rest = {z, 0, 0};
  };
  put(out[0], 0, 0, 1);
  for (std::size_t r = 0; r < kRings; ++r) {
    const float up = std::numbers::pi_v<float> / 2 * static_cast<float>(r + 1) / kRings;
    for (std::size_t a = 0; a < kAround; ++a) {
      const float turn = 2 * std::numbers::pi_v<float> * static_cast<float>(a) / kAround;
      put(out[1 + r * kAround + a], std::sin(up) * std::cos(turn), std::sin(up) * std::sin(turn),
          std::cos(up));
    }
  }
}

void Bleeding::place_trail(std::span<const Foot> feet, float width_m, std::span<Vertex> out) {
  for (std::size_t i = 0; i < kWayPoints; ++i) {
    const Vec3f along = feet[std::min(i + 1, kWayPoints - 1)].place - feet[i > 0 ? i - 1 : 0].place;
    Vec3f across = feet[i].normal.cross(along);
    across = across.norm() > 0 ? across.normalized() : feet[i].normal.unitOrthogonal();
    for (std::size_t c = 0; c < kAcross; ++c) {
      const float side = static_cast<float>(c) - 1, middle = 1 - std::abs(side);
      Vertex& vertex = out[i * kAcross + c];
      vertex.position =
          feet[i].place + width_m * (side * across + kTrailHeight * (middle - kSunk) * feet[i].normal);
      vertex.normal = (0.8f * side * across + feet[i].normal).normalized();
      vertex.rest = {0.6f * middle, 0, 0};
    }
  }
}

}  // namespace omentum::render
