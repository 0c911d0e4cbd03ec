// The key of a sample, as RTPS has it.
#pragma once

#include <array>
#include <cstddef>

namespace omentum::transport::fast {

inline constexpr std::size_t kKeyHashBytes = 16;
/// RTPS 2.5 section 9.6.4.8: the key members in big-endian CDR, padded with zeros.
using KeyHash = std::array<char, kKeyHashBytes>;

}  // namespace omentum::transport::fast
