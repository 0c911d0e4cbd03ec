// The DDS domain that ROS 2 is in.
#pragma once

#include <optional>
#include <string>

namespace omentum::ros {

inline constexpr int kLastDomain = 230;

/// `set`: ROS_DOMAIN_ID as the environment has it, nullopt or empty where it is not set; 0 then, as ROS takes
/// it. Throws std::runtime_error where it is no domain: a bridge in another one than ROS' would say nothing
/// to anybody.
int domain_of(const std::optional<std::string>& set);

}  // namespace omentum::ros
