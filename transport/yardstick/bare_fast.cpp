#include "transport/fast/domain_names.h"
#include "transport/fast/plain_type.h"
#include "transport/yardstick/bare_link.h"

#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/DataReaderListener.hpp>
#include <fastdds/dds/subscriber/SampleInfo.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <fastdds/dds/topic/TypeSupport.hpp>

#include <cstring>
#include <stdexcept>

namespace omentum::transport::yardstick {

namespace {

namespace dds = eprosima::fastdds::dds;

// A ToolPose's memory is its plain CDR form: every member lies at a multiple of its own size.
class RawPoseType final : public fast::PlainType {
 public:
  RawPoseType() : PlainType("omentum::msg::ToolPose", kMostBytes, sizeof(msg::ToolPose::tool)) {}

  std::uint32_t write(const void* pose, char* bytes, std::uint32_t) const override {
    constexpr std::uint8_t kPlainCdrLittleEndian[kHeader] = {0, 1, 0, 0};
    std::memcpy(bytes, kPlainCdrLittleEndian, kHeader);
    std::memcpy(bytes + kHeader, pose, sizeof(msg::ToolPose));
    return kMostBytes;
  }
  bool read(char* bytes, std::uint32_t length, void* pose) const override {
    if (length < kMostBytes) return false;
    std::memcpy(pose, bytes + kHeader, sizeof(msg::ToolPose));
    return true;
  }
  std::uint32_t bytes_of(const void*) const override { return kMostBytes; }
  fast::KeyHash key_of(const void* pose) const override {
    return {0, 0, 0, static_cast<char>(static_cast<const msg::ToolPose*>(pose)->tool)};
  }
  void* make() const override { return new msg::ToolPose; }
  void destroy(void* pose) const override { delete static_cast<msg::ToolPose*>(pose); }

 private:
  static constexpr std::uint32_t kHeader = 4, kMostBytes = kHeader + sizeof(msg::ToolPose);
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
    auto udp = std::make_shared<fast::UDPv4TransportDescriptor>();
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
    while (reader->take_next_sample(&pose_, &info) == fast::kOk)
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
