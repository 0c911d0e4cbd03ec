// Topics by number, and messages of each to begin with.
#pragma once

#include "tests/transport/fill.h"
#include "transport/fast/cdr.h"

#include <cstdint>
#include <string>
#include <vector>

namespace omentum::fuzz {

namespace detail {
template <class... M>
constexpr std::size_t count_of(msg::TopicList<M...>) {
  return sizeof...(M);
}
}  // namespace detail
inline constexpr std::size_t kTopics = detail::count_of(msg::AllTopics{});

/// Calls visit(MessageTag<M>) for the topic of that number, counted round.
template <class Visit>
void with_topic(std::uint8_t number, Visit&& visit) {
  std::size_t left = number % kTopics;
  msg::for_each_topic(msg::AllTopics{}, [&]<class M>(msg::MessageTag<M> tag) {
    if (left-- == 0) visit(tag);
  });
}

/// Messages of every topic, short ones, encoded; each behind what `head` makes of its topic's number.
template <class Head>
std::vector<std::string> encoded_topics(Head&& head) {
  std::vector<std::string> inputs;
  char number = 0;
  msg::for_each_topic(msg::AllTopics{}, [&]<class M>(msg::MessageTag<M>) {
    for (const test::Lengths lengths : {test::Lengths::kEmpty, test::Lengths::kOne}) {
      const M message = test::Filler(1999, lengths).template make<M>();
      std::string bytes(transport::fast::encoded_bytes(message), '\0');
      transport::fast::encode(message, bytes.data(), bytes.size());
      inputs.push_back(head(number) + bytes);
    }
    ++number;
  });
  return inputs;
}

}  // namespace omentum::fuzz
