#include "render_node/plausible.h"

#include "geometry/boxes.h"
#include "node_common/contact_bounds.h"
#include "node_common/vectors.h"

#include <cmath>
#include <numbers>

namespace omentum::render {
namespace {

constexpr double kRounding = 1e-9;                    // of a clamped force's length, relative
constexpr double kRotationOff = 0.1;                  // of a quaternion's length from 1
constexpr double kWidestGrip_rad = std::numbers::pi;  // jaws that point backwards

}  // namespace

// each comparison is false for NaN
bool is_plausible(const msg::ToolPose& pose) {
  const msg::Quat& q = pose.orientation;
  return node::to_vector(pose.position).norm() <= kRoom_m &&
         std::abs(Eigen::Vector4d(q.w, q.x, q.y, q.z).norm() - 1) <= kRotationOff &&
         std::abs(pose.grip) <= kWidestGrip_rad;
}

bool is_plausible(const msg::ToolForce& force, double max_force_n) {
  return node::to_vector(force.force).norm() <= max_force_n * (1 + kRounding);
}

bool is_plausible(const msg::Contact& contact, double max_force_n) {
  return node::within_scene(node::total_force_n(contact), max_force_n);
}

double reach_of(std::span<const Vec3> rest) {
  return kReachDiagonals * geometry::diagonal_around(rest);
}

}  // namespace omentum::render
