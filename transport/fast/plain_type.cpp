#include "transport/fast/plain_type.h"

#ifdef OMENTUM_FAST_DDS_3
#include <fastdds/utils/md5.hpp>
#else
#include <fastrtps/utils/md5.h>
#endif

#include <algorithm>

namespace omentum::transport::fast {

#ifdef OMENTUM_FAST_DDS_3
using eprosima::fastdds::MD5;
#endif

PlainType::PlainType(const char* name, std::uint32_t most_bytes, std::uint32_t key_bytes)
    : name_(name), most_bytes_(most_bytes), key_bytes_(key_bytes) {
#ifdef OMENTUM_FAST_DDS_3
  set_name(name);
  max_serialized_type_size = most_bytes;
  is_compute_key_provided = key_bytes > 0;
#else
  setName(name);
  m_typeSize = most_bytes;
  m_isGetKeyDefined = key_bytes > 0;
  auto_fill_type_object(false);
  auto_fill_type_information(false);
#endif
}

std::uint32_t PlainType::encode_into(const void* sample, rtps::SerializedPayload_t& payload) const {
  payload.length = write(sample, reinterpret_cast<char*>(payload.data), payload.max_size);
  payload.encapsulation = CDR_LE;
  return payload.length;
}

bool PlainType::hash_into(const void* sample, rtps::InstanceHandle_t& handle, bool force_md5) const {
  if (key_bytes_ == 0) return false;
  const KeyHash hash = key_of(sample);
  rtps::octet* value = handle.value;
  if (force_md5) {
    MD5 md5;
    md5.update(hash.data(), key_bytes_);
    md5.finalize();
    std::copy_n(md5.digest, kKeyHashBytes, value);
  } else {
    std::copy_n(hash.data(), kKeyHashBytes, value);
  }
  return true;
}

#ifdef OMENTUM_FAST_DDS_3
bool PlainType::compute_key(rtps::SerializedPayload_t& payload, rtps::InstanceHandle_t& handle,
                            bool force_md5) {
  void* sample = make();
  const bool found = deserialize(payload, sample) && hash_into(sample, handle, force_md5);
  destroy(sample);
  return found;
}
#endif

}  // namespace omentum::transport::fast
