#include "haptic_node/contact_energy.h"

#include "geometry/precondition.h"

#include <algorithm>
#include <cmath>

namespace omentum::haptic {
namespace {

// What a mesh makes of a joule that is put in, more or less, as a share; and what is never owed to a hand's
// account, whichever way the hand goes.
constexpr double kMissed = 0.08, kOwed = 0.3;

// What a first touch may hold without having been brought, J: 10 mN over 200 um.
constexpr double kTouch_j = 1e-6;

// The part of a tip's way that goes along the surface.
Vec3 along_surface(const Vec3& v, const Vec3& push) {
  const double squared = push.squaredNorm();
  return squared > 0 ? Vec3(v - v.dot(push) / squared * push) : v;
}

// An average over the way, not over time: a resting hand keeps its heading.
void turn_heading(Vec3& heading, const Vec3& way, const Vec3& push) {
  const double share = std::min(1.0, way.norm() / kHeading_m);
  heading = along_surface((1 - share) * heading + way / kHeading_m, push);
  const double length = heading.norm();
  if (length > 1) heading /= length;
}

// A push over a depth holds half of their product.
double depth_of(const ContactWork& work) {
  return 2 * work.stored_j / work.push.norm();
}

// A dent that is next to none decides nothing.
double weight_of(const ContactEnergy& tool) {
  const double shallow = kShallow_m * kShallow_m / (tool.depth_m * tool.depth_m);
  return 1 / (1 + shallow * shallow);
}

// A'. What went with a contact that was let go of is lost; what the other points hold more, for taking over
// its load, nobody brought.
double account_of(const ContactEnergy& tool, const ContactWork& work, double taken_j, bool let_go) {
  const double kept_j = tool.account_j / tool.stored_j * work.stored_j;
  const double paid_j =
      tool.account_j + tool.share * (work.put_in_j - work.rubbed_j) + work.exchanged_j - taken_j;
  const double held_j = kept_j + (paid_j - kept_j) * weight_of(tool);
  return let_go ? std::min(kept_j, held_j) : held_j;
}

// kappa_s', less what the side force took.
double slid_of(const ContactEnergy& tool, const ContactWork& work, double taken_j) {
  const double worked = 0.5 * (work.put_in_j - work.rubbed_j + work.got_j) / work.stored_j;
  const double push_n = work.push.norm();
  const double grown = push_n > 0 ? std::max(1 - tool.push_n / push_n, -1.0) : 0;
  return tool.slid -
         weight_of(tool) * (tool.slid * work.sliding * (grown - worked) + taken_j / work.stored_j);
}

// beta'.
double leaving_of(const ContactEnergy& tool, const ContactWork& work) {
  // where less is covered than is held, it is settled before that is given
  const double held_j = std::max(std::min(work.stored_j, work.covered_j), kNoEnergy_j);
  const double left = std::exp(-std::abs(work.put_in_j) / (work.put_in_j > 0 ? work.stored_j : held_j));
  return work.put_in_j > 0 ? tool.leaving * left : 1 - (1 - tool.leaving) * left;
}

// kappa': by beta, and settled where more than meshes miss is owed, whichever way the hand goes.
double share_of(const ContactEnergy& tool, const ContactWork& work, double most) {
  const double paid = tool.account_j / work.stored_j;
  const double owed = 1 - paid / std::max(tool.slid, kMissed);
  const double s = std::clamp((owed - kMissed) / (kOwed - kMissed), 0.0, 1.0);
  const double settled = 1 - (1 - tool.leaving) * (1 - s * s * (3 - 2 * s));
  const double given_back = std::min(paid, work.covered_j / work.stored_j);
  return std::clamp(tool.slid + settled * (given_back - tool.slid), 0.0, most);
}

// Who touches holds no more than was brought, whatever the model makes of it in one tick: two tools deep in
// one place take each other's load.
void begin(ContactEnergy& tool, const ContactWork& work) {
  const double brought_j = std::max(work.put_in_j + work.exchanged_j, kTouch_j);
  tool.account_j = std::min(brought_j, work.stored_j);
  tool.share = share_of(tool, work, kMaxShare);
}

// What pays for a place that differs. A hand that turns round has it along its way until it has forgotten
// where it came from: no more than is covered.
Vec3 side_of(const ContactEnergy& tool, const ContactWork& work) {
  const Vec3 side = (tool.share - 1) * work.stored_j / kForget_m * tool.heading;
  const double side_n = side.norm(), most_n = work.covered_j / kHeading_m;
  return side_n > most_n ? Vec3(most_n / side_n * side) : side;
}

void follow(ContactEnergy& tool, const ContactWork& work, bool let_go) {
  const double most = std::min(kMaxShare, 1 + kMostApart_m / tool.depth_m), before = tool.share;
  const Vec3 way = along_surface(work.way, work.push);
  const double taken_j = tool.side.dot(way);  // by the side force
  tool.account_j = account_of(tool, work, taken_j, let_go);
  tool.slid = std::clamp(slid_of(tool, work, taken_j), 0.0, most);
  tool.leaving = leaving_of(tool, work);
  tool.share = share_of(tool, work, most);
  turn_heading(tool.heading, way, work.push);
  const Vec3 side = side_of(tool, work);
  // the hand's work is that of both ends' mean
  tool.account_j += 0.5 * ((tool.share - before) * work.put_in_j - (side - tool.side).dot(way));
  tool.side = side;
}

}  // namespace

void balance(std::span<ContactEnergy> tools, std::span<const ContactWork> works, bool let_go) noexcept {
  geometry::require(tools.size() == works.size(), "work for each tool");
  for (std::size_t t = 0; t < tools.size(); ++t) {
    ContactEnergy& tool = tools[t];
    const ContactWork& work = works[t];
    if (work.stored_j < kNoEnergy_j) {
      tool = ContactEnergy{};
      continue;
    }
    tool.depth_m = depth_of(work);
    if (tool.stored_j >= kNoEnergy_j)
      follow(tool, work, let_go);
    else
      begin(tool, work);
    tool.stored_j = work.stored_j;
    tool.push_n = work.push.norm();
  }
}

}  // namespace omentum::haptic
