#include "haptic_node/contact_energy.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace omentum::haptic {
namespace {

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

// kappa' E': what the hand put in and got from others, less what it got back. A dent that is next to none
// keeps its share. What went with a contact that was let go of is lost; what the other points hold more, for
// taking over its load, nobody brought.
double held(const ContactEnergy& tool, const ContactWork& work, bool let_go) {
  const double kept_j = tool.share * work.stored_j;
  const double paid_j = tool.share * (tool.stored_j + work.put_in_j - work.rubbed_j) + work.exchanged_j;
  const double held_j = kept_j + (paid_j - kept_j) / (1 + std::pow(kShallow_m / tool.depth_m, 4));
  return let_go ? std::min(kept_j, held_j) : held_j;
}

}  // namespace

void balance(std::span<ContactEnergy> tools, std::span<const ContactWork> works, bool let_go) noexcept {
  assert(tools.size() == works.size());
  for (std::size_t t = 0; t < tools.size(); ++t) {
    ContactEnergy& tool = tools[t];
    const ContactWork& work = works[t];
    if (work.stored_j < kNoEnergy_j) {
      tool = ContactEnergy{};
      continue;
    }
    tool.depth_m = depth_of(work);
    if (tool.stored_j >= kNoEnergy_j) {
      const Vec3 way = along_surface(work.way, work.push);
      const double held_j = held(tool, work, let_go) - tool.side.dot(way);
      tool.share =
          std::clamp(held_j / work.stored_j, 0.0, std::min(kMaxShare, 1 + kMostApart_m / tool.depth_m));
      turn_heading(tool.heading, way, work.push);
    }
    tool.stored_j = work.stored_j;
    tool.side = (tool.share - 1) * tool.stored_j / kForget_m * tool.heading;
  }
}

}  // namespace omentum::haptic
