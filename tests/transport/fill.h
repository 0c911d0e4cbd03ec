// Messages with known contents: the same seed gives the same message in every process.
#pragma once

#include "transport/messages.h"

#include <random>

namespace omentum::test {

/// How long sequences and strings are made.
enum class Lengths { kEmpty, kOne, kSome, kBound };

class Filler {
 public:
  Filler(std::uint64_t seed, Lengths lengths) : random_(seed), lengths_(lengths) {}

  template <class M>
  M make() {
    M message;
    fill(message, {});
    return message;
  }

 private:
  template <class T>
  void fill(T& value, const msg::Field&) {
    if constexpr (std::is_same_v<T, bool>) {
      value = random_() % 2 != 0;
    } else if constexpr (std::is_integral_v<T>) {
      value = static_cast<T>(random_());
    } else if constexpr (std::is_floating_point_v<T>) {
      value = std::normal_distribution<T>()(random_);
    } else {
      for_each_field(value, [this](const msg::Field& field, auto& member) { fill(member, field); });
    }
  }

  void fill(std::string& text, const msg::Field& field) {
    text.resize(length(field.bound));
    for (char& letter : text) letter = static_cast<char>('!' + random_() % ('~' - '!' + 1));
  }

  template <class T>
  void fill(std::vector<T>& values, const msg::Field& field) {
    values.resize(length(field.bound));
    for (T& value : values) fill(value, {field.name, false, field.element_bound});
  }

  std::size_t length(std::size_t bound) {
    switch (lengths_) {
      case Lengths::kEmpty:
        return 0;
      case Lengths::kOne:
        return 1;
      case Lengths::kSome:
        return 2 + random_() % std::min<std::size_t>(bound - 2, 1000);
      case Lengths::kBound:
        return bound;
    }
    return 0;
  }

  std::mt19937_64 random_;
  Lengths lengths_;
};

/// The messages of each type that the peer process sends and the tests expect.
inline constexpr Lengths kAllLengths[] = {Lengths::kEmpty, Lengths::kOne, Lengths::kSome, Lengths::kBound};

template <class M>
std::vector<M> known_messages() {
  std::vector<M> messages;
  for (const Lengths lengths : kAllLengths)
    messages.push_back(Filler(1999 + static_cast<std::uint64_t>(lengths), lengths).make<M>());
  return messages;
}

/// 1.5 MB in one sample: a surface of 131,072 nodes.
inline msg::OrganState large_organ_state() {
  constexpr std::size_t kFloats = 393'216;
  msg::OrganState state = Filler(7, Lengths::kSome).make<msg::OrganState>();
  state.values.resize(kFloats);
  for (std::size_t i = 0; i < kFloats; ++i) state.values[i] = static_cast<float>(i) * 1e-6F;
  return state;
}

/// A surface of 20,000 nodes in blocks as deform_node cuts it for a LAN: each fits a datagram.
inline std::vector<msg::OrganState> organ_state_in_blocks(std::size_t block_floats) {
  constexpr std::size_t kFloats = 60'000;
  std::vector<msg::OrganState> blocks;
  for (std::size_t first = 0; first < kFloats; first += block_floats) {
    msg::OrganState& block = blocks.emplace_back();
    block.block = static_cast<std::uint32_t>(blocks.size() - 1);
    block.block_count = static_cast<std::uint32_t>((kFloats + block_floats - 1) / block_floats);
    block.first = static_cast<std::uint32_t>(first / 3);
    block.node_count = kFloats / 3;
    block.echoes.resize(msg::MAX_TOOLS);
    for (std::size_t i = first; i < std::min(first + block_floats, kFloats); ++i)
      block.values.push_back(static_cast<float>(i) * 1e-6F);
  }
  return blocks;
}

}  // namespace omentum::test
