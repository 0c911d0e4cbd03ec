// A haptic device's bridge from the IDL alone, in C++ on Fast DDS 2: no line of Omentum is linked. The
// messages are written out field by field, in the order of idl/tool.idl; `fastddsgen -cs idl/tool.idl` makes
// the same. A maker replaces hand_step() by encoders and motors.
//
//   c++ -std=c++17 fast_bridge.cpp -lfastrtps -lfastcdr -o fast_bridge
//   fast_bridge DOMAIN             beside device_check, or `launch_scripts/run --device none --domain DOMAIN`
#include "bridge_rules.h"

#include <fastcdr/Cdr.h>
#include <fastdds/rtps/transport/UDPv4TransportDescriptor.h>
#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/SampleInfo.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <fastdds/dds/topic/TopicDataType.hpp>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <memory>
#include <string>

namespace {

using namespace eprosima::fastdds::dds;
using eprosima::fastcdr::Cdr;
using eprosima::fastrtps::Duration_t;
using eprosima::fastrtps::rtps::InstanceHandle_t;
using eprosima::fastrtps::rtps::SerializedPayload_t;

const std::string kPrefix = "omentum/2/";  // PROTOCOL_VERSION of idl/common.idl

struct Vec3 {
  double x = 0, y = 0, z = 0;
};
struct ToolPose {
  std::uint32_t tool = 0;
  std::uint64_t seq = 0;
  std::int64_t stamp_ns = 0;
  bool valid = true;
  std::uint32_t buttons = 0;
  Vec3 position;
  double orientation[4] = {1, 0, 0, 0};  // w, x, y, z
  Vec3 linear_velocity, angular_velocity;
  double grip = 0;
  std::uint64_t answer_seq = 0;
};
struct ToolForce {
  std::uint32_t tool = 0;
  std::uint64_t seq = 0, tick = 0, echo_seq = 0;
  std::int64_t echo_stamp_ns = 0;
  Vec3 force, torque;
  double grip_torque = 0, valid_for_s = 0;
  std::uint32_t state = 0;
};
struct DeviceInfo {
  std::uint32_t tool = 0;
  std::string name;
  double max_force_n = 0, max_torque_nm = 0, max_stiffness_n_m = 0, damping_n_s_m = 0;
  Vec3 workspace_min, workspace_max;
  std::uint32_t sensed_axes = 0, actuated_axes = 0;
};

// Hands every field of a message to `each`, in the IDL's order: to be written or read.
template <class F>
void fields(F&& each, Vec3& v) {
  each(v.x), each(v.y), each(v.z);
}
template <class F>
void fields(F&& each, ToolPose& p) {
  each(p.tool), each(p.seq), each(p.stamp_ns), each(p.valid), each(p.buttons);
  fields(each, p.position);
  for (double& component : p.orientation) each(component);
  fields(each, p.linear_velocity), fields(each, p.angular_velocity);
  each(p.grip), each(p.answer_seq);
}
template <class F>
void fields(F&& each, ToolForce& f) {
  each(f.tool), each(f.seq), each(f.tick), each(f.echo_seq), each(f.echo_stamp_ns);
  fields(each, f.force), fields(each, f.torque);
  each(f.grip_torque), each(f.valid_for_s), each(f.state);
}
template <class F>
void fields(F&& each, DeviceInfo& d) {
  each(d.tool), each(d.name), each(d.max_force_n), each(d.max_torque_nm), each(d.max_stiffness_n_m),
      each(d.damping_n_s_m);
  fields(each, d.workspace_min), fields(each, d.workspace_max);
  each(d.sensed_axes), each(d.actuated_axes);
}

template <class M>
class MessageType final : public TopicDataType {
 public:
  explicit MessageType(const char* name) {
    setName(name);
    m_typeSize = 512;
    m_isGetKeyDefined = true;  // the tool
  }
  bool serialize(void* message, SerializedPayload_t* payload) override {
    eprosima::fastcdr::FastBuffer buffer(reinterpret_cast<char*>(payload->data), payload->max_size);
    Cdr cdr(buffer, Cdr::DEFAULT_ENDIAN, Cdr::DDS_CDR);
    payload->encapsulation = CDR_LE;
    cdr.serialize_encapsulation();
    fields([&](auto& field) { cdr << field; }, *static_cast<M*>(message));
    payload->length = static_cast<std::uint32_t>(cdr.getSerializedDataLength());
    return true;
  }
  bool deserialize(SerializedPayload_t* payload, void* message) override try {
    eprosima::fastcdr::FastBuffer buffer(reinterpret_cast<char*>(payload->data), payload->length);
    Cdr cdr(buffer, Cdr::DEFAULT_ENDIAN, Cdr::DDS_CDR);
    cdr.read_encapsulation();
    fields([&](auto& field) { cdr >> field; }, *static_cast<M*>(message));
    return true;
  } catch (const eprosima::fastcdr::exception::Exception&) {
    return false;  // not of this type
  }
  std::function<std::uint32_t()> getSerializedSizeProvider(void*) override {
    return [this] { return m_typeSize; };
  }
  // the key in big endian: DDSI-RTPS, "serialized key"
  bool getKey(void* message, InstanceHandle_t* handle, bool) override {
    const std::uint32_t tool = static_cast<M*>(message)->tool;
    for (int i = 0; i < 4; ++i) handle->value[i] = static_cast<std::uint8_t>(tool >> (24 - 8 * i));
    return true;
  }
  void* createData() override { return new M; }
  void deleteData(void* message) override { delete static_cast<M*>(message); }
};

volatile std::sig_atomic_t running = 1;

template <class T>
T* checked(T* entity, const char* what) {
  if (entity) return entity;
  std::fprintf(stderr, "fast_bridge: Fast DDS refused %s\n", what);
  std::exit(2);
}

// transport/topics.h has the quality of every topic
template <class Qos>
Qos quality(bool durable) {
  Qos qos;
  qos.reliability().kind = durable ? RELIABLE_RELIABILITY_QOS : BEST_EFFORT_RELIABILITY_QOS;
  qos.durability().kind = durable ? TRANSIENT_LOCAL_DURABILITY_QOS : VOLATILE_DURABILITY_QOS;
  qos.history().depth = 1;
  qos.endpoint().history_memory_policy = eprosima::fastrtps::rtps::DYNAMIC_REUSABLE_MEMORY_MODE;
  return qos;
}

// one machine: UDP on lo; for several machines leave the transports as they are
DomainParticipant* join(int domain) {
  DomainParticipantQos qos;
  qos.name("fast_bridge");
  auto udp = std::make_shared<eprosima::fastdds::rtps::UDPv4TransportDescriptor>();
  udp->interfaceWhiteList = {"127.0.0.1"};
  qos.transport().use_builtin_transports = false;
  qos.transport().user_transports.push_back(udp);
  qos.wire_protocol().builtin.discovery_config.leaseDuration_announcementperiod = Duration_t(0, 500'000'000);
  return DomainParticipantFactory::get_instance()->create_participant(static_cast<std::uint32_t>(domain),
                                                                      qos);
}

template <class M>
Topic* topic(DomainParticipant& participant, const char* type, const char* message) {
  TypeSupport(new MessageType<M>(type)).register_type(&participant);
  return checked(participant.create_topic(kPrefix + message, type, TopicQos()), message);
}

void take_answers(DataReader& forces, Bridge& bridge) {
  ToolForce force;
  SampleInfo info;
  while (forces.take_next_sample(&force, &info) == eprosima::fastrtps::types::ReturnCode_t::RETCODE_OK) {
    if (!info.valid_data || force.tool != 0) continue;
    const Answer answer{force.seq,           force.echo_seq,
                        force.echo_stamp_ns, {force.force.x, force.force.y, force.force.z},
                        force.valid_for_s,   force.state};
    bridge_take(&bridge, &answer, now_ns());
  }
}

void fill(ToolPose& pose, const Hand& hand) {
  pose.position = {hand.at[0], hand.at[1], hand.at[2]};
  pose.linear_velocity = {hand.velocity[0], hand.velocity[1], hand.velocity[2]};
  pose.orientation[0] = std::cos(hand.roll / 2);
  pose.orientation[3] = std::sin(hand.roll / 2);
  pose.angular_velocity = {0, 0, hand.roll_speed};
}

void run(DomainParticipant& participant) {
  auto* publisher = checked(participant.create_publisher(PublisherQos()), "a publisher");
  auto* subscriber = checked(participant.create_subscriber(SubscriberQos()), "a subscriber");
  auto written = quality<DataWriterQos>(false);
  written.deadline().period = Duration_t(0, 40'000'000);
  written.liveliness().lease_duration = Duration_t(0, 100'000'000);
  written.liveliness().announcement_period = Duration_t(0, 33'000'000);
  auto& poses = *checked(publisher->create_datawriter(
                             topic<ToolPose>(participant, "omentum::msg::ToolPose", "tool_pose"), written),
                         "poses");
  auto& infos = *checked(
      publisher->create_datawriter(topic<DeviceInfo>(participant, "omentum::msg::DeviceInfo", "device_info"),
                                   quality<DataWriterQos>(true)),
      "device_info");
  auto& forces = *checked(
      subscriber->create_datareader(topic<ToolForce>(participant, "omentum::msg::ToolForce", "tool_force"),
                                    quality<DataReaderQos>(false)),
      "forces");

  DeviceInfo info{0, "example in C++", kMaxForce_n, 0.1, 2000, 0, {-0.2, -0.2, -0.1}, {0.2, 0.2, 0.3}, 63, 7};
  infos.write(&info);
  Bridge bridge{};
  Hand hand{};
  hand.at[0] = -0.048, hand.at[1] = -0.015, hand.at[2] = 0.053;
  ToolPose pose;
  const std::int64_t begin = now_ns();
  for (std::int64_t tick = begin; running; tick += kPeriod_ns) {
    sleep_until_ns(tick);
    take_answers(forces, bridge);
    pose.answer_seq = bridge_exert(&bridge, now_ns());  // under it the hand comes to the pose below
    hand_step(&hand, bridge.exerted, 1e-9 * static_cast<double>(tick - begin));
    fill(pose, hand);
    ++pose.seq;
    pose.stamp_ns = now_ns();
    bridge_sent(&bridge, pose.seq, pose.stamp_ns);
    poses.write(&pose);
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: fast_bridge DOMAIN\n");
    return 2;
  }
  const auto stop = [](int) { running = 0; };
  std::signal(SIGTERM, stop);
  std::signal(SIGINT, stop);
  auto* participant = checked(join(std::atoi(argv[1])), "a participant");
  run(*participant);
  participant->delete_contained_entities();  // "end": it leaves, and nothing is exerted any more
  DomainParticipantFactory::get_instance()->delete_participant(participant);
  return 0;
}
