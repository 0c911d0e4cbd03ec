// What the haptic step works on: a constant model, a state that changes, and scratch.
#pragma once

#include "haptic_node/bodies.h"
#include "haptic_node/contact_energy.h"
#include "haptic_node/deformed_surface.h"
#include "haptic_node/spread_contact.h"
#include "haptic_node/tool_kinematics.h"
#include "physics/contact_solver.h"
#include "scene/scene.h"

#include <cstdint>
#include <vector>

namespace omentum::haptic {

/// An instrument as collision sees it.
struct ToolModel {
  std::vector<Vec3> points;                   // [P] p_TP, m; of jaws: closed; of an endoscope none
  bool grasps = false;                        // has jaws (jaws.h)
  double grip_force_n = scene::kGripForce_n;  // what pulls harder slips out of them
  std::optional<Vec3> trocar;                 // pivot in W, m
  std::vector<Vec3> edge;                     // begin and end of what cuts, p_TP, m; or empty
};

/// How a tool's point deforms the triangle that it touches.
enum class ContactMode {
  kPoint,  // the material point follows the tool's: forces shared by barycentric coordinates, continuous over
           // edges
  kSpread,  // the paper's alpha_v: three imposed nodes per contact (Cotin 1999, section 5)
};

/// What a hand was given where one model of tissue that it touches took the place of another, J: in all, and
/// what of it counts for its account, which is never positive in sum: the hand loses what models give for
/// nothing.
struct ModelChanges {
  double given_j = 0, credited_j = 0;

  /// What counts of so much more.
  double credit(double more_j) noexcept {
    given_j += more_j;
    const double credited = std::min(more_j, -credited_j);
    credited_j += credited;
    return credited;
  }
};

/// A surface that yields linearly: an organ with its force tensors.
struct ElasticSurface {
  geometry::Surface surface;
  std::vector<Vec3> rest;  // [S] m
  physics::SurfaceCompliance compliance;
  std::vector<std::uint32_t> file_node;  // [S] place in the mesh file, from 0
};

/// Constant while the node runs; any thread may read.
struct HapticModel {
  // The scene's, in its order: the bodies that are there from the start. The place of one that is felt by
  // local models stays empty: it has no triangles here.
  std::vector<ElasticSurface> organs;
  std::vector<ToolModel> tools;  // their points together: at most physics::kMaxContacts
  double friction = 0;           // Coulomb coefficient
  ContactMode mode = ContactMode::kPoint;
  std::size_t spare_places = 0;  // for bodies that come while the node runs

  std::size_t place_count() const { return organs.size() + spare_places; }
};

/// Throws std::runtime_error when the tools have more points than contacts can be solved for, or none.
void require_solvable(const std::vector<ToolModel>& tools);

/// One tool's point and the material point that it holds, one of each body at most.
struct ToolContact {
  std::int32_t tool = 0, point = 0;
  BodyId body;
  SurfacePoint held{};
  Place place{};                    // of what is held, as follow_surface saw it in this tick
  Vec3 force = Vec3::Zero();        // lambda, on the tissue, N
  Vec3 offset = Vec3::Zero();       // gap that a grasp keeps, m
  Vec3 other_dents = Vec3::Zero();  // other tools' own dents here, which it does not meet (other_tools.h), m
  double sunken_m = 0;              // depth that is no press: the point appeared there (see meet_appeared)
  bool sliding = false;             // friction was used up: the material point moves on
  bool grasped = false;

  bool touches() const { return !force.isZero(0); }
};

/// A force on a body's node, by one tool: opposite to what the hand feels of it.
struct NodeForce {
  BodyId body;
  SurfaceId node;
  std::int32_t tool;
  Vec3 force;                // on the tissue, N
  Vec3 dent = Vec3::Zero();  // the tool's own, by the model (see other_tools.h), m
};

/// A point may appear this deep, m: half a liver.
inline constexpr double kDeepestAppearance_m = 0.06;

/// What is known of a tool's point that holds no contact with a body.
struct PointMemory {
  double clearance_m = 0;  // how far it is from the surface at least
  // inside the body without having come in: it feels nothing until it was outside
  bool adrift = false;
  std::uint8_t ask_in = 0;              // ticks until it is asked where the point is; 0: nobody asks
  double ask_m = kDeepestAppearance_m;  // how deep it is looked for then
  Vec3 way_out = Vec3::Zero();          // the normal of the contact that it lost; zero: any way
  bool enclosed = false;                // if it is inside, tissue came back around it (enclosed_tool.h)
};

/// How a tool's grasps came to nothing: jaws closed and had nothing between them, tissue was pulled out of
/// them, or there was none any more.
struct GraspCounts {
  std::uint64_t empty = 0, torn = 0, lost = 0;
};

struct ToolState {
  bool engaged = false;
  bool let_go = false;  // a contact that carried force was dropped in this tick
  ToolFrame frame;
  Vec3 tip_way = Vec3::Zero();        // in this tick, m
  std::vector<Vec3> before, now;      // [P] points at the last tick and at this one, in W
  double grip_before = 0, grip = 0;   // opening of its jaws at both, rad
  std::vector<PointMemory> memories;  // [places of bodies][P]
  bool near_others = false;           // it may press nodes that another tool presses
  double others_m = 0;                // how deep the other tools' own dents around it are at most, m
  bool opened = false;                // the jaws were open since the last grasp
  bool grasping = false;
  int overpulled_ticks = 0;  // in a row in which what they hold was pulled harder than they grip
  std::uint64_t grasp_count = 0;
  GraspCounts grasps;
  ModelChanges changes;

  PointMemory& memory(BodyId body, std::size_t point) noexcept {
    return memories[static_cast<std::size_t>(body) * now.size() + point];
  }
};

/// Everything that one tick hands to the next.
struct HapticState {
  explicit HapticState(const HapticModel& model);

  std::uint64_t ticks = 0;
  std::int64_t now_ns = 0;  // of the coming tick, on the clock that bodies which move by themselves know
  std::int64_t tissue_back_until_ns = 0;  // on that clock: a reset's tissue comes back as yet
  std::vector<ToolState> tools;
  std::vector<ContactEnergy> energies;  // [tools]
  std::array<ToolContact, physics::kMaxContacts> contacts;
  int contact_count = 0;
  std::array<NodeForce, Body::kMaxForces> node_forces;  // distinct (body, node, tool)
  int node_force_count = 0;

  std::span<ToolContact> active() { return {contacts.data(), static_cast<std::size_t>(contact_count)}; }
  std::span<const ToolContact> active() const {
    return {contacts.data(), static_cast<std::size_t>(contact_count)};
  }
  std::span<const NodeForce> forces() const {
    return {node_forces.data(), static_cast<std::size_t>(node_force_count)};
  }
};

/// Scratch, and what can be recomputed from model and state. The model must outlive it.
struct HapticWorkspace {
  explicit HapticWorkspace(const HapticModel& model);

  Bodies bodies;
  std::vector<BodyDoor> doors;     // [places]
  std::vector<ContactWork> works;  // [tools]
  std::array<Share, physics::kMaxContacts> shares;
  // of the contacts, m and N: p - X without and with the tissue's displacement, the last tick's forces, and
  // what the solver makes of them
  std::array<Vec3, physics::kMaxContacts> free_gaps, gaps, before, forces;
  physics::ContactProblem problem;
  physics::ContactWorkspace solver;
  SpreadWorkspace spread;
};

}  // namespace omentum::haptic
