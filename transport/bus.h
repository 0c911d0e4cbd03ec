// Topics over DDS: the one interface to both vendors. Only transport/ includes DDS headers.
#pragma once

#include "transport/messages.h"  // generated from idl/ by idl/generate.py

#include <functional>
#include <memory>
#include <string>

namespace omentum::transport {

enum class Vendor { kFast, kCyclone };
enum class Profile { kLoopback, kLan };

struct BusOptions {
  Vendor vendor = Vendor::kFast;
  int domain = 0;
  Profile profile = Profile::kLoopback;
  std::string name;              // the participant's name, e.g. "haptic_node"
  std::string keystore;          // DDS Security key store; empty: unsecured
};

/// What a reader or writer saw; read by any thread.
struct EndpointStatus {
  int matched = 0;                      // remote endpoints at this moment
  std::uint64_t samples = 0;
  std::uint64_t deadline_missed = 0;
  std::uint64_t liveliness_lost = 0;
  std::uint64_t incompatible_qos = 0;
};

/// Writes samples of one topic. write() may be called by one thread at a time.
template <class M>
class Writer {
 public:
  virtual ~Writer() = default;
  virtual bool write(const M& sample) noexcept = 0;
  virtual EndpointStatus status() const = 0;
};

/// Receives samples of one topic until destroyed. The callback runs on the vendor's thread, one call at
/// a time per reader, in order of arrival per writer; it must not block. No call after destruction.
template <class M>
class Reader {
 public:
  virtual ~Reader() = default;
  virtual EndpointStatus status() const = 0;
};

/// One participant in one domain. Topic names and QoS come from transport/topics.h, by message type.
/// Destroy readers and writers before the bus.
class Bus {
 public:
  /// Throws std::runtime_error saying what was refused (vendor, domain, profile, security).
  static std::unique_ptr<Bus> open(const BusOptions& options);
  virtual ~Bus() = default;

  template <class M>
  std::unique_ptr<Writer<M>> writer();
  template <class M>
  std::unique_ptr<Reader<M>> reader(std::function<void(const M&)> on_sample);
};

/// "fast" or "cyclone"; throws std::invalid_argument naming the choices.
Vendor parse_vendor(const std::string& word);
Profile parse_profile(const std::string& word);

}  // namespace omentum::transport
