#include "transport/fast/entities.h"

#include "transport/fast/complaints.h"
#include "transport/fast/domain_names.h"
#include "transport/fast/session_keys.h"
#include "transport/keystore.h"
#include "transport/settings.h"

#include <algorithm>
#include <stdexcept>

namespace omentum::transport::fast {

namespace {

// A reader that lost a sample learns of it within this; the default of 3 s would stall durable topics.
constexpr int kHeartbeat_ms = 50;
// How many participants of one peer machine are looked for, by their ports.
constexpr std::uint32_t kPeerParticipants = 16;
// Participants that start together find each other by the first announcements: more of them than the
// default 5, so that a busy machine may miss some.
constexpr std::uint32_t kFirstAnnouncements = 10;

Duration_t duration(int milliseconds) {
  return Duration_t(milliseconds / 1000, static_cast<std::uint32_t>(milliseconds % 1000) * 1'000'000U);
}

Duration_t duration(std::chrono::milliseconds time) {
  return duration(static_cast<int>(time.count()));
}

// A handshake is one message of Fast DDS: with a certificate and the permissions some 4.5 kB, which IP
// splits.
std::size_t largest_datagram(Profile profile, bool secured) {
  constexpr std::size_t kHandshakeBytes = 8192;
  return secured ? std::max(kHandshakeBytes, max_message_bytes(profile)) : max_message_bytes(profile);
}

// UDP alone, on one machine too: whoever writes through Fast DDS' shared memory takes a lock that each reader
// takes, and waits for as long as a reader of lower priority is kept from its processor, or is stopped.
void set_transports(dds::DomainParticipantQos& qos, Profile profile, bool secured) {
  auto udp = std::make_shared<UDPv4TransportDescriptor>();
  udp->sendBufferSize = kSocketBufferBytes;
  udp->receiveBufferSize = kSocketBufferBytes;
  udp->maxMessageSize = static_cast<std::uint32_t>(largest_datagram(profile, secured));
  udp->maxInitialPeersRange = kPeerParticipants;
  if (profile == Profile::kLoopback)
    udp->interfaceWhiteList = {"127.0.0.1"};
  else if (const auto interface = interface_from_environment())
    udp->interfaceWhiteList = {interface->address};
  qos.transport().use_builtin_transports = false;
  qos.transport().send_socket_buffer_size = kSocketBufferBytes;
  qos.transport().listen_socket_buffer_size = kSocketBufferBytes;
  qos.transport().user_transports.push_back(udp);
}

void add_peers(dds::DomainParticipantQos& qos, const std::vector<std::string>& peers) {
  if (peers.empty()) return;
  // a list of peers replaces the multicast group, which therefore joins it
  auto& list = qos.wire_protocol().builtin.initialPeersList;
  std::vector<std::string> addresses = peers;
  addresses.push_back("239.255.0.1");
  for (const std::string& address : addresses) {
    rtps::Locator_t locator;
    rtps::IPLocator::setIPv4(locator, address);
    list.push_back(locator);
  }
}

void secure(dds::DomainParticipantQos& qos, const Credentials& credentials) {
  remember_session_keys();
  auto& properties = qos.properties().properties();
  const auto set = [&](const char* name, const std::string& value) { properties.emplace_back(name, value); };
  const auto set_file = [&](const char* name, const std::filesystem::path& file) {
    set(name, "file://" + file.string());
  };
  set("dds.sec.auth.plugin", "builtin.PKI-DH");
  set_file("dds.sec.auth.builtin.PKI-DH.identity_ca", credentials.identity_authority);
  set_file("dds.sec.auth.builtin.PKI-DH.identity_certificate", credentials.certificate);
  set_file("dds.sec.auth.builtin.PKI-DH.private_key", credentials.key);
  set("dds.sec.access.plugin", "builtin.Access-Permissions");
  set_file("dds.sec.access.builtin.Access-Permissions.permissions_ca", credentials.permissions_authority);
  set_file("dds.sec.access.builtin.Access-Permissions.governance", credentials.governance);
  set_file("dds.sec.access.builtin.Access-Permissions.permissions", credentials.permissions);
  set("dds.sec.crypto.plugin", "builtin.AES-GCM-GMAC");
}

dds::DomainParticipantQos participant_qos(const BusOptions& options) {
  dds::DomainParticipantQos qos;
  qos.name(options.name);
  auto& discovery = qos.wire_protocol().builtin.discovery_config;
  discovery.leaseDuration = duration(kFastLease_ms);
  discovery.leaseDuration_announcementperiod = duration(kAnnouncementPeriod_ms);
  discovery.initial_announcements.count = kFirstAnnouncements;
  set_transports(qos, options.profile, !options.keystore.empty());
  if (options.profile == Profile::kLan) add_peers(qos, peers_from_environment());
  if (!options.keystore.empty()) secure(qos, find_credentials(options.keystore, Vendor::kFast, options.name));
  return qos;
}

template <class Qos>
void set_common(Qos& qos, const TopicSpec& spec) {
  qos.reliability().kind = spec.reliability == Reliability::kReliable ? dds::RELIABLE_RELIABILITY_QOS
                                                                      : dds::BEST_EFFORT_RELIABILITY_QOS;
  qos.durability().kind = spec.durability == Durability::kTransientLocal ? dds::TRANSIENT_LOCAL_DURABILITY_QOS
                                                                         : dds::VOLATILE_DURABILITY_QOS;
  qos.history().kind = dds::KEEP_LAST_HISTORY_QOS;
  qos.history().depth = spec.depth;
  // no limit of instances (the default is 10): a state in blocks has a thousand. 0 stands for "unlimited".
  qos.resource_limits().max_samples = 0;
  qos.resource_limits().max_instances = 0;
  qos.resource_limits().max_samples_per_instance = 0;
  qos.resource_limits().allocated_samples = spec.depth;
  qos.endpoint().history_memory_policy = rtps::DYNAMIC_REUSABLE_MEMORY_MODE;
  qos.data_sharing().off();
  if (spec.liveliness_lease.count() > 0) {
    qos.liveliness().kind = dds::AUTOMATIC_LIVELINESS_QOS;
    qos.liveliness().lease_duration = duration(spec.liveliness_lease);
    // two announcements may be lost within a lease
    qos.liveliness().announcement_period = duration(spec.liveliness_lease / 3);
  }
}

}  // namespace

Entities::Entities(const BusOptions& options) : profile(options.profile) {
  tell_complaints_once();
  // it would run callbacks on the writing thread, within its locks
  turn_off_delivery_inside_the_process();
  auto* factory = dds::DomainParticipantFactory::get_instance();
  participant = factory->create_participant(static_cast<std::uint32_t>(options.domain),
                                            participant_qos(options), nullptr, dds::StatusMask::none());
  if (!participant)
    throw std::runtime_error("Fast DDS refused a participant in domain " + std::to_string(options.domain));
  publisher = participant->create_publisher(dds::PublisherQos());
  subscriber = participant->create_subscriber(dds::SubscriberQos());
  if (publisher && subscriber) return;
  participant->delete_contained_entities();
  factory->delete_participant(participant);
  throw std::runtime_error("Fast DDS refused a publisher or subscriber");
}

Entities::~Entities() {
  participant->delete_contained_entities();
  dds::DomainParticipantFactory::get_instance()->delete_participant(participant);
}

dds::Topic* Entities::topic(const TopicSpec& spec, const dds::TypeSupport& type) {
  const std::lock_guard lock(mutex_);
  dds::Topic*& topic = topics_[spec.name];
  if (!topic && participant->register_type(type) == kOk)
    topic = participant->create_topic(spec.name, type.get_type_name(), dds::TopicQos());
  if (!topic) throw std::runtime_error(std::string("Fast DDS refused the topic ") + spec.name);
  return topic;
}

dds::DataWriterQos writer_qos(const TopicSpec& spec, Profile profile, std::size_t max_bytes) {
  dds::DataWriterQos qos;
  set_common(qos, spec);
  if (spec.deadline.count() > 0) qos.deadline().period = duration(spec.deadline);
  set_heartbeat_period(qos.reliable_writer_qos().times, duration(kHeartbeat_ms));
  // a sample that fits no single message is sent by Fast DDS' own thread; smaller ones without that hop
  qos.publish_mode().kind =
      max_bytes > max_message_bytes(profile) ? dds::ASYNCHRONOUS_PUBLISH_MODE : dds::SYNCHRONOUS_PUBLISH_MODE;
  return qos;
}

dds::DataReaderQos reader_qos(const TopicSpec& spec) {
  dds::DataReaderQos qos;
  set_common(qos, spec);
  qos.history().depth = spec.depth * spec.writers;
  return qos;
}

// reading a status resets its "changes since", hence no const methods in the vendor's interface
EndpointStatus status_of(const dds::DataWriter& const_writer) {
  auto& writer = const_cast<dds::DataWriter&>(const_writer);
  EndpointStatus status;
  dds::PublicationMatchedStatus matched;
  writer.get_publication_matched_status(matched);
  status.matched = matched.current_count;
  dds::OfferedDeadlineMissedStatus deadline;
  writer.get_offered_deadline_missed_status(deadline);
  status.deadline_missed = deadline.total_count;
  dds::OfferedIncompatibleQosStatus incompatible;
  writer.get_offered_incompatible_qos_status(incompatible);
  status.incompatible_qos = incompatible.total_count;
  dds::LivelinessLostStatus liveliness;
  writer.get_liveliness_lost_status(liveliness);
  status.liveliness_lost = static_cast<std::uint64_t>(liveliness.total_count);
  return status;
}

EndpointStatus status_of(const dds::DataReader& const_reader) {
  auto& reader = const_cast<dds::DataReader&>(const_reader);
  EndpointStatus status;
  dds::SubscriptionMatchedStatus matched;
  reader.get_subscription_matched_status(matched);
  status.matched = matched.current_count;
  dds::RequestedIncompatibleQosStatus incompatible;
  reader.get_requested_incompatible_qos_status(incompatible);
  status.incompatible_qos = incompatible.total_count;
  return status;
}

}  // namespace omentum::transport::fast
