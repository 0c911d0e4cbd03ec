// What the vendors, and the transport itself, have to say on stderr: with measure.
#pragma once

#include <string_view>

namespace omentum::transport {

/// Writes "WHO: MESSAGE" as one line on stderr, unless this process has told something of this kind before:
/// what goes wrong once goes wrong a thousand times a second. Any thread; short lock. False when it was told
/// before.
bool tell_once(std::string_view who, std::string_view kind, std::string_view message) noexcept;

/// The same for a message of the vendor's log: its first line, and that no further ones are told. Kinds of
/// two vendors are never the same.
bool complain_once(std::string_view vendor, std::string_view kind, std::string_view message) noexcept;

}  // namespace omentum::transport
