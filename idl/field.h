// What the generated messages are described with.
#pragma once

#include <cstddef>

namespace omentum::msg {

/// One member of a message, as the IDL declares it. Its kind is its C++ type.
struct Field {
  const char* name;
  bool key = false;
  std::size_t bound = 0;          // most elements of a sequence, or characters of a string; else 0
  std::size_t element_bound = 0;  // most characters of each element of a sequence of strings; else 0
};

/// Facts about a message: kTypeName (as on the wire), kTopic, kKeyBytes (0: no key), kMaxBytes (an upper
/// bound of its size on the wire).
template <class M>
struct MessageInfo;

/// Names a message without a value of it.
template <class M>
struct MessageTag {};

template <class... M>
struct TopicList {};

/// Calls action(MessageTag<M>{}) for every type in the list.
template <class... M, class A>
constexpr void for_each_topic(TopicList<M...>, A&& action) {
  (action(MessageTag<M>{}), ...);
}

}  // namespace omentum::msg
