#include "transport/yardstick/bare_link.h"

#include <fastdds/rtps/transport/UDPv4TransportDescriptor.h>
#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/DataReaderListener.hpp>
#include <fastdds/dds/subscriber/SampleInfo.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <fastdds/dds/topic/TopicDataType.hpp>

#include <cstring>
#include <stdexcept>

namespace omentum::transport::yardstick {

namespace {

namespace dds = eprosima::fastdds::dds;

// A ToolPose's memory is its plain CDR form: every member lies at a multiple of its own size.
class RawPoseType final : public dds::TopicDataType {
 public:
  static constexpr std::uint32_t kHeader = 4;

  RawPoseType() {
    setName("omentum::msg::ToolPose");
    m_typeSize = kHeader + sizeof(msg::ToolPose);
    m_isGetKeyDefined = true;
  }
  bool serialize(void* data, eprosima::fastrtps::rtps::SerializedPayload_t* payload) override {
    constexpr std::uint8_t kPlainCdrLittleEndian[kHeader] = {0, 1, 0, 0};
    std::memcpy(payload->data, kPlainCdrLittleEndian, kHeader);
    std::memcpy(payload->data + kHeader, data, sizeof(msg::ToolPose));
    payload->length = m_typeSize;
    payload->encapsulation = CDR_LE;
    return true;
  }
  bool deserialize(eprosima::fastrtps::rtps::SerializedPayload_t* payload, void* data) override {
    if (payload->length < m_typeSize) return false;
    std::memcpy(data, payload->data + kHeader, sizeof(msg::ToolPose));
    return true;
  }
  std::function<std::uint32_t()> getSerializedSizeProvider(void*) override {
    return [size = m_typeSize] { return size; };
  }
  void* createData() override { return new msg::ToolPose; }
  void deleteData(void* data) override { delete static_cast<msg::ToolPose*>(data); }
  bool getKey(void* data, eprosima::fastrtps::rtps::InstanceHandle_t* handle, bool) override {
    eprosima::fastrtps::rtps::octet* value = handle->value;
    value[3] = static_cast<std::uint8_t>(static_cast<msg::ToolPose*>(data)->tool);
    return true;
  }
};

class BareFast final : public BareLink, private dds::DataReaderListener {
 public:
  BareFast(int domain, End end, OnSample on_sample) : on_sample_(std::move(on_sample)) {
    participant_ = dds::DomainParticipantFactory::get_instance()->create_participant(
        static_cast<std::uint32_t>(domain), participant_qos());
    if (!participant_) throw std::runtime_error("bare Fast DDS: no participant");
    dds::TypeSupport(new RawPoseType).register_type(participant_);
    dds::DataWriterQos writer_qos;
    writer_qos.reliability().kind = dds::BEST_EFFORT_RELIABILITY_QOS;
    dds::DataReaderQos reader_qos;
    reader_qos.reliability().kind = dds::BEST_EFFORT_RELIABILITY_QOS;
    const bool ping = end == End::kPing;
    writer_ = participant_->create_publisher(dds::PublisherQos())
                  ->create_datawriter(topic(ping ? "bare/ping" : "bare/pong"), writer_qos);
    reader_ = participant_->create_subscriber(dds::SubscriberQos())
                  ->create_datareader(topic(ping ? "bare/pong" : "bare/ping"), reader_qos, this,
                                      dds::StatusMask::data_available());
    if (!writer_ || !reader_) throw std::runtime_error("bare Fast DDS: no endpoints");
  }

  ~BareFast() override {
    reader_->set_listener(nullptr);
    participant_->delete_contained_entities();
    dds::DomainParticipantFactory::get_instance()->delete_participant(participant_);
  }

  void send(const msg::ToolPose& pose) override { writer_->write(const_cast<msg::ToolPose*>(&pose)); }

 private:
  static dds::DomainParticipantQos participant_qos() {
    // as ours (fast/entities.cpp), and on lo only: by default it hears no discovery there
    auto udp = std::make_shared<eprosima::fastdds::rtps::UDPv4TransportDescriptor>();
    udp->interfaceWhiteList = {"127.0.0.1"};
    dds::DomainParticipantQos qos;
    qos.transport().use_builtin_transports = false;
    qos.transport().user_transports = {udp};
    return qos;
  }

  dds::Topic* topic(const char* name) {
    return participant_->create_topic(name, "omentum::msg::ToolPose", dds::TopicQos());
  }

  void on_data_available(dds::DataReader* reader) override {
    dds::SampleInfo info;
    while (reader->take_next_sample(&pose_, &info) == eprosima::fastrtps::types::ReturnCode_t::RETCODE_OK)
      if (info.valid_data) on_sample_(pose_);
  }

  OnSample on_sample_;
  msg::ToolPose pose_;
  dds::DomainParticipant* participant_ = nullptr;
  dds::DataWriter* writer_ = nullptr;
  dds::DataReader* reader_ = nullptr;
};

}  // namespace

std::unique_ptr<BareLink> open_bare_fast(int domain, BareLink::End end, BareLink::OnSample on_sample) {
  return std::make_unique<BareFast>(domain, end, std::move(on_sample));
}

}  // namespace omentum::transport::yardstick
