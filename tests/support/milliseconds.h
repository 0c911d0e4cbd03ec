#pragma once

#include <cstdint>

namespace omentum::test {

inline constexpr std::int64_t kMs = 1'000'000;  ///< ns

}  // namespace omentum::test
