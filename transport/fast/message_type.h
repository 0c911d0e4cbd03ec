// What Fast DDS needs to know of a message type.
#pragma once

#include "transport/fast/cdr.h"
#include "transport/fast/plain_type.h"

namespace omentum::transport::fast {

/// What Fast DDS is handed as "data": where a message is, or where one goes.
template <class M>
struct SampleRef {
  M* message = nullptr;
  bool keys_only = false;  // decode the key members only
  bool decoded = false;    // set by read()
};

/// Serializes M with transport/fast/cdr.h. The type's name is the one that idlc gives it.
template <class M>
class MessageType final : public PlainType {
 public:
  MessageType() : PlainType(msg::MessageInfo<M>::kTypeName, kMostBytes, msg::MessageInfo<M>::kKeyBytes) {}

  std::uint32_t write(const void* data, char* bytes, std::uint32_t capacity) const override {
    return static_cast<std::uint32_t>(encode(message(data), bytes, capacity));
  }

  /// Always true: Fast DDS keeps a sample whose deserialization failed and would offer it for ever. The
  /// reader looks at SampleRef::decoded.
  bool read(char* bytes, std::uint32_t length, void* data) const override {
    auto& sample = *static_cast<SampleRef<M>*>(data);
    sample.decoded = decode(bytes, length, sample.keys_only, *sample.message);
    return true;
  }

  std::uint32_t bytes_of(const void* data) const override {
    return static_cast<std::uint32_t>(encoded_bytes(message(data)));
  }

  KeyHash key_of(const void* data) const override { return key_hash(message(data)); }

  void* make() const override { return static_cast<SampleRef<M>*>(new OwnSample); }
  void destroy(void* data) const override {
    delete static_cast<OwnSample*>(static_cast<SampleRef<M>*>(data));
  }

 private:
  static constexpr auto kMostBytes =
      static_cast<std::uint32_t>(kEncapsulationBytes + msg::MessageInfo<M>::kMaxBytes);

  static const M& message(const void* data) { return *static_cast<const SampleRef<M>*>(data)->message; }

  struct OwnSample : SampleRef<M> {
    OwnSample() : SampleRef<M>{&storage, true} {}
    M storage;
  };
};

}  // namespace omentum::transport::fast
