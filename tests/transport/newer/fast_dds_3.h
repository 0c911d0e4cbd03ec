// What transport/ uses of Fast DDS 3, declared anew from their interface: names, signatures
// and what is const. Nothing of it is linked: newer_vendors_test.py compiles against it.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#define CDR_LE 0x0001

namespace eprosima::fastdds {

enum IntraprocessDeliveryType { INTRAPROCESS_OFF, INTRAPROCESS_USER_DATA_ONLY, INTRAPROCESS_FULL };
class LibrarySettings {
 public:
  IntraprocessDeliveryType intraprocess_delivery;
};

class MD5 {
 public:
  void update(const char* bytes, unsigned int count);
  MD5& finalize();
  unsigned char digest[16];
};

namespace dds {
struct Time_t {
  Time_t(std::int32_t seconds, std::uint32_t nanoseconds);
};
using Duration_t = Time_t;
}  // namespace dds

namespace rtps {

using octet = unsigned char;
struct InstanceHandleValue_t {
  template <class T>
  octet operator[](T i) const noexcept;
  operator octet*() noexcept;
};
struct InstanceHandle_t {
  InstanceHandleValue_t value;
};
struct SerializedPayload_t {
  SerializedPayload_t(const SerializedPayload_t&) = delete;
  std::uint16_t encapsulation;
  std::uint32_t length;
  octet* data;
  std::uint32_t max_size;
};

using dds::Duration_t;
struct WriterTimes {
  Duration_t heartbeat_period;
};
enum MemoryManagementPolicy_t { PREALLOCATED_MEMORY_MODE, DYNAMIC_REUSABLE_MEMORY_MODE };

struct Locator_t {};
class IPLocator {
 public:
  static bool setIPv4(Locator_t& locator, const std::string& address);
};
struct TransportDescriptorInterface {};
struct UDPv4TransportDescriptor : TransportDescriptorInterface {
  std::uint32_t sendBufferSize, receiveBufferSize, maxMessageSize, maxInitialPeersRange;
  std::vector<std::string> interfaceWhiteList;
};

struct Property {
  Property(const std::string& name, const std::string& value);
};
struct PropertyPolicy {
  std::vector<Property>& properties();
};
struct BuiltinAttributes {
  struct {
    Duration_t leaseDuration, leaseDuration_announcementperiod;
    struct {
      std::uint32_t count;
    } initial_announcements;
  } discovery_config;
  std::vector<Locator_t> initialPeersList;
};

}  // namespace rtps

namespace dds {

using ReturnCode_t = std::int32_t;
const ReturnCode_t RETCODE_OK = 0;
using InstanceHandle_t = rtps::InstanceHandle_t;
enum DataRepresentationId_t : std::int16_t { XCDR_DATA_REPRESENTATION, XML_DATA_REPRESENTATION };

class TopicDataType {
 public:
  virtual ~TopicDataType() = default;
  virtual bool serialize(const void* const data, rtps::SerializedPayload_t& payload,
                         DataRepresentationId_t) = 0;
  virtual bool deserialize(rtps::SerializedPayload_t& payload, void* data) = 0;
  virtual std::uint32_t calculate_serialized_size(const void* const data, DataRepresentationId_t) = 0;
  virtual void* create_data() = 0;
  virtual void delete_data(void* data) = 0;
  virtual bool compute_key(rtps::SerializedPayload_t& payload, rtps::InstanceHandle_t& handle,
                           bool force_md5 = false) = 0;
  virtual bool compute_key(const void* const data, rtps::InstanceHandle_t& handle,
                           bool force_md5 = false) = 0;
  void set_name(const std::string& name);
  const std::string& get_name() const;
  std::uint32_t max_serialized_type_size;
  bool is_compute_key_provided;
};
class TypeSupport : public std::shared_ptr<TopicDataType> {
 public:
  explicit TypeSupport(TopicDataType* type);
  virtual const std::string& get_type_name() const;
};

struct LivelinessChangedStatus {
  std::int32_t not_alive_count_change;
};
struct MatchedStatus {
  std::int32_t current_count, current_count_change;
};
struct PublicationMatchedStatus : MatchedStatus {};
struct SubscriptionMatchedStatus : MatchedStatus {
  InstanceHandle_t last_publication_handle;
};
struct BaseStatus {
  std::int32_t total_count;
};
struct OfferedDeadlineMissedStatus : BaseStatus {};
struct OfferedIncompatibleQosStatus : BaseStatus {};
enum QosPolicyId_t : std::uint32_t { DATAREPRESENTATION_QOS_POLICY_ID = 23 };
struct RequestedIncompatibleQosStatus : BaseStatus {
  QosPolicyId_t last_policy_id;
};
struct LivelinessLostStatus : BaseStatus {};
class StatusMask {
 public:
  static StatusMask none();
  static StatusMask all();
  static StatusMask data_available();
  static StatusMask liveliness_changed();
  static StatusMask subscription_matched();
  static StatusMask requested_incompatible_qos();
  StatusMask& operator<<(const StatusMask& mask);
};

enum ReliabilityQosPolicyKind { BEST_EFFORT_RELIABILITY_QOS, RELIABLE_RELIABILITY_QOS };
enum DurabilityQosPolicyKind { VOLATILE_DURABILITY_QOS, TRANSIENT_LOCAL_DURABILITY_QOS };
enum HistoryQosPolicyKind { KEEP_LAST_HISTORY_QOS, KEEP_ALL_HISTORY_QOS };
enum LivelinessQosPolicyKind { AUTOMATIC_LIVELINESS_QOS };
enum PublishModeQosPolicyKind { SYNCHRONOUS_PUBLISH_MODE, ASYNCHRONOUS_PUBLISH_MODE };
struct EndpointQos {
  struct Reliability {
    ReliabilityQosPolicyKind kind;
  };
  struct Durability {
    DurabilityQosPolicyKind kind;
  };
  struct History {
    HistoryQosPolicyKind kind;
    std::int32_t depth;
  };
  struct ResourceLimits {
    std::int32_t max_samples, max_instances, max_samples_per_instance, allocated_samples;
  };
  struct Endpoint {
    rtps::MemoryManagementPolicy_t history_memory_policy;
  };
  struct DataSharing {
    void off();
  };
  struct Liveliness {
    LivelinessQosPolicyKind kind;
    Duration_t lease_duration, announcement_period;
  };
  struct Deadline {
    Duration_t period;
  };
  Reliability& reliability();
  Durability& durability();
  History& history();
  ResourceLimits& resource_limits();
  Endpoint& endpoint();
  DataSharing& data_sharing();
  Liveliness& liveliness();
  Deadline& deadline();
};
struct DataWriterQos : EndpointQos {
  struct Reliable {
    rtps::WriterTimes times;
  };
  struct PublishMode {
    PublishModeQosPolicyKind kind;
  };
  Reliable& reliable_writer_qos();
  PublishMode& publish_mode();
};
struct DataReaderQos : EndpointQos {};
struct TopicQos {};
struct PublisherQos {};
struct SubscriberQos {};
struct DomainParticipantQos {
  struct Transport {
    bool use_builtin_transports;
    std::uint32_t send_socket_buffer_size, listen_socket_buffer_size;
    std::vector<std::shared_ptr<rtps::TransportDescriptorInterface>> user_transports;
  };
  struct WireProtocol {
    rtps::BuiltinAttributes builtin;
  };
  void name(const std::string& name);
  Transport& transport();
  WireProtocol& wire_protocol();
  rtps::PropertyPolicy& properties();
};

class Topic {};
class DataWriter {
 public:
  ReturnCode_t write(const void* const data);
  ReturnCode_t get_publication_matched_status(PublicationMatchedStatus& status) const;
  ReturnCode_t get_offered_deadline_missed_status(OfferedDeadlineMissedStatus& status);
  ReturnCode_t get_offered_incompatible_qos_status(OfferedIncompatibleQosStatus& status);
  ReturnCode_t get_liveliness_lost_status(LivelinessLostStatus& status);
};
class DataWriterListener;
class Publisher {
 public:
  DataWriter* create_datawriter(Topic* topic, const DataWriterQos& qos,
                                DataWriterListener* listener = nullptr,
                                const StatusMask& mask = StatusMask::all());
  ReturnCode_t delete_datawriter(const DataWriter* writer);
};

struct SampleInfo {
  bool valid_data;
  InstanceHandle_t publication_handle;
};
class DataReader;
class DataReaderListener {
 public:
  virtual ~DataReaderListener() = default;
  virtual void on_data_available(DataReader* reader);
  virtual void on_subscription_matched(DataReader* reader, const SubscriptionMatchedStatus& status);
  virtual void on_liveliness_changed(DataReader* reader, const LivelinessChangedStatus& status);
  virtual void on_requested_incompatible_qos(DataReader* reader,
                                             const RequestedIncompatibleQosStatus& status);
};
class DataReader {
 public:
  ReturnCode_t take_next_sample(void* data, SampleInfo* info);
  ReturnCode_t set_listener(DataReaderListener* listener);
  ReturnCode_t get_subscription_matched_status(SubscriptionMatchedStatus& status) const;
  ReturnCode_t get_requested_incompatible_qos_status(RequestedIncompatibleQosStatus& status);
};
class Subscriber {
 public:
  DataReader* create_datareader(Topic* topic, const DataReaderQos& qos,
                                DataReaderListener* listener = nullptr,
                                const StatusMask& mask = StatusMask::all());
  ReturnCode_t delete_datareader(const DataReader* reader);
};

class DomainParticipant {
 public:
  ReturnCode_t register_type(TypeSupport type);
  Topic* create_topic(const std::string& name, const std::string& type, const TopicQos& qos);
  Publisher* create_publisher(const PublisherQos& qos);
  Subscriber* create_subscriber(const SubscriberQos& qos);
  ReturnCode_t delete_contained_entities();
};
class DomainParticipantListener;
class DomainParticipantFactory {
 public:
  static DomainParticipantFactory* get_instance();
  DomainParticipant* create_participant(std::uint32_t domain, const DomainParticipantQos& qos,
                                        DomainParticipantListener* listener = nullptr,
                                        const StatusMask& mask = StatusMask::all());
  ReturnCode_t delete_participant(DomainParticipant* participant);
  ReturnCode_t set_library_settings(const LibrarySettings& settings);
};

class LogConsumer;
class Log {
 public:
  struct Context {
    const char* filename;
    int line;
    const char* function;
    const char* category;
  };
  struct Entry {
    std::string message;
    Context context;
  };
  static void RegisterConsumer(std::unique_ptr<LogConsumer>&& consumer);
  static void ClearConsumers();
};
class LogConsumer {
 public:
  virtual ~LogConsumer() = default;
  virtual void Consume(const Log::Entry& entry) = 0;
};

}  // namespace dds

}  // namespace eprosima::fastdds
