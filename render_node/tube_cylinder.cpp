#include "render_node/tube_cylinder.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace omentum::render {
namespace {

// gl/shaders/tube.glsl has the same numbers, and the same steps.
constexpr float kCapDepth = 0.6f;  // of the radius: what is tied off is blunt

// Sections of the inner side would cross at a bend of 1, where walls of neighbours meet: from the first share
// on it gives way, softly, and never gets to the sum. (A sum of 0.8 leaves slivers inside out in kinks of 100
// degrees.)
constexpr float kFreeBend = 0.5f, kGivenBend = 0.2f;

// In a piece's middle the wall of the inner side goes on by 2 (1 - bend), less what the axis' slope is above
// a half, of the way between its frames: from a bend of 2/3 on it follows that slope less, or it would go
// back.
constexpr float kSlopeFades = 3;

// A normal that leans away from the section's own direction by more than these cosines belongs to a kink.
constexpr float kKinkFrom = 0.5f, kKinkAll = 0.2f;

// Directions of both frames that nearly cancel out are no direction.
constexpr float kLeastBlend = 0.2f;

// Puts a cylinder together, section by section.
class CylinderMaker {
 public:
  explicit CylinderMaker(std::size_t around) : around_(around) {}

  TubeCylinder& cylinder() { return cylinder_; }

  void add_section(float z, float outwards, float forward) {
    for (std::size_t a = 0; a < around_; ++a) {
      const float turn = static_cast<float>(a) / static_cast<float>(around_);
      const float angle = 2 * std::numbers::pi_v<float> * turn;
      cylinder_.vertices.push_back(
          {std::cos(angle), std::sin(angle), z, turn * SkinFrame::kDirections, outwards, forward});
    }
  }

  // Between two sections, counted from 0.
  void add_wall(std::size_t section) { add_belt(section * around_, (section + 1) * around_); }

  // side: -1 before the first frame, 1 beyond the second one.
  void add_cap(float side) {
    const float z = side > 0 ? 1.0f : 0.0f;
    std::size_t before = cylinder_.vertices.size();
    add_section(z, 1, 0);
    for (int ring = 1; ring <= TubeCylinder::kCapRings; ++ring) {
      const float angle =
          std::numbers::pi_v<float> / 2 * static_cast<float>(ring) / (TubeCylinder::kCapRings + 1);
      add_section(z, std::cos(angle), side * std::sin(angle));
      side > 0 ? add_belt(before, before + around_) : add_belt(before + around_, before);
      before += around_;
    }
    const auto pole = static_cast<std::uint32_t>(cylinder_.vertices.size());
    cylinder_.vertices.push_back({1, 0, z, 0, 0, side});
    for (std::size_t a = 0; a < around_; ++a) {
      const auto here = static_cast<std::uint32_t>(before + a);
      const auto next = static_cast<std::uint32_t>(before + (a + 1) % around_);
      cylinder_.triangles.push_back(side > 0 ? MeshTriangle{here, next, pole}
                                             : MeshTriangle{next, here, pole});
    }
  }

 private:
  // Between the sections that begin at vertices `first` and `second`.
  void add_belt(std::size_t first, std::size_t second) {
    for (std::size_t a = 0; a < around_; ++a) {
      const std::size_t next = (a + 1) % around_;
      const auto at = [](std::size_t i) { return static_cast<std::uint32_t>(i); };
      cylinder_.triangles.push_back({at(first + a), at(first + next), at(second + next)});
      cylinder_.triangles.push_back({at(first + a), at(second + next), at(second + a)});
    }
  }

  std::size_t around_;
  TubeCylinder cylinder_;
};

// A frame's wall in one direction: that direction across, how far out the wall is, of the radius, and the
// derivatives of both by the angle.
struct Wall {
  Vec3f across, turn;
  float reach, slope;
  float along;  // of the axis' slope, what the wall follows it by
};
Wall wall_at(const SkinFrame& frame, const CylinderVertex& at) {
  const Vec3f b = frame.t.cross(frame.k);
  const float bend = at.cosine * frame.bend_k + at.sine * frame.bend_b;
  Wall wall{at.cosine * frame.k + at.sine * b, at.cosine * b - at.sine * frame.k, give_way(bend), 0, 1};
  if (bend > kFreeBend) {
    const float given = std::tanh((bend - kFreeBend) / kGivenBend);
    wall.slope =
        (1 - given * given - wall.reach) / bend * (at.cosine * frame.bend_b - at.sine * frame.bend_k);
    wall.along = std::min(1.0f, kSlopeFades * (1 - wall.reach * bend));
  }
  return wall;
}

// Both frames' walls, blended: where they point, out of the axis, and derivatives by the angle and by z, of
// the radius.
struct Blend {
  Vec3f across, out, turn, along;
};
Blend blend(const Wall& one, const Wall& two, const Vec3f& turning, float w, float w_slope) {
  const float v = 1 - w;
  const Vec3f sum = w * one.across + v * two.across;
  const float length = std::max(sum.norm(), kLeastBlend);
  const Vec3f across = sum / length;
  // unit again on the outer side alone: on the inner one sections must keep their way from each other
  // (and never at a frame, where it is unit but for rounding, which would part neighbours)
  const bool is_outer = w > 0 && v > 0 && sum.dot(turning) < 0;
  const float scale = is_outer ? 1 / length : 1, flat = is_outer ? 1.0f : 0.0f;
  const float reach = w * one.reach + v * two.reach;
  const auto turned = [&](const Vec3f& by) {
    return Vec3f(reach * scale * (by - flat * across.dot(by) * across));
  };
  return {across, reach * scale * sum,
          turned(w * one.turn + v * two.turn) + (w * one.slope + v * two.slope) * scale * sum,
          turned(w_slope * (one.across - two.across)) + w_slope * (one.reach - two.reach) * scale * sum};
}

// Of what a frame's wall has in all directions (SkinFrame::walls).
float wall_value(const SkinFrame& frame, float direction, float (&of)(float)) {
  float sum = 0;
  for (std::size_t d = 0; d < SkinFrame::kDirections; ++d) {
    const float off = std::abs(direction - static_cast<float>(d));
    sum += std::max(0.0f, 1 - std::min(off, SkinFrame::kDirections - off)) * of(frame.walls[d]);
  }
  return sum;
}

// The normal of the surface, or, where that is a kink, of the sections alone.
Vec3f wall_normal(const Vec3f& of_surface, const Vec3f& across) {
  const float length = of_surface.norm();
  if (!(length > 0)) return across;
  const Vec3f normal = of_surface / length;
  const float share = std::clamp((normal.dot(across) - kKinkAll) / (kKinkFrom - kKinkAll), 0.0f, 1.0f);
  return (across + share * (normal - across)).normalized();
}

}  // namespace

TubeCylinder make_tube_cylinder(int n, int around) {
  CylinderMaker maker(static_cast<std::size_t>(around));
  TubeCylinder& cylinder = maker.cylinder();
  const std::size_t sections = std::size_t{2} << static_cast<unsigned>(n);
  for (std::size_t s = 0; s < sections; ++s)
    maker.add_section(static_cast<float>(s) / static_cast<float>(sections - 1), 1, 0);
  for (std::size_t s = 0; s + 1 < sections; ++s) maker.add_wall(s);
  cylinder.wall_vertices = cylinder.vertices.size();
  cylinder.wall_triangles = cylinder.triangles.size();
  maker.add_cap(-1);
  maker.add_cap(1);
  cylinder.cap_triangles = (cylinder.triangles.size() - cylinder.wall_triangles) / 2;
  return std::move(cylinder);
}

TubeCost tube_cost(std::size_t frames, int n) {
  if (frames < 2) return {};
  const std::size_t section = TubeCylinder::kAround, cap = section * (1 + TubeCylinder::kCapRings) + 1;
  return {frames - 1, (frames - 1) * section * (std::size_t{2} << static_cast<unsigned>(n)) + 2 * cap};
}

float skin_weight(float z) {
  const float squared = z * z;
  if (squared < 0.25f) return 1 - 2 * squared;
  return (1 - squared) * (1 - squared) / (0.75f + 1.5f * squared);
}

float skin_weight_slope(float z) {
  const float squared = z * z;
  if (squared < 0.25f) return -4 * z;
  const float under = 0.75f + 1.5f * squared, over = 1 - squared;
  return -z * over * (4 * under + 3 * over) / (under * under);
}

float give_way(float bend) {
  if (bend <= kFreeBend) return 1;
  return (kFreeBend + kGivenBend * std::tanh((bend - kFreeBend) / kGivenBend)) / bend;
}

Vertex skinned(const SkinFrame& first, const SkinFrame& second, float radius_m, const CylinderVertex& at) {
  const float w = skin_weight(at.z), v = 1 - w, slope = skin_weight_slope(at.z);
  const Wall one = wall_at(first, at), two = wall_at(second, at);
  const Blend wall = blend(one, two, second.t - first.t, w, slope);
  const Vec3f ahead = one.along * first.ahead * first.t, behind = two.along * second.behind * second.t;
  const Vec3f from = first.origin + at.z * ahead, to = second.origin - (1 - at.z) * behind;
  const Vec3f t = w * first.t + v * second.t;

  // eq. 1: the blend of both frames' matrices, and its derivatives along and around
  Vertex vertex;
  vertex.position = w * from + v * to + radius_m * (at.outwards * wall.out + kCapDepth * at.forward * t);
  const Vec3f along = slope * (from - to) + w * ahead + v * behind + radius_m * wall.along;
  const Vec3f normal = wall_normal(wall.turn.cross(along), wall.across);
  vertex.normal = at.forward == 0 ? normal : (at.outwards * normal + at.forward / kCapDepth * t).normalized();

  // how far the axis has got, of the piece, if it is straight
  const float way = 0.5f * (at.z + v), rest = radius_m * at.outwards;
  vertex.rest = {std::lerp(first.along, second.along, way) + kCapDepth * radius_m * at.forward,
                 rest * at.cosine, rest * at.sine};
  vertex.share = std::lerp(first.share, second.share, way);
  const auto blended = [&](float (&of)(float)) {
    return w * wall_value(first, at.direction, of) + v * wall_value(second, at.direction, of);
  };
  vertex.openness = blended(openness_of);
  vertex.pallor = blended(pallor_of);
  return vertex;
}

MeshData skinned_tube(std::span<const SkinFrame> frames, float radius_m, const TubeCylinder& cylinder) {
  MeshData mesh;
  const std::span vertices(cylinder.vertices);
  const std::span triangles(cylinder.triangles);
  // some vertices of the cylinder between frame p and the next one, and the triangles of those alone
  const auto add = [&](std::size_t p, std::size_t first_vertex, std::size_t vertex_count,
                       std::size_t first_triangle, std::size_t triangle_count) {
    const auto offset = static_cast<std::uint32_t>(mesh.vertices.size() - first_vertex);
    for (const CylinderVertex& at : vertices.subspan(first_vertex, vertex_count))
      mesh.vertices.push_back(skinned(frames[p], frames[p + 1], radius_m, at));
    for (const auto& [a, b, c] : triangles.subspan(first_triangle, triangle_count))
      mesh.triangles.push_back({a + offset, b + offset, c + offset});
  };
  const std::size_t wall = cylinder.wall_vertices, cap = (vertices.size() - wall) / 2;
  for (std::size_t p = 0; p + 1 < frames.size(); ++p) add(p, 0, wall, 0, cylinder.wall_triangles);
  if (frames.size() < 2) return mesh;
  add(0, wall, cap, cylinder.wall_triangles, cylinder.cap_triangles);
  add(frames.size() - 2, wall + cap, cap, cylinder.wall_triangles + cylinder.cap_triangles,
      cylinder.cap_triangles);
  return mesh;
}

}  // namespace omentum::render
