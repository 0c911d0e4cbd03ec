// An instrument in a trocar as a lever between the hand at its handle and the tissue at its tip.
#pragma once

#include "device_bridge/device.h"

namespace omentum::device {

/// Five degrees of freedom: the handle's place gives the shaft's direction (pivot) and how deep it is in
/// (insertion), the handle's turn about the shaft gives roll, and the jaws the grip. With c the pivot, H the
/// handle, r = |p_H - c| what is outside, and L the shaft's length:
///
///     z = (p_H - c) / r,   p_T = p_H - L z,   v_T = z z^T v_H + (1 - L / r) (I - z z^T) v_H
///
/// Across the shaft the tip goes the other way, by (L - r) / r as far; along it as far as the handle.
struct TrocarLever {
  Vec3 pivot = Vec3::Zero();   // c, in W, m
  double length_m = 0.3;       // L, from the tip to the handle
  double least_outside_m = 0;  // nearer to the pivot no handle is believed: r at least, above 0
};

/// Whether the handle's pose says where the tip is: it is not too near to the pivot, and its own z, the
/// shaft's direction towards the hand as the device measured it, is less than 120 degrees off.
bool goes_through(const TrocarLever& lever, const Measurement& handle) noexcept;

/// The tip's pose and velocities, of a handle that goes_through(). Its roll is the handle's after the
/// smallest turn m -> z of its own axis m onto the shaft (as geometry/trocar), with the spin
///
///     w_T = z x v_H / r + rho z,   rho = (w_H . (m + z) - m . (z x v_H) / r) / (1 + m . z)
///
/// which is w_H . z of a handle that points along its shaft.
Measurement at_tip(const TrocarLever& lever, const Measurement& handle) noexcept;

/// What a wrench at the tip (torque about it) is on the handle: the transpose of at_tip()'s velocities, so
/// that f_H . v_H + t_H . w_H = f_T . v_T + t_T . w_T however the handle moves.
Wrench at_handle(const TrocarLever& lever, const Measurement& handle, const Wrench& at_tip) noexcept;

/// The handle's pose and velocities, of a tip that is not at the pivot and a shaft that is held as it points:
/// the inverse of at_tip(). The shaft is rigid, so that the handle turns as the tip does.
Measurement at_handle(const TrocarLever& lever, const Measurement& tip) noexcept;

/// The largest (L - r) / r of the lever, or 1, which it has along the shaft: the tip goes as many times as
/// far as the handle, and the handle feels as many times its force.
double largest_ratio(const TrocarLever& lever) noexcept;

}  // namespace omentum::device
