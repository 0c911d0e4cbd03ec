// Every topic's name and quality of service: the only place that lists them (docs/topics.md explains).
#pragma once

#include "transport/bus.h"
#include "transport/topic_name.h"

#include <chrono>
#include <cstddef>

namespace omentum::transport {

enum class Reliability { kBestEffort, kReliable };
enum class Durability { kVolatile, kTransientLocal };

/// How a topic travels. Samples are kept per key; zero durations mean "not used". The deadline is offered by
/// writers and counted by our readers themselves (reader_counters.h).
struct TopicSpec {
  const char* name;  // see topic_name.h
  Reliability reliability;
  Durability durability;
  int depth = 1;  // samples kept per key
  std::chrono::milliseconds deadline{0};
  std::chrono::milliseconds liveliness_lease{0};
  int writers = 1;  // of one key, each of whose samples a reader must see: it keeps `depth` for each
};

/// What a reader requests. Who does not ask which writers are gone (ByWriter::on_gone) requests no lease:
/// Fast DDS would look its writer up at each sample, under locks, 2 to 4 % of a processor for two tools at 1
/// kHz.
constexpr TopicSpec requested(TopicSpec spec, bool asks_who_is_gone) {
  if (!asks_who_is_gone) spec.liveliness_lease = {};
  return spec;
}

// A device of 1 kHz misses 40 poses before the deadline counts, one of 50 Hz still keeps it. Both
// numbers only feed counters: force safety rests on the age of each tool's newest sample (1-5 ms).
inline constexpr std::chrono::milliseconds kPoseDeadline{40};
// A killed device is reported within this; shorter leases expire falsely on a busy two-core machine.
inline constexpr std::chrono::milliseconds kPoseLease{100};
// Commands come from people and scripts: never more than a few in the time that one takes to arrive.
inline constexpr int kCommandDepth = 32;

// Several writers may describe one tool's device, and the smallest of their limits counts: what one says must
// not replace what another said and nobody took yet.
inline constexpr int kDevicesOfATool = 8;

template <class M>
inline constexpr TopicSpec kTopicSpec = [] {
  static_assert(sizeof(M) == 0, "this message has no line in transport/topics.h");
  return TopicSpec{};
}();

// clang-format off
template <> inline constexpr TopicSpec kTopicSpec<msg::ToolPose> {
    topic_name<"tool_pose">(), Reliability::kBestEffort, Durability::kVolatile, 1, kPoseDeadline, kPoseLease};
template <> inline constexpr TopicSpec kTopicSpec<msg::ToolForce> {
    topic_name<"tool_force">(), Reliability::kBestEffort, Durability::kVolatile};
template <> inline constexpr TopicSpec kTopicSpec<msg::DeviceInfo> {
    topic_name<"device_info">(), Reliability::kReliable, Durability::kTransientLocal, 1, {}, {}, kDevicesOfATool};
template <> inline constexpr TopicSpec kTopicSpec<msg::Contact> {
    topic_name<"contact">(), Reliability::kBestEffort, Durability::kVolatile};
template <> inline constexpr TopicSpec kTopicSpec<msg::LocalModel> {
    topic_name<"local_model">(), Reliability::kBestEffort, Durability::kVolatile};
template <> inline constexpr TopicSpec kTopicSpec<msg::OrganState> {
    topic_name<"organ_state">(), Reliability::kBestEffort, Durability::kVolatile};
template <> inline constexpr TopicSpec kTopicSpec<msg::OrganStress> {
    topic_name<"organ_stress">(), Reliability::kBestEffort, Durability::kVolatile};
template <> inline constexpr TopicSpec kTopicSpec<msg::Topology> {
    topic_name<"topology">(), Reliability::kReliable, Durability::kTransientLocal};
template <> inline constexpr TopicSpec kTopicSpec<msg::SceneInfo> {
    topic_name<"scene_info">(), Reliability::kReliable, Durability::kTransientLocal};
template <> inline constexpr TopicSpec kTopicSpec<msg::NodeStatus> {
    topic_name<"node_status">(), Reliability::kReliable, Durability::kTransientLocal};
template <> inline constexpr TopicSpec kTopicSpec<msg::SessionCommand> {
    topic_name<"session_command">(), Reliability::kReliable, Durability::kVolatile, kCommandDepth};
template <> inline constexpr TopicSpec kTopicSpec<msg::PointerRay> {
    topic_name<"pointer_ray">(), Reliability::kBestEffort, Durability::kVolatile};
template <> inline constexpr TopicSpec kTopicSpec<msg::TouchingPairs> {
    topic_name<"touching_pairs">(), Reliability::kBestEffort, Durability::kVolatile};
// clang-format on

/// Largest RTPS message, bytes: what one datagram carries.
constexpr std::size_t max_message_bytes(Profile profile) {
  // 64 kB is the most UDP carries; 1400 leaves room in an Ethernet frame for tunnels
  return profile == Profile::kLoopback ? 65500 : 1400;
}

/// What encryption adds to a datagram: around the message and around each part of it a header, a body's
/// length and a footer with the tag that proves it (136 bytes measured of Cyclone DDS).
inline constexpr std::size_t kSecurityBytes = 140;

/// Bytes of a large sample that one datagram carries: Cyclone's FragmentSize. Fast DDS splits a little later.
/// Secured or not, so that blocks are the same ones.
constexpr std::size_t fragment_bytes(Profile profile) {
  // a fragment travels with headers in one message: 500 and 100 bytes of margin worked
  return max_message_bytes(profile) - kSecurityBytes - (profile == Profile::kLoopback ? 500 : 100);
}

/// Most floats of one OrganState block (a multiple of 3): all of them on loopback, one datagram's on a
/// LAN, so that a lost packet costs one block of one frame.
constexpr std::size_t organ_block_floats(Profile profile) {
  // RTPS headers 60, key hash 28, encapsulation 4, and the state's other members with 8 echoes 252 bytes
  constexpr std::size_t kOverhead = 60 + 28 + 4 + 252;
  if (profile == Profile::kLoopback) return msg::MAX_BLOCK_FLOATS;
  return (fragment_bytes(profile) - kOverhead) / (3 * sizeof(float)) * 3;
}

// An OrganStress block has the nodes of its state's block, with two values for three: it fits wherever that
// does.
static_assert(3 * msg::MAX_BLOCK_NODES == msg::MAX_BLOCK_FLOATS);

/// Most pairs of one TouchingPairs block: all of them on loopback, one datagram's on a LAN.
constexpr std::size_t touching_block_pairs(Profile profile) {
  // RTPS headers 60, key hash 28, encapsulation 4, the block's other members 32 bytes; 11 numbers of 4 in
  // each
  constexpr std::size_t kOverhead = 60 + 28 + 4 + 32, kPair = 11 * 4;
  if (profile == Profile::kLoopback) return msg::MAX_TOUCHING_PAIRS;
  return (fragment_bytes(profile) - kOverhead) / kPair;
}

/// Most nodes of one LocalModel. Its compliance is needed whole, so that a LAN carries few: such a sample has
/// kLocalModelDatagrams, and at 1 % loss nine of ten arrive; one of 96 nodes would have 150, and one of five.
constexpr std::size_t local_model_nodes(Profile profile) {
  return profile == Profile::kLoopback ? msg::MAX_LOCAL_NODES : 24;
}
inline constexpr std::size_t kLocalModelDatagrams = 11;

/// Floats of its compliance, the upper triangle of 3 nodes x 3 nodes.
constexpr std::size_t local_model_floats(std::size_t nodes) {
  return 3 * nodes * (3 * nodes + 1) / 2;
}
static_assert(local_model_floats(msg::MAX_LOCAL_NODES) == msg::MAX_LOCAL_COMPLIANCE);

}  // namespace omentum::transport
