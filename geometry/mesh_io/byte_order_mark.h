// What editors put before text in UTF-8; no mesh has use for it.
#pragma once

#include <string_view>

namespace omentum::geometry {

inline constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

}  // namespace omentum::geometry
