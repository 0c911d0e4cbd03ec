// The Fast DDS objects behind a participant, and how topics.h reads in Fast DDS' terms.
#pragma once

#include "transport/fast/names.h"
#include "transport/topics.h"

#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/publisher/qos/DataWriterQos.hpp>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <fastdds/dds/subscriber/qos/DataReaderQos.hpp>
#include <fastdds/dds/topic/Topic.hpp>
#include <fastdds/dds/topic/TypeSupport.hpp>

#include <map>
#include <mutex>
#include <string>

namespace omentum::transport::fast {

/// Owns the participant; deletes everything it contains at its end.
struct Entities {
  /// Throws std::runtime_error when Fast DDS refuses.
  explicit Entities(const BusOptions& options);
  ~Entities();
  Entities(const Entities&) = delete;
  Entities& operator=(const Entities&) = delete;

  /// The topic of this name, registered on first use. Throws std::runtime_error. Any thread.
  dds::Topic* topic(const TopicSpec& spec, const dds::TypeSupport& type);

  Profile profile;
  dds::DomainParticipant* participant = nullptr;
  dds::Publisher* publisher = nullptr;
  dds::Subscriber* subscriber = nullptr;

 private:
  std::mutex mutex_;  // guards topics_
  std::map<std::string, dds::Topic*> topics_;
};

/// max_bytes: an upper bound of the type's samples.
dds::DataWriterQos writer_qos(const TopicSpec& spec, Profile profile, std::size_t max_bytes);
dds::DataReaderQos reader_qos(const TopicSpec& spec);

/// Counters that Fast DDS keeps, as ours; the others are the caller's.
EndpointStatus status_of(const dds::DataWriter& writer);
EndpointStatus status_of(const dds::DataReader& reader);

}  // namespace omentum::transport::fast
