#include "ros_bridge/ros_domain.h"

#include <charconv>
#include <stdexcept>

namespace omentum::ros {

int domain_of(const std::optional<std::string>& set) {
  if (!set || set->empty()) return 0;
  int domain = -1;
  const char* const end = set->data() + set->size();
  const auto read = std::from_chars(set->data(), end, domain);
  if (read.ec != std::errc{} || read.ptr != end || domain < 0 || domain > kLastDomain)
    throw std::runtime_error("ROS_DOMAIN_ID: found '" + *set + "', expected 0 to " +
                             std::to_string(kLastDomain));
  return domain;
}

}  // namespace omentum::ros
