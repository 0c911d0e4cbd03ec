#include "haptic_node/device_book.h"

#include <algorithm>

namespace omentum::haptic {

const char* describe(LimitField field) noexcept {
  constexpr std::array<const char*, kLimitFields> kNames{"max_force_n", "max_torque_nm", "max_stiffness_n_m"};
  return kNames[field];
}

std::span<const RefusedLimit> DeviceBook::hear(const msg::DeviceInfo& info,
                                               const transport::WriterId& writer) noexcept {
  const auto is_his = [&](const Said& said) { return said.limits && said.writer == writer; };
  auto place = std::find_if(said_.begin(), said_.end(), is_his);
  DeviceLimits limits = place != said_.end() ? *place->limits : limits_;
  read(info, limits);
  if (place == said_.end())
    place = std::find_if(said_.begin(), said_.end(), [](const Said& said) { return !said.limits; });
  if (place != said_.end()) {
    *place = {writer, limits};
  } else {
    further_ = further_ ? stricter(*further_, limits) : limits;
  }
  combine();
  return {refused_.data(), refused_count_};
}

void DeviceBook::gone(const transport::WriterId& writer) noexcept {
  for (Said& said : said_) {
    if (said.limits && said.writer == writer) said.limits.reset();
  }
  combine();
}

void DeviceBook::read(const msg::DeviceInfo& info, DeviceLimits& limits) noexcept {
  refused_count_ = 0;
  const auto take = [this](LimitField field, double given, const LimitBounds& bounds, double& limit) {
    if (bounds.contain(given)) {
      limit = given;
    } else {
      refused_[refused_count_++] = {field, given, bounds};
    }
  };
  take(kMaxForce, info.max_force_n, kForceBounds_n, limits.max_force_n);
  take(kMaxTorque, info.max_torque_nm, kTorqueBounds_nm, limits.max_torque_nm);
  take(kMaxStiffness, info.max_stiffness_n_m, kStiffnessBounds_n_m, limits.max_stiffness_n_m);
  limits.actuated_axes = info.actuated_axes;
}

void DeviceBook::combine() noexcept {
  std::optional<DeviceLimits> strictest = further_;
  for (const Said& said : said_) {
    if (said.limits) strictest = strictest ? stricter(*strictest, *said.limits) : *said.limits;
  }
  if (strictest) limits_ = *strictest;
}

}  // namespace omentum::haptic
