// The IDL's bounds, checked on values.
#pragma once

#include "transport/messages.h"

#include <string>
#include <type_traits>
#include <vector>

namespace omentum::transport {

namespace detail {

template <class T>
bool value_within(const T& value, std::size_t bound, std::size_t element_bound);

inline bool string_within(const std::string& text, std::size_t bound) {
  // a zero byte ends a string on the wire: what follows it would be lost silently
  return text.size() <= bound && text.find('\0') == std::string::npos;
}

template <class T>
bool value_within(const std::vector<T>& values, std::size_t bound, std::size_t element_bound) {
  if (values.size() > bound) return false;
  if constexpr (!std::is_arithmetic_v<T>) {
    for (const T& value : values)
      if (!value_within(value, element_bound, 0)) return false;
  }
  return true;
}

template <class T>
bool value_within(const T& value, std::size_t bound, std::size_t) {
  if constexpr (std::is_same_v<T, std::string>) {
    return string_within(value, bound);
  } else if constexpr (std::is_arithmetic_v<T>) {
    return true;
  } else {
    bool within = true;
    for_each_field(value, [&](const msg::Field& field, const auto& member) {
      within = within && value_within(member, field.bound, field.element_bound);
    });
    return within;
  }
}

}  // namespace detail

/// Whether every sequence and string of the message, at any depth, keeps the bound the IDL gives it.
template <class M>
bool within_bounds(const M& message) noexcept {
  return detail::value_within(message, 0, 0);
}

}  // namespace omentum::transport
