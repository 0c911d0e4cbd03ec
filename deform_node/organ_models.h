// What deform_node knows of an organ's physics: loads and cuts in, a state to publish out.
#pragma once

#include "deform_node/local_patch.h"
#include "deform_node/organ_contact.h"
#include "geometry/types.h"
#include "physics/touch.h"

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string_view>

namespace omentum::deform {

class StrainGauge;

using geometry::NodeId;
using geometry::SurfaceId;
using geometry::Vec3;

/// What one tool does to one organ at this moment. Equal lengths; the nodes are the mesh's, the same whatever
/// is cut, and none is held in all directions. A model that can be cut leaves out what is not attached any
/// more; for one that cannot, all are of its surface.
struct ToolLoad {
  std::uint32_t tool = 0;
  std::span<const NodeId> nodes;
  std::span<const Vec3> displacements;  // imposed u of each node, in W, m
  std::span<const Vec3> forces;         // on the tissue, in W, N, times `gain`
  double gain = 1;                      // below 1: its hand fell silent, and lets go
  bool grasps = false;                  // holds the nodes: they go where it goes, in any direction
};

/// What a tool's cutting edge swept since the last tick: the two ruled triangles between both places.
struct CutStroke {
  std::uint32_t tool = 0;
  std::uint64_t cut = 0;             // strokes of one cut have the same number
  std::array<Vec3, 2> from{}, to{};  // the edge's two ends, in W, m
};

/// What is done to one organ in a tick.
struct TickLoads {
  std::span<const ToolLoad> presses;
  std::span<const CutStroke> cuts;
};

/// What the values of a state are, numbered as OrganState.kind (KIND_* of idl/organ.idl).
enum class StateKind : std::uint32_t {
  kSurface = 0,  // displacement of every surface node in SurfaceId order, pinned ones included, in W, m
  kTube = 1,     // position of every mass of axis and mesentery, in W, m
};

/// An organ as it is now. Valid until the model's next step() or reset().
struct OrganView {
  StateKind kind = StateKind::kSurface;
  std::uint64_t topology_version = 0;  // rises with every change of what is removed, also with a reset
  std::span<const float> values;       // x y z, one after the other: [3 n]
  std::span<const std::uint8_t> removed_bits{};  // bit t % 8 of byte t / 8: tetrahedron t; empty: none is
  std::span<const std::uint8_t> burnt_bits{};    // those of them that an edge burnt away, likewise
  // Of a body that has more than its surface, whose values above are of it; else empty.
  std::span<const double> body_u{};   // displacements of all nodes of the mesh, [3N], m
  std::span<const NodeId> surface{};  // whose the state's values are, in its order
};

/// What cutting edges did to an organ.
struct CutAccount {
  double way_m = 0;         // of their middles, through the organ as it was before any cut
  std::uint32_t tools = 0;  // bit t: in the newest step the edge of tool t met the organ
  double lost_m3 = 0;       // tissue that went for it: burnt, and what then hung on a node or an edge
};

/// How an organ that meets itself and walls fared.
struct CollisionAccount {
  std::uint64_t contacts = 0;   // that pushed, each step's counted
  std::uint64_t held_back = 0;  // times a mass was kept from going so far that something could have crossed
  std::uint64_t left_out = 0;   // contacts that found no room: nothing held them apart but the above
  double deepest_m = 0;         // the largest overlap that a step left
};

/// What a model says of itself. Counters count since the start, over resets, unless they say otherwise.
struct ModelStatus {
  std::uint64_t steps = 0;
  double simulated_s = 0;                 // what it lived through; 0: it has no time of its own
  std::uint32_t removed_tetrahedra = 0;   // now: a reset brings them back
  std::uint32_t repaired_tetrahedra = 0;  // removed because they hung on one node or edge; nobody cut them
  CutAccount cuts{};
  std::optional<CollisionAccount> collisions{};  // none: it does not look for them
  bool diverged = false;     // its state is beyond help: it must be reset, and not be published
  std::string_view fault{};  // of this step, a text that lives as long as the program; empty: none
};

/// How large a model's outputs become at most, so that others take their memory beforehand.
struct ModelSizes {
  std::size_t values = 0;         // of OrganView
  std::size_t removed_bytes = 0;  // of OrganView
  std::size_t local_nodes = 0;    // of a LocalPatch; 0: it offers none
  std::size_t spheres = 0;        // that other organs can meet
  // How many times more or less than a sphere's own mass a push may have to move, as far as it is foreseen
  // what the push does: on more of an organ, or on as much for many spheres.
  double most_scale = 200;
  std::size_t body = 0;  // of OrganView::body_u; its surface is as large as a third of `values`
  bool costs = false;    // its step is worth a thread
  // Among models that do, a tick begins with the pushes of the last one, which offered velocities have in
  // them.
  bool keeps_pushes = false;
};

/// One organ's deformation. The quasi-static, tensor-mass, hybrid and intestine models each are one of
/// these; deform_node knows nothing else of them. One thread at a time, not always the same. What is noexcept
/// allocates nothing.
class OrganModel {
 public:
  virtual ~OrganModel() = default;

  /// Fixed from the start on.
  virtual ModelSizes sizes() const = 0;

  /// Advances by dt_s (fixed for a run) under the loads of this moment.
  virtual void step(const TickLoads& loads, double dt_s) noexcept = 0;

  /// Back to rest, and whole.
  virtual void reset() noexcept = 0;

  /// At rest, with exactly these tetrahedra removed, as a model of the same organ left them in another
  /// process. `version` is above its own. An organ that cannot be cut ignores it.
  virtual void take_up(std::span<const std::uint8_t> /*removed_bits*/,
                       std::span<const std::uint8_t> /*burnt_bits*/, std::uint64_t /*version*/) noexcept {}

  virtual OrganView view() const noexcept = 0;
  virtual ModelStatus status() const noexcept = 0;

  /// A small model of the surface around `place` that haptic_node can press between two states, written into
  /// `patch`. False: none is offered there, as by an organ whose compliance every node has.
  virtual bool local_model(const PatchPlace& /*place*/, LocalPatch& /*patch*/) const noexcept {
    return false;
  }

  /// What measures its strain and stress from its views, on a thread of its own (strain_gauge.h), while this
  /// lives; null: nobody does.
  virtual std::unique_ptr<StrainGauge> strain_gauge() const;

  /// What other organs may meet, at this moment; valid as a view is.
  virtual std::span<const CollisionSphere> collidable() const noexcept { return {}; }
  /// What they met, after all organs' steps; empty in most ticks, and then not called. Otherwise some times
  /// in a tick, with what the calls before left to do: each asks collidable() how fast the spheres are now.
  virtual void respond(std::span<const OrganContact> /*contacts*/) noexcept {}

  /// Where it touches itself after its newest step, up to as many as `found` has; how many. Of one that does
  /// not look for that: nowhere.
  virtual std::size_t touches_itself(std::span<physics::Touch> /*found*/) const noexcept { return 0; }
};

}  // namespace omentum::deform
