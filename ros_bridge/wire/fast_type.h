// The messages of ros.idl for Fast DDS.
#pragma once

#include "ros_bridge/wire/ros_types.h"
#include "transport/fast/cdr_names.h"
#include "transport/fast/plain_type.h"

#include <string>

namespace omentum::ros {

/// Plain CDR without a key. Of what it read the texts are Cyclone's to free:
/// dds_sample_free(message, &descriptor<M>(), DDS_FREE_CONTENTS).
template <class M>
class FastType final : public transport::fast::PlainType {
 public:
  FastType() : PlainType(descriptor<M>().m_typename, kMostBytes, 0) {}

  std::uint32_t write(const void* message, char* bytes, std::uint32_t capacity) const override try {
    Buffer buffer(bytes, capacity);
    Cdr cdr(buffer, Cdr::LITTLE_ENDIANNESS, transport::fast::kPlainCdr);
    cdr.serialize_encapsulation();
    // fields() hands out what may be written to as well
    fields(Encoder{cdr}, *const_cast<M*>(static_cast<const M*>(message)));
    return static_cast<std::uint32_t>(transport::fast::length_of(cdr));
  } catch (const eprosima::fastcdr::exception::Exception&) {
    return 0;  // longer than kMostBytes
  }

  bool read(char* bytes, std::uint32_t length, void* message) const override try {
    Buffer buffer(bytes, length);
    Cdr cdr(buffer, Cdr::DEFAULT_ENDIAN, transport::fast::kPlainCdr);
    cdr.read_encapsulation();
    fields(Decoder{cdr}, *static_cast<M*>(message));
    return true;
  } catch (const eprosima::fastcdr::exception::Exception&) {
    return false;  // not of this type
  }

  std::uint32_t bytes_of(const void*) const override { return kMostBytes; }
  void* make() const override { return new M{}; }
  void destroy(void* message) const override {
    dds_sample_free(message, &descriptor<M>(), DDS_FREE_CONTENTS);
    delete static_cast<M*>(message);
  }

 private:
  using Cdr = transport::fast::Cdr;
  using Buffer = transport::fast::FastBuffer;
  // of what we write: a state with two names of at most a hundred letters has half of it
  static constexpr std::uint32_t kMostBytes = 1024;

  struct Encoder {
    Cdr& cdr;
    template <class T>
    void operator()(T value) const {
      cdr << value;
    }
    void operator()(const char* text) const { cdr << (text ? text : ""); }
    void operator()(char* text) const { (*this)(static_cast<const char*>(text)); }
  };
  struct Decoder {
    Cdr& cdr;
    template <class T>
    void operator()(T& value) const {
      cdr >> value;
    }
    void operator()(char*& text) const {
      std::string read;
      cdr >> read;
      dds_string_free(text);
      text = dds_string_dup(read.c_str());
    }
  };
};

}  // namespace omentum::ros
