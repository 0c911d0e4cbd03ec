// The messages of ros.idl for Fast DDS.
#pragma once

#include "ros_bridge/wire/ros_types.h"

#include <fastcdr/Cdr.h>
#include <fastcdr/FastBuffer.h>
#include <fastdds/dds/topic/TopicDataType.hpp>

#include <functional>
#include <string>

namespace omentum::ros {

/// Plain CDR of this machine's byte order, without a key. Of what it read the texts are Cyclone's to free:
/// dds_sample_free(message, &descriptor<M>(), DDS_FREE_CONTENTS).
template <class M>
class FastType final : public eprosima::fastdds::dds::TopicDataType {
 public:
  using Payload = eprosima::fastrtps::rtps::SerializedPayload_t;
  using Cdr = eprosima::fastcdr::Cdr;

  FastType() {
    setName(descriptor<M>().m_typename);
    m_typeSize = kMostBytes;
    m_isGetKeyDefined = false;
  }

  bool serialize(void* message, Payload* payload) override try {
    eprosima::fastcdr::FastBuffer buffer(reinterpret_cast<char*>(payload->data), payload->max_size);
    Cdr cdr(buffer, Cdr::DEFAULT_ENDIAN, Cdr::DDS_CDR);
    payload->encapsulation = cdr.endianness() == Cdr::BIG_ENDIANNESS ? CDR_BE : CDR_LE;
    cdr.serialize_encapsulation();
    fields(Encoder{cdr}, *static_cast<M*>(message));
    payload->length = static_cast<std::uint32_t>(cdr.getSerializedDataLength());
    return true;
  } catch (const eprosima::fastcdr::exception::Exception&) {
    return false;  // longer than kMostBytes
  }

  bool deserialize(Payload* payload, void* message) override try {
    eprosima::fastcdr::FastBuffer buffer(reinterpret_cast<char*>(payload->data), payload->length);
    Cdr cdr(buffer, Cdr::DEFAULT_ENDIAN, Cdr::DDS_CDR);
    cdr.read_encapsulation();
    fields(Decoder{cdr}, *static_cast<M*>(message));
    return true;
  } catch (const eprosima::fastcdr::exception::Exception&) {
    return false;  // not of this type
  }

  std::function<std::uint32_t()> getSerializedSizeProvider(void*) override {
    return [] { return kMostBytes; };
  }
  bool getKey(void*, eprosima::fastrtps::rtps::InstanceHandle_t*, bool) override { return false; }
  void* createData() override { return new M{}; }
  void deleteData(void* message) override {
    dds_sample_free(message, &descriptor<M>(), DDS_FREE_CONTENTS);
    delete static_cast<M*>(message);
  }

 private:
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
