// The Cyclone DDS objects behind a participant, and how topics.h reads in Cyclone's terms.
#pragma once

#include "transport/cyclone/domain.h"
#include "transport/topics.h"

#include <dds/dds.h>

#include <memory>

namespace omentum::transport::cyclone {

/// Owns the participant; deletes everything it contains at its end.
struct Entities {
  explicit Entities(const BusOptions& options);
  ~Entities();
  Entities(const Entities&) = delete;
  Entities& operator=(const Entities&) = delete;

  /// Throws std::runtime_error.
  dds_entity_t topic(const TopicSpec& spec, const dds_topic_descriptor_t& type) const;

  Domain domain;
  dds_entity_t participant = 0;
};

using Qos = std::unique_ptr<dds_qos_t, void (*)(dds_qos_t*)>;
Qos writer_qos(const TopicSpec& spec);
Qos reader_qos(const TopicSpec& spec);

/// Throws std::runtime_error saying what Cyclone refused and why when `entity` is an error code.
dds_entity_t checked(dds_entity_t entity, const std::string& what);

/// Counters that Cyclone keeps, as ours; the others are the caller's.
EndpointStatus writer_status(dds_entity_t writer);
EndpointStatus reader_status(dds_entity_t reader);

}  // namespace omentum::transport::cyclone
