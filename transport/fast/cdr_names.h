// Fast CDR 1 (of Fast DDS 2.9 to 2.11) and 2 (of 2.12 and later) under one set of names.
#pragma once

#if __has_include(<fastcdr/CdrEncoding.hpp>)
#define OMENTUM_FAST_CDR_2
#endif
#include <fastcdr/Cdr.h>
#include <fastcdr/FastBuffer.h>
#include <fastcdr/exceptions/BadParamException.h>
#include <fastcdr/exceptions/Exception.h>

#include <cstddef>

namespace omentum::transport::fast {

using eprosima::fastcdr::Cdr;
using eprosima::fastcdr::FastBuffer;

#ifdef OMENTUM_FAST_CDR_2

inline constexpr auto kPlainCdr = eprosima::fastcdr::CdrVersion::DDS_CDR;
inline std::size_t length_of(const Cdr& cdr) {
  return cdr.get_serialized_data_length();
}
template <class T>
void put_array(Cdr& cdr, const T* values, std::size_t count) {
  cdr.serialize_array(values, count);
}
template <class T>
void get_array(Cdr& cdr, T* values, std::size_t count) {
  cdr.deserialize_array(values, count);
}

#else

/// XCDR version 1 with an encapsulation in front.
inline constexpr auto kPlainCdr = Cdr::DDS_CDR;
/// Bytes written so far, with the encapsulation.
inline std::size_t length_of(const Cdr& cdr) {
  return cdr.getSerializedDataLength();
}
template <class T>
void put_array(Cdr& cdr, const T* values, std::size_t count) {
  cdr.serializeArray(values, count);
}
template <class T>
void get_array(Cdr& cdr, T* values, std::size_t count) {
  cdr.deserializeArray(values, count);
}

#endif

}  // namespace omentum::transport::fast
