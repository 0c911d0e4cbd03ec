// Which state something belongs to.
#pragma once

#include <cstdint>

namespace omentum::deform {

/// As OrganState has them.
struct StateMark {
  std::uint64_t seq = 0;
  std::int64_t stamp_ns = 0;
};

}  // namespace omentum::deform
