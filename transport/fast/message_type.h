// What Fast DDS needs to know of a message type.
#pragma once

#include "transport/fast/cdr.h"

#include <fastdds/dds/topic/TopicDataType.hpp>

#include <algorithm>

namespace omentum::transport::fast {

/// What Fast DDS is handed as "data": where a message is, or where one goes.
template <class M>
struct SampleRef {
  M* message = nullptr;
  bool keys_only = false;  // decode the key members only
  bool decoded = false;    // set by deserialize()
};

/// Serializes M with transport/fast/cdr.h. The type's name is the one that idlc gives it.
template <class M>
class MessageType final : public eprosima::fastdds::dds::TopicDataType {
 public:
  MessageType() {
    setName(msg::MessageInfo<M>::kTypeName);
    m_typeSize = static_cast<std::uint32_t>(kEncapsulationBytes + msg::MessageInfo<M>::kMaxBytes);
    m_isGetKeyDefined = msg::MessageInfo<M>::kKeyBytes > 0;
    auto_fill_type_object(false);
    auto_fill_type_information(false);
  }

  bool serialize(void* data, eprosima::fastrtps::rtps::SerializedPayload_t* payload) override {
    const auto& sample = *static_cast<SampleRef<M>*>(data);
    payload->length = static_cast<std::uint32_t>(
        encode(*sample.message, reinterpret_cast<char*>(payload->data), payload->max_size));
    payload->encapsulation = CDR_LE;
    return payload->length > 0;
  }

  /// Always true: Fast DDS keeps a sample whose deserialization failed and would offer it for ever. The
  /// reader looks at SampleRef::decoded.
  bool deserialize(eprosima::fastrtps::rtps::SerializedPayload_t* payload, void* data) override {
    auto& sample = *static_cast<SampleRef<M>*>(data);
    sample.decoded =
        decode(reinterpret_cast<char*>(payload->data), payload->length, sample.keys_only, *sample.message);
    return true;
  }

  std::function<std::uint32_t()> getSerializedSizeProvider(void* data) override {
    const M* message = static_cast<SampleRef<M>*>(data)->message;
    return [message] { return static_cast<std::uint32_t>(encoded_bytes(*message)); };
  }

  /// Fast DDS makes samples of its own for one purpose: to find the key of a sample that came without.
  void* createData() override { return static_cast<SampleRef<M>*>(new OwnSample); }
  void deleteData(void* data) override { delete static_cast<OwnSample*>(static_cast<SampleRef<M>*>(data)); }

  bool getKey(void* data, eprosima::fastrtps::rtps::InstanceHandle_t* handle, bool force_md5) override {
    if (!m_isGetKeyDefined) return false;
    const auto hash = key_hash(*static_cast<SampleRef<M>*>(data)->message);
    eprosima::fastrtps::rtps::octet* value = handle->value;
    if (force_md5) {
      MD5 md5;
      md5.update(hash.data(), static_cast<unsigned>(msg::MessageInfo<M>::kKeyBytes));
      md5.finalize();
      std::copy_n(md5.digest, kKeyHashBytes, value);
    } else {
      std::copy_n(hash.data(), kKeyHashBytes, value);
    }
    return true;
  }

 private:
  struct OwnSample : SampleRef<M> {
    OwnSample() : SampleRef<M>{&storage, true} {}
    M storage;
  };
};

}  // namespace omentum::transport::fast
