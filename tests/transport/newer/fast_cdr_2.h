// What transport/ uses of Fast CDR 2, declared anew; see fast_dds_3.h.
#pragma once

#include <cstddef>
#include <cstdint>
#include <exception>

namespace eprosima::fastcdr {

enum CdrVersion : std::uint8_t { CORBA_CDR, DDS_CDR, XCDRv1, XCDRv2 };

namespace exception {
class Exception : public std::exception {};
class BadParamException : public Exception {
 public:
  BadParamException(const char* const& message) noexcept;
};
}  // namespace exception

class FastBuffer {
 public:
  FastBuffer(char* const buffer, const std::size_t size);
};

class Cdr {
 public:
  enum Endianness : std::uint8_t { BIG_ENDIANNESS, LITTLE_ENDIANNESS };
  static const Endianness DEFAULT_ENDIAN;
  Cdr(FastBuffer& buffer, const Endianness endianness = DEFAULT_ENDIAN, const CdrVersion version = XCDRv2);
  Cdr& read_encapsulation();
  Cdr& serialize_encapsulation();
  std::size_t get_serialized_data_length() const;
  Cdr& serialize(const char* text);
  template <class T>
  Cdr& serialize(const T& value);
  template <class T>
  Cdr& serialize_array(const T* values, std::size_t count);
  template <class T>
  Cdr& deserialize(T& value);
  template <class T>
  Cdr& deserialize_array(T* values, std::size_t count);
};

}  // namespace eprosima::fastcdr
