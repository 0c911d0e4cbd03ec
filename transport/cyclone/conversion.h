// Between our messages and idlc's C structs, once for all messages. Both have members of equal names; structs
// of numbers have equal layout too (asserted in the generated header), so that their sequences are lent, not
// copied.
#pragma once

#include "cyclone_types.h"  // generated into the build tree by idl/generate.py --cyclone
#include "transport/bounds.h"

#include <algorithm>
#include <cstring>
#include <memory>
#include <type_traits>
#include <vector>

namespace omentum::transport::cyclone {

template <class T>
constexpr bool has_wire_layout() {
  if constexpr (std::is_arithmetic_v<T>) {
    return true;
  } else if constexpr (std::is_same_v<T, std::string>) {
    return false;
  } else {
    return WireType<T>::kFlat;
  }
}

/// Fills C structs for writing. They borrow the message's sequences and this object's memory: both must
/// outlive the write. The message must be within its bounds.
class Lender {
 public:
  template <class M>
  void lend(const M& message, typename WireType<M>::Type& wire) {
    lent_.clear();
    lend_members(message, wire);
  }

 private:
  template <class M, class W>
  void lend_members(const M& message, W& wire) {
    zip_fields(msg::MessageTag<M>{}, message, wire,
               [this](const msg::Field&, const auto& from, auto& to) { lend_value(from, to); });
  }

  template <class T, class W>
  void lend_value(const T& from, W& to) {
    if constexpr (std::is_arithmetic_v<T>) {
      to = from;
    } else {
      lend_members(from, to);
    }
  }

  template <std::size_t N>
  void lend_value(const std::string& from, char (&to)[N]) {
    std::memcpy(to, from.c_str(), from.size() + 1);
  }

  template <class T, class Sequence>
  void lend_value(const std::vector<T>& from, Sequence& to) {
    using Element = std::remove_pointer_t<decltype(to._buffer)>;
    to._length = to._maximum = static_cast<std::uint32_t>(from.size());
    to._release = false;
    if constexpr (has_wire_layout<T>()) {
      // the vendor's library, compiled apart, only reads it
      to._buffer = reinterpret_cast<Element*>(const_cast<T*>(from.data()));
    } else {
      to._buffer = reinterpret_cast<Element*>(memory(from.size() * sizeof(Element)));
      for (std::size_t i = 0; i < from.size(); ++i) lend_value(from[i], to._buffer[i]);
    }
  }

  std::max_align_t* memory(std::size_t bytes) {
    lent_.emplace_back(bytes / sizeof(std::max_align_t) + 1);
    return lent_.back().data();
  }

  std::vector<std::vector<std::max_align_t>> lent_;
};

/// Reads C structs. Sequences of the message keep their memory from sample to sample.
template <class M, class W>
void take_over(const W& wire, M& message);

namespace detail {

template <std::size_t N>
void take_value(const char (&from)[N], std::string& to) {
  to.assign(from, strnlen(from, N));
}

template <class W, class T>
void take_value(const W& from, T& to) {
  if constexpr (std::is_arithmetic_v<T>) {
    to = from;
  } else {
    take_over(from, to);
  }
}

template <class Sequence, class T>
void take_value(const Sequence& from, std::vector<T>& to) {
  to.resize(from._length);
  if constexpr (has_wire_layout<T>()) {
    if (from._length > 0) std::memcpy(static_cast<void*>(to.data()), from._buffer, from._length * sizeof(T));
  } else {
    for (std::size_t i = 0; i < to.size(); ++i) take_value(from._buffer[i], to[i]);
  }
}

}  // namespace detail

template <class M, class W>
void take_over(const W& wire, M& message) {
  zip_fields(msg::MessageTag<M>{}, wire, message,
             [](const msg::Field&, const auto& from, auto& to) { detail::take_value(from, to); });
}

}  // namespace omentum::transport::cyclone
