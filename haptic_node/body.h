// What tools can touch, and all that collision and contact ask of it.
#pragma once

#include "haptic_node/contact_nodes.h"

#include <optional>
#include <span>

namespace omentum::haptic {

using geometry::TriangleId;

/// Which of the bodies that tools can touch (Bodies), from 0.
using BodyId = geometry::Index<struct BodyTag>;

/// A material point of a body: a triangle of it and barycentric coordinates there.
struct SurfacePoint {
  TriangleId triangle;
  Vec3 barycentric = Vec3::Zero();
};

/// How far something went since the last tick without the tools' doing.
struct Drift {
  Vec3 way = Vec3::Zero();    // m, all of it
  Vec3 blend = Vec3::Zero();  // m, of it from where a model that was replaced stood to the one that did
};

/// What is known of a material point.
struct Place {
  Vec3 position = Vec3::Zero();  // m, in W
  Vec3 rest = Vec3::Zero();      // without forces, m
  Vec3 normal = Vec3::UnitZ();   // in which direction tissue pushes there, unit, outward
  PointNodes nodes;              // that share a force there, by its barycentric coordinates
  Drift drift;                   // of `rest`
};

struct Region {
  Vec3 low, high;  // m, in W
};

/// Where something enters a body: the parameter along the segment and the material point.
struct Entry {
  double parameter;
  SurfacePoint point;
};

/// What a tool's point met on its way from p to q.
struct Encounter {
  /// Where it touches: where the surface passed over it by the last accept (then p is inside, no deeper than
  /// anything near moved), else its first entry.
  std::optional<SurfacePoint> touched;
  /// How far q is from the surface, m; the radius asked for where that is farther.
  double clearance_m;
  /// The surface point nearest to q; nothing where that is farther than the radius, or q is inside.
  std::optional<SurfacePoint> nearest;
};

/// Where a point that did not come by moving is inside a body.
struct Immersion {
  SurfacePoint nearest;  // of all the surface
  double depth_m;
};

/// Whose a body is, for the messages about it.
struct BodyOrigin {
  std::uint32_t organ = 0;             // index into the scene's organs
  std::uint64_t topology_version = 0;  // of that organ
  // [nodes] place in the mesh file, from 0; empty: nobody is told of its contacts
  std::span<const std::uint32_t> file_node;
  std::optional<std::size_t> tool = std::nullopt;  // of the model: it alone touches the body; none: any does
};

/// Something with a surface under the forces of the last solve, linear around where it is. A precomputed
/// organ is one (DeformedSurface), and so is whatever else a hand can press: haptic_step knows nothing more.
///
/// Every function may be called in a tick: none allocates, waits or throws. One thread at a time. What it is
/// made of must outlive it.
class Body : public NodeCompliance {
 public:
  /// Nodes that may carry a force at a time.
  static constexpr int kMaxForces = ContactNodes::kSlots;

  /// How far around a region the surface is made exact, m. Tissue that passes over a resting point goes less
  /// far in one tick (2 m/s at 1 kHz); a point that is deeper came there otherwise (see immersion()).
  static constexpr double kReach_m = 2e-3;

  Body(const BodyOrigin& origin, std::int32_t mobile_nodes)
      : origin_(origin), contact_nodes_(*this, mobile_nodes) {}
  Body(const Body&) = delete;
  Body& operator=(const Body&) = delete;

  const BodyOrigin& origin() const noexcept { return origin_; }
  /// Of its nodes in contact, C_AA.
  ContactNodes& contact_nodes() noexcept { return contact_nodes_; }

  bool is_for(std::size_t tool) const noexcept { return origin_.tool.value_or(tool) == tool; }

  // ---- what it does by itself

  /// Goes to where it is without forces at `now_ns` (HapticState), before anything else is asked in a tick.
  virtual void go_on(std::int64_t /*now_ns*/) noexcept {}
  virtual Drift drift(SurfaceId /*node*/) const noexcept { return {}; }
  /// How far a node is without these forces from its rest in the organ's file, m.
  virtual Vec3 moved_without_forces(SurfaceId /*node*/) const noexcept { return Vec3::Zero(); }
  /// It has just come to the place of `old`, under the same forces: begins where that stands.
  virtual void continue_from(Body& /*old*/, std::int64_t /*now_ns*/) noexcept {}

  // ---- forces

  /// At rest, whatever was there: no forces, nothing remembered.
  virtual void restore_rest() noexcept = 0;
  /// The forces that may follow, any number of times, and that they do, once per tick. `nodes` mobile and
  /// distinct, at most kMaxForces; `forces` in N.
  virtual void propose(std::span<const SurfaceId> nodes, std::span<const Vec3> forces) noexcept = 0;
  virtual void accept() noexcept = 0;
  /// How far at most a material point goes by what was proposed, m.
  virtual double motion_bound(const SurfacePoint& point) const noexcept = 0;
  /// Nodes that carry a force / whose positions were found since the last accept.
  virtual int loaded_nodes() const noexcept = 0;
  virtual int evaluated_nodes() const noexcept = 0;

  // ---- collision

  /// Makes exact whatever may be within kReach_m of the region.
  virtual void evaluate(const Region& region) noexcept = 0;
  /// What a point that went from p to q, inside an evaluated region, met on its way. `outside`: at p, before
  /// the last accept; else what the surface did there says nothing. `radius_m`: at most kReach_m, and as much
  /// more as p and q are inside of the region.
  virtual Encounter meet(const Vec3& p, const Vec3& q, double radius_m, bool outside) noexcept = 0;
  /// Nothing when p is outside, or deeper than `reach_m`. Evaluates what it needs around p: microseconds to a
  /// millisecond, for the tick in which a tool appears.
  virtual std::optional<Immersion> immersion(const Vec3& p, double reach_m) noexcept = 0;
  /// How far at most the last accept moved anything that was exact before it and is exact now, m / that is
  /// exact now and was not before: it was out of reach then.
  virtual double known_motion() const noexcept = 0;
  virtual double entered_motion() const noexcept = 0;

  // ---- material points

  /// The closest material point to p that is reached from `from` without leaving the surface, always nearer.
  virtual SurfacePoint slide(const SurfacePoint& from, const Vec3& p) noexcept = 0;
  /// Fills all of `place`.
  virtual void find_place(const SurfacePoint& point, Place& place) noexcept = 0;
  Place place_of(const SurfacePoint& point) noexcept {
    Place place;
    find_place(point, place);
    return place;
  }
  /// Its position alone.
  virtual Vec3 position(const SurfacePoint& point) noexcept = 0;
  /// How much tissue something at p that presses a material point in has before it, as a share of what there
  /// is at rest; 1 where nothing is squeezed or nobody knows.
  virtual double tissue_ahead(const SurfacePoint& point, const Vec3& p) noexcept = 0;
  /// The material point that is nearest to p, at most `reach_m` away, of a body that has borne no force yet.
  virtual std::optional<SurfacePoint> nearest_at_rest(const Vec3& p, double reach_m) noexcept = 0;
  /// The one that lies among nodes of such numbers in the mesh file with these barycentric coordinates, if
  /// this body has that triangle and numbers.
  virtual std::optional<SurfacePoint> point_among(std::span<const std::uint32_t> /*file_nodes*/,
                                                  const Vec3& /*barycentric*/) const noexcept {
    return std::nullopt;
  }
  /// Where a node is, m; and how far its own triangles reach from it, m.
  virtual const Vec3& position(SurfaceId node) noexcept = 0;
  virtual double longest_edge(SurfaceId node) const noexcept = 0;

 private:
  BodyOrigin origin_;
  ContactNodes contact_nodes_;
};

}  // namespace omentum::haptic
