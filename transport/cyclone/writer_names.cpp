#include "transport/cyclone/writer_names.h"

#include <algorithm>
#include <cstring>

namespace omentum::transport::cyclone {

WriterId handle_id(dds_instance_handle_t publication) noexcept {
  WriterId id{};
  std::memcpy(id.data(), &publication, sizeof publication);
  return id;
}

WriterId WriterNames::find(dds_entity_t reader, dds_instance_handle_t publication) {
  const WriterId handle = handle_id(publication);
  for (const auto& [known, name] : known_)
    if (known == handle) return name;
  dds_builtintopic_endpoint_t* endpoint = dds_get_matched_publication_data(reader, publication);
  if (!endpoint) return handle;
  WriterId name{};
  static_assert(sizeof endpoint->key.v == sizeof name);
  std::memcpy(name.data(), endpoint->key.v, sizeof name);
  dds_builtintopic_free_endpoint(endpoint);
  known_.emplace_back(handle, name);
  return name;
}

WriterId WriterNames::forget(const WriterId& handle) noexcept {
  const auto known = std::ranges::find(known_, handle, &std::pair<WriterId, WriterId>::first);
  if (known == known_.end()) return handle;
  const WriterId name = known->second;
  known_.erase(known);
  return name;
}

}  // namespace omentum::transport::cyclone
