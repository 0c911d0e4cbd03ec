// What a hand gets back from the tissue is what it put in: the force that it feels follows from that.
#pragma once

#include "geometry/types.h"

#include <algorithm>
#include <limits>
#include <span>

namespace omentum::haptic {

using geometry::Vec3;

/// One tool's contacts between ticks, as energy sees them.
struct ContactEnergy {
  double stored_j = 0;          // E: elastic energy that the model says they hold, and what is lent
  double lent_j = 0;            // to tissue that moves by itself, less what came back
  double account_j = 0;         // A: what the hand put in, less what it got back
  double push_n = 0;            // f: by the model
  double depth_m = 0;           // of the dent, over which a push that grows with it holds E
  double slid = 1;              // kappa_s: the share that sliding asks for
  double leaving = 0;           // beta: 0 on the way in, 1 on the way out
  double share = 1;             // kappa: of the model's force that the hand feels
  Vec3 side = Vec3::Zero();     // along the surface, on the hand at the tip, N
  Vec3 heading = Vec3::Zero();  // where the tip slides, averaged over the last way; at most 1 long
};

/// What happened to one tool's contacts in a tick, by the model's own forces.
struct ContactWork {
  double stored_j = 0;     // E after the solve
  double put_in_j = 0;     // work that moving the tool against these forces took (trapezoidal rule)
  double rubbed_j = 0;     // of it, what friction turned into heat
  double got_j = 0;        // what others gave it through the tissue
  double exchanged_j = 0;  // the same as hands feel it; none in sum where the tissue does not move by itself
  double own_j = 0;        // what tissue that moves by itself gave it ...
  double changed_j = 0;    // ... and of that on its way from one model to the next
  // what may be given to the hand from now on, whatever the account says
  double covered_j = std::numeric_limits<double>::infinity();
  double sliding = 0;        // s: how far its points' ways were slides and not presses, 0 to 1
  Vec3 push = Vec3::Zero();  // on the tissue, N
  Vec3 way = Vec3::Zero();   // of the tip, m
};

/// The largest share: a hand that brought more energy than this place would hold gets it back, but is never
/// pushed by more than this many times the model's force.
inline constexpr double kMaxShare = 2;

/// A dent that is not deeper than this decides nothing, m: facets and interpolated normals differ by as much,
/// and what they make of the first touch would be multiplied into the whole press, the more the shorter the
/// ticks are. It forgives less than a hundredth of the energy of 1 mm.
inline constexpr double kShallow_m = 8e-5;

/// How far a tool may be from the surface that it presses, m: the dent is the share times as deep as the tool
/// is in it. Above it: energy beyond is let go of. Below it: from there on the tissue follows (borne_share).
inline constexpr double kMostApart_m = 4e-3;

/// How far the side force may push a dent of centimetres aside, m, as if the tissue gave way sideways as
/// inwards (twice as far was seen at a thin border).
inline constexpr double kMostAside_m = 1e-3;

/// Over which way along the surface the share returns to one, m: the side force that does it stays below a
/// tenth of the push in a dent of 6 mm, and what a press felt like elsewhere is forgotten three fingers away.
inline constexpr double kForget_m = 0.04;

/// Over which way the heading is averaged, m: a hand that trembles or turns round feels no step of the side
/// force.
inline constexpr double kHeading_m = 0.005;

/// Energy below this is none, J: 1 mN over 10 um holds five thousand times as much.
inline constexpr double kNoEnergy_j = 1e-12;

/// A point contact that slides over a mesh is not conservative by itself: the compliance under it changes
/// from node to face (by half on coarse meshes), normals are interpolated, facets are flat; the stored energy
/// E(p) then rises and falls without the hand's doing, and closed paths gave back up to 430 % of what was put
/// in. The missing force is -dE/dp, but over a mesh that is a rasp of several newtons. So an account is kept
/// instead, A, of what the hand put in, less what it got back:
///     f = kappa f_model,   A' = A + kappa put_in + exchanged,   kappa = kappa_s + beta (A / E - kappa_s).
/// Where a tool slides, kappa_s keeps the push what it was; worked is what the hand's way and other hands
/// make of it, if a push grows with depth:
///     kappa_s' = kappa_s (1 - s ((f' - f) / f' - worked)),   worked = (put_in - rubbed + got) / 2 E'.
/// On the way in (beta = 0) nothing else is done: who presses feels the model's own force. On the way out
/// beta goes to one, by e-folds of the energy that is given back, and with it kappa to A / E: so a closed
/// path has no net energy, and the force reaches zero where the model's does. It goes there at once where the
/// hand got back more than meshes miss. Where less than A is covered (ContactWork::covered_j), kappa E goes
/// to that instead, and by e-folds of it: tissue that moves by itself, and is told of late, fills A with
/// energy that no hand brought. (With kappa = A / E on the way in as well, each per cent by which a mesh
/// misses E = work compounds over the decades that E goes through: by 14 % to either side on a coarse liver,
/// and by who came first where two hands press.) On the wire the tissue bears what the hand feels: its dent
/// is kappa times as deep as the tool is in it, as if kappa's difference from one were a spring between the
/// two.
///
/// A place that differs for good (stiffer near a support) is paid for along the way: a force against the
/// heading, (1 - kappa) E / kForget_m, brings kappa_s back to one; its work is in the account. A hand that
/// turns round has it along its way for kHeading_m, so that it is never more than what is covered over that:
/// tissue that is told of late may hold joules that nobody brought, of which kappa lets nothing through.
///
/// `tools` and `works`: one per tool. `let_go`: a contact that carried force was dropped in this tick; what
/// it held is lost, and what the others then hold is no more than was put in. No allocation. Any thread.
void balance(std::span<ContactEnergy> tools, std::span<const ContactWork> works, bool let_go) noexcept;

/// The share of the model's force that the tissue bears: the hand's, but in presses of centimetres never so
/// much less than one that the tool would be kMostApart_m deep in tissue, or through a thin lobe that it
/// bends away.
inline double borne_share(const ContactEnergy& tool) noexcept {
  return std::max(tool.share, 1 - kMostApart_m / std::max(tool.depth_m, kMostApart_m));
}

/// The side force that the tissue bears under a push, N: the hand's, but in presses of centimetres only so
/// much that the tissue stays with its tool.
inline Vec3 borne_side(const ContactEnergy& tool, double push_n) noexcept {
  const double most_n = push_n * kMostAside_m / std::max(tool.depth_m, kMostAside_m);
  const double side_n = tool.side.norm();
  return side_n > most_n ? Vec3(most_n / side_n * tool.side) : tool.side;
}

}  // namespace omentum::haptic
