// A topic's name, "omentum/<protocol version>/<message>", from the one constant of the IDL.
#pragma once

#include "transport/messages.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <string_view>

namespace omentum::transport {

/// A text that is a template's argument.
template <std::size_t N>
struct Text {
  char letters[N];
  consteval Text(const char (&text)[N]) { std::copy_n(text, N, letters); }
};

namespace detail {

inline constexpr std::string_view kFamily = "omentum/";

constexpr std::size_t digits(std::uint32_t number) {
  return number < 10 ? 1 : 1 + digits(number / 10);
}

template <Text message>
constexpr auto name_topic() {
  constexpr std::size_t kDigits = digits(msg::PROTOCOL_VERSION);
  std::array<char, kFamily.size() + kDigits + 1 + sizeof(message.letters)> name{};
  char* version = std::copy(kFamily.begin(), kFamily.end(), name.data());
  std::uint32_t rest = msg::PROTOCOL_VERSION;
  for (std::size_t i = kDigits; i > 0; --i, rest /= 10) version[i - 1] = static_cast<char>('0' + rest % 10);
  version[kDigits] = '/';
  std::copy_n(message.letters, sizeof(message.letters), version + kDigits + 1);  // and its final zero
  return name;
}

template <Text message>
inline constexpr auto kTopicName = name_topic<message>();

}  // namespace detail

/// The name of the topic that carries `message`, written as "tool_pose".
template <Text message>
constexpr const char* topic_name() {
  return detail::kTopicName<message>.data();
}

}  // namespace omentum::transport
