#include "haptic_node/hold_lead.h"

namespace omentum::haptic {
namespace {

Vec3 half_of(const Vec3& change, const Vec3& whole) {
  const double length = change.norm(), most = whole.norm();
  return length > most ? Vec3(0.5 * most / length * change) : Vec3(0.5 * change);
}

}  // namespace

Wrench HoldLead::ahead(const Wrench& model, bool new_pose, const Vec3& tip) noexcept {
  if (new_pose) {
    const bool moves = known_ && (tip - tip_).norm() > kResting_m;
    lead_ = {};
    if (moves) {
      lead_ = {half_of(model.force - answered_.force, model.force),
               half_of(model.torque - answered_.torque, model.torque)};
    }
    known_ = true;
    tip_ = tip;
    answered_ = model;
  }
  // contact that ended between two poses has no force to add to
  if (model.force.isZero(0)) return model;
  return {model.force + lead_.force, model.torque + lead_.torque};
}

}  // namespace omentum::haptic
