// A type of samples as Fast DDS is handed one, in whichever of its versions.
#pragma once

#include "transport/fast/key_hash.h"
#include "transport/fast/names.h"

#include <fastdds/dds/topic/TopicDataType.hpp>

#include <cstdint>
#include <functional>

namespace omentum::transport::fast {

/// Plain CDR, little endian, of samples that Fast DDS knows as pointers only. It announces no type
/// (docs/topics.md says why). Called on the writing threads and on Fast DDS' own.
class PlainType : public dds::TopicDataType {
 public:
  /// name: of the type, a text that outlives it. most_bytes: of a sample, with its encapsulation. key_bytes:
  /// of the key in plain CDR, 16 at most; 0: no key.
  PlainType(const char* name, std::uint32_t most_bytes, std::uint32_t key_bytes);

  const char* name() const { return name_; }
  std::uint32_t most_bytes() const { return most_bytes_; }

  /// Writes the sample with its encapsulation; the bytes written, 0 when it does not fit.
  virtual std::uint32_t write(const void* sample, char* bytes, std::uint32_t capacity) const = 0;
  /// Reads one; false when Fast DDS must not hand it on.
  virtual bool read(char* bytes, std::uint32_t length, void* sample) const = 0;
  /// Bytes that write() needs for it.
  virtual std::uint32_t bytes_of(const void* sample) const = 0;
  /// The key in big-endian CDR, padded with zeros. Not called where there is no key.
  virtual KeyHash key_of(const void*) const { return {}; }
  /// Samples that Fast DDS asks for itself: to find the key of one that came without.
  virtual void* make() const = 0;
  virtual void destroy(void* sample) const = 0;

  // what Fast DDS calls
#ifdef OMENTUM_FAST_DDS_3
  using Representation = dds::DataRepresentationId_t;  // always XCDR version 1: our writers offer no other

  bool serialize(const void* sample, rtps::SerializedPayload_t& payload, Representation) override {
    return encode_into(sample, payload) > 0;
  }
  bool deserialize(rtps::SerializedPayload_t& payload, void* sample) override {
    return read(reinterpret_cast<char*>(payload.data), payload.length, sample);
  }
  std::uint32_t calculate_serialized_size(const void* sample, Representation) override {
    return bytes_of(sample);
  }
  bool compute_key(rtps::SerializedPayload_t& payload, rtps::InstanceHandle_t& handle,
                   bool force_md5) override;
  bool compute_key(const void* sample, rtps::InstanceHandle_t& handle, bool force_md5) override {
    return hash_into(sample, handle, force_md5);
  }
  void* create_data() override {
    return make();
  }
  void delete_data(void* sample) override {
    destroy(sample);
  }
#else
  bool serialize(void* sample, rtps::SerializedPayload_t* payload) override {
    return encode_into(sample, *payload) > 0;
  }
  bool deserialize(rtps::SerializedPayload_t* payload, void* sample) override {
    return read(reinterpret_cast<char*>(payload->data), payload->length, sample);
  }
  std::function<std::uint32_t()> getSerializedSizeProvider(void* sample) override {
    return [this, sample] { return bytes_of(sample); };
  }
  /// What Fast DDS asks from 2.12 on.
  virtual std::function<std::uint32_t()> getSerializedSizeProvider(void* sample,
                                                                   dds::DataRepresentationId_t) {
    return getSerializedSizeProvider(sample);
  }
  bool getKey(void* sample, rtps::InstanceHandle_t* handle, bool force_md5) override {
    return hash_into(sample, *handle, force_md5);
  }
  void* createData() override {
    return make();
  }
  void deleteData(void* sample) override {
    destroy(sample);
  }
#endif

 private:
  std::uint32_t encode_into(const void* sample, rtps::SerializedPayload_t& payload) const;
  bool hash_into(const void* sample, rtps::InstanceHandle_t& handle, bool force_md5) const;

  const char* name_;
  std::uint32_t most_bytes_;
  std::uint32_t key_bytes_;
};

}  // namespace omentum::transport::fast
