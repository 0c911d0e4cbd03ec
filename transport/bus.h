// Topics over DDS: the one interface to both vendors. Of what we link, only transport/ includes DDS headers.
#pragma once

#include "transport/messages.h"  // generated from idl/ by idl/generate.py
#include "transport/qos_policy.h"

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <utility>

namespace omentum::transport {

enum class Vendor { kFast, kCyclone };

/// kLoopback: one machine, messages of up to 64 kB through lo.
/// kLan: messages that fit an Ethernet frame; a larger one would be lost with its first lost fragment.
enum class Profile { kLoopback, kLan };

struct BusOptions {
  Vendor vendor = Vendor::kFast;
  int domain = 0;
  Profile profile = Profile::kLoopback;
  std::string name{};      // the participant's name, e.g. "haptic_node"
  std::string keystore{};  // DDS Security key store; empty: unsecured
};

/// What a reader or writer saw; read by any thread (it may wait for the vendor's locks: not in a
/// real-time loop).
struct EndpointStatus {
  int matched = 0;                    // remote endpoints at this moment
  std::uint64_t samples = 0;          // handed to DDS, or to the callback
  std::uint64_t rejected = 0;         // writer: over a bound of the IDL, or refused; reader: not decodable
  std::uint64_t deadline_missed = 0;  // periods in which nothing came (or was written), all keys together
  // how often a writer's liveliness ended: of a reader only where it asked who is gone (ByWriter::on_gone)
  std::uint64_t liveliness_lost = 0;
  std::uint64_t incompatible_qos = 0;
};

/// Writes samples of one topic. write() may be called by one thread at a time.
template <class M>
class Writer {
 public:
  virtual ~Writer() = default;
  /// Sends on the calling thread (Fast DDS hands samples above one message's size to a thread of its
  /// own). False: a sequence or string is over its bound in the IDL, a string contains a zero byte, or
  /// the vendor refused, or it is joining the domain anew after a standstill of the process. Never throws.
  virtual bool write(const M& sample) noexcept = 0;
  virtual EndpointStatus status() const = 0;
};

/// Receives samples of one topic until destroyed. The callback runs on the vendor's receiving thread
/// (Cyclone: on the writing thread, for a writer in the same process), one call at a time per reader, in
/// order of arrival per writer; it must not block, throw, or destroy its reader. No call after destruction.
template <class M>
class Reader {
 public:
  virtual ~Reader() = default;
  virtual EndpointStatus status() const = 0;
};

/// Names a writer: no two that a reader hears at the same time have the same name. RTPS' own (its GUID),
/// hence alike at every reader of every vendor; one that left before it could be asked for may have another.
using WriterId = std::array<std::uint8_t, 16>;

/// Names the participant of a writer, the same for all that it writes. Under DDS Security nobody else can
/// have it; unsecured it is whatever the sender says.
using ParticipantId = std::array<std::uint8_t, 12>;
inline ParticipantId participant_of(const WriterId& writer) noexcept {
  ParticipantId participant{};
  for (std::size_t i = 0; i < participant.size(); ++i) participant[i] = writer[i];
  return participant;
}

/// For a reader that tells writers apart, which needs the first two. They are called as its callback is (see
/// Reader), never at the same time.
template <class M>
struct ByWriter {
  std::function<void(const M&, const WriterId&)> on_sample;
  /// The writer left, in whatever way: a killed one is noticed when its participant's lease is over.
  /// Everything of it came before; maybe nothing did. Who was only out of sight comes back with its durable
  /// samples.
  std::function<void(const WriterId&)> on_gone;
  /// Somebody writes the topic who offers less of that policy than this reader requests, and is not heard;
  /// the transport has said so in a line. On a thread of the vendor's, maybe beside the other two; must not
  /// block or throw.
  std::function<void(QosPolicy)> on_refused{};
};

/// One participant in one domain. Topic names and QoS come from transport/topics.h, by message type.
/// Destroy readers and writers before the bus. All methods may be called by any thread, none from a callback.
/// open() joins over DDS; who derives from it stands in for DDS (a test's scripted peer).
///
/// A process that was stopped for a while finds its partners again, if need be as a new participant: readers
/// and writers live on, and durable samples are said again.
///
/// "Matched" is not "ready" in DDS: the first samples of a volatile topic (ToolPose, SessionCommand...)
/// may be lost while two endpoints find each other; durable topics arrive whole.
class Bus {
 public:
  /// Throws std::runtime_error saying what was refused (vendor, domain, profile, security).
  /// On kLan the environment variable OMENTUM_DDS_PEERS ("ip,ip") names machines that multicast
  /// discovery does not reach.
  static std::unique_ptr<Bus> open(const BusOptions& options);
  virtual ~Bus() = default;

  /// All throw std::runtime_error when the vendor refuses. M is one of msg::AllTopics.
  template <class M>
  std::unique_ptr<Writer<M>> writer() {
    return make_writer(msg::MessageTag<M>{});
  }
  template <class M>
  std::unique_ptr<Reader<M>> reader(ByWriter<M> callbacks) {
    return make_reader(std::move(callbacks));
  }
  template <class M>
  std::unique_ptr<Reader<M>> reader(std::function<void(const M&)> on_sample) {
    return reader(ByWriter<M>{
        [callback = std::move(on_sample)](const M& sample, const WriterId&) { callback(sample); }, {}});
  }

  /// What in this machine's settings will cost samples, and what to set; empty when nothing does.
  virtual std::string warning() const = 0;

 private:
#define OMENTUM_MAKES_ENDPOINTS(M)                                                      \
  virtual std::unique_ptr<Writer<msg::M>> make_writer(msg::MessageTag<msg::M> tag) = 0; \
  virtual std::unique_ptr<Reader<msg::M>> make_reader(ByWriter<msg::M> callbacks) = 0;
  OMENTUM_FOR_EACH_TOPIC(OMENTUM_MAKES_ENDPOINTS)
#undef OMENTUM_MAKES_ENDPOINTS
};

/// Joins when it is called: whoever gets one is ready for the domain only then.
using OpenBus = std::function<std::unique_ptr<Bus>()>;

/// "fast" or "cyclone"; throws std::invalid_argument naming the choices.
Vendor parse_vendor(const std::string& word);
/// "loopback" or "lan"; throws std::invalid_argument naming the choices.
Profile parse_profile(const std::string& word);

}  // namespace omentum::transport
