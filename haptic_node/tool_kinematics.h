// Where an instrument's points are.
#pragma once

#include "geometry/types.h"

#include <Eigen/Geometry>

#include <optional>

namespace omentum::haptic {

using geometry::Vec3;

/// A tool's pose in the scene's frame W; T: origin at the tip, z along the shaft to the handle.
struct ToolFrame {
  Vec3 p_WT = Vec3::Zero();                                  // tip, m
  Eigen::Quaterniond q_WT = Eigen::Quaterniond::Identity();  // unit
};

/// A measured pose with the five degrees of freedom that a trocar leaves (geometry/trocar.h).
ToolFrame through_trocar(const ToolFrame& measured, const Vec3& pivot) noexcept;

/// p_WP = p_WT + R_WT p_TP.
inline Vec3 to_world(const ToolFrame& frame, const Vec3& p_TP) noexcept {
  return frame.p_WT + frame.q_WT * p_TP;
}

/// The rotation vector (axis times angle, rad, in W) that turns `from` into `to` the short way.
Vec3 rotation_between(const Eigen::Quaterniond& from, const Eigen::Quaterniond& to) noexcept;

}  // namespace omentum::haptic
