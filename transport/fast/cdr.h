// Messages as plain CDR (XCDR version 1, OMG DDS-XTypes 1.3 section 7.4.3; what @final structs use in both
// vendors), once for all messages, over their field visitors.
#pragma once

#include "transport/bounds.h"
#include "transport/fast/cdr_names.h"
#include "transport/fast/key_hash.h"

#include <algorithm>
#include <array>
#include <cstdint>

namespace omentum::transport::fast {

inline constexpr std::size_t kEncapsulationBytes = 4;

/// Counts the bytes that a message takes behind its encapsulation.
class SizeCounter {
 public:
  std::size_t bytes() const { return bytes_; }

  template <class T>
  void operator()(const msg::Field&, const T& value) {
    add(value);
  }

 private:
  void align_and_add(std::size_t size, std::size_t count) {
    bytes_ = (bytes_ + size - 1) / size * size + size * count;
  }

  template <class T>
  void add(const T& value) {
    if constexpr (std::is_arithmetic_v<T>) {
      align_and_add(sizeof(T), 1);
    } else {
      for_each_field(value, *this);
    }
  }
  void add(const std::string& text) {
    align_and_add(sizeof(std::uint32_t), 1);
    bytes_ += text.size() + 1;
  }
  template <class T>
  void add(const std::vector<T>& values) {
    align_and_add(sizeof(std::uint32_t), 1);
    if constexpr (std::is_arithmetic_v<T>) {
      if (!values.empty()) align_and_add(sizeof(T), values.size());
    } else {
      for (const T& value : values) add(value);
    }
  }

  std::size_t bytes_ = 0;
};

/// Writes members; throws eprosima's Exception when the buffer is too small.
class Encoder {
 public:
  explicit Encoder(Cdr& cdr) : cdr_(cdr) {}

  template <class T>
  void operator()(const msg::Field&, const T& value) {
    put(value);
  }

 private:
  template <class T>
  void put(const T& value) {
    if constexpr (std::is_arithmetic_v<T>) {
      cdr_.serialize(value);
    } else {
      for_each_field(value, *this);
    }
  }
  void put(const std::string& text) { cdr_.serialize(text.c_str()); }
  template <class T>
  void put(const std::vector<T>& values) {
    cdr_.serialize(static_cast<std::uint32_t>(values.size()));
    if constexpr (std::is_arithmetic_v<T>) {
      // an empty sequence is not followed by the padding of its elements
      if (!values.empty()) put_array(cdr_, values.data(), values.size());
    } else {
      for (const T& value : values) put(value);
    }
  }

  Cdr& cdr_;
};

/// Reads members; throws eprosima's Exception when the bytes end early or a bound of the IDL is breached.
/// A sequence is given memory only for as many elements as its bound allows.
class Decoder {
 public:
  Decoder(Cdr& cdr, bool keys_only) : cdr_(cdr), keys_only_(keys_only) {}

  template <class T>
  void operator()(const msg::Field& field, T& value) {
    if (!keys_only_ || field.key) get(value, field.bound, field.element_bound);
  }

 private:
  template <class T>
  void get(T& value, std::size_t, std::size_t) {
    if constexpr (std::is_arithmetic_v<T>) {
      cdr_.deserialize(value);
    } else {
      for_each_field(value, *this);
    }
  }
  void get(std::string& text, std::size_t bound, std::size_t) {
    cdr_.deserialize(text);
    if (text.size() > bound) throw eprosima::fastcdr::exception::BadParamException("string over its bound");
    text.resize(std::min(text.size(), text.find('\0')));  // as Cyclone DDS hears it, in C
  }
  template <class T>
  void get(std::vector<T>& values, std::size_t bound, std::size_t element_bound) {
    std::uint32_t size = 0;
    cdr_.deserialize(size);
    if (size > bound) throw eprosima::fastcdr::exception::BadParamException("sequence over its bound");
    values.resize(size);
    if constexpr (std::is_arithmetic_v<T>) {
      if (size > 0) get_array(cdr_, values.data(), values.size());
    } else {
      for (T& value : values) get(value, element_bound, 0);
    }
  }

  Cdr& cdr_;
  bool keys_only_;
};

/// Bytes of the message with its encapsulation.
template <class M>
std::size_t encoded_bytes(const M& message) {
  SizeCounter counter;
  for_each_field(message, counter);
  return kEncapsulationBytes + counter.bytes();
}

/// Writes the message, little endian, with its encapsulation; returns the bytes written, 0 when it does not
/// fit.
template <class M>
std::size_t encode(const M& message, char* data, std::size_t capacity) noexcept {
  try {
    FastBuffer buffer(data, capacity);
    Cdr cdr(buffer, Cdr::LITTLE_ENDIANNESS, kPlainCdr);
    cdr.serialize_encapsulation();
    for_each_field(message, Encoder(cdr));
    return length_of(cdr);
  } catch (const eprosima::fastcdr::exception::Exception&) {
    return 0;
  }
}

/// Reads a message of either endianness, or its key members only (they come first). False when the bytes
/// are no such message: ended early, or over a bound.
template <class M>
bool decode(char* data, std::size_t bytes, bool keys_only, M& message) noexcept {
  try {
    FastBuffer buffer(data, bytes);
    Cdr cdr(buffer, Cdr::DEFAULT_ENDIAN, kPlainCdr);
    cdr.read_encapsulation();
    for_each_field(message, Decoder(cdr, keys_only));
    return true;
  } catch (const std::exception&) {
    return false;
  }
}

/// The generator refuses keys above 16 bytes, which would be hashed.
template <class M>
KeyHash key_hash(const M& message) {
  static_assert(msg::MessageInfo<M>::kKeyBytes <= kKeyHashBytes);
  KeyHash hash{};
  FastBuffer buffer(hash.data(), hash.size());
  Cdr cdr(buffer, Cdr::BIG_ENDIANNESS, kPlainCdr);
  Encoder encoder(cdr);
  for_each_field(message, [&](const msg::Field& field, const auto& member) {
    if (field.key) encoder(field, member);
  });
  return hash;
}

}  // namespace omentum::transport::fast
