#include "transport/cyclone/complaints.h"

#include "transport/complaints.h"

#include <dds/ddsrt/log.h>

#include <map>
#include <mutex>
#include <string>

namespace omentum::transport::cyclone {

namespace {

struct Complaints {
  std::mutex mutex;
  std::map<std::string, std::uint64_t, std::less<>> undecodable;  // by topic
};

// Process-wide because Cyclone's log is.
Complaints& complaints() {
  static Complaints complaints;
  return complaints;
}

// "... deserialization TOPIC/TYPE failed ...": the topic; empty for another message
std::string_view undecodable_topic(std::string_view message) {
  constexpr std::string_view kBefore = "deserialization ", kAfter = " failed";
  const std::size_t before = message.find(kBefore);
  if (before == std::string_view::npos) return {};
  message.remove_prefix(before + kBefore.size());
  message = message.substr(0, message.find(kAfter));
  const std::size_t type = message.rfind('/');
  return type == std::string_view::npos ? std::string_view{} : message.substr(0, type);
}

// "ddsi_udp_conn_write to udp/ADDRESS:PORT failed ...": the address; empty for another message
std::string_view unreachable_address(std::string_view message) {
  constexpr std::string_view kBefore = "conn_write to udp/";
  const std::size_t before = message.find(kBefore);
  if (before == std::string_view::npos) return {};
  message.remove_prefix(before + kBefore.size());
  return message.substr(0, message.find(':'));
}

void complain_of_address(std::string_view address) {
  complain_once("Cyclone DDS", address,
                std::string(address) + " cannot be reached: nothing that is sent there arrives");
}

void complain_of_topic(std::string_view topic, std::string_view message) {
  {
    Complaints& all = complaints();
    const std::lock_guard lock(all.mutex);
    ++all.undecodable[std::string(topic)];
  }
  complain_once("Cyclone DDS", topic, message);
}

// on whatever thread complains
void hear(void*, const dds_log_data_t* data) {
  const std::string_view message(data->message, data->size);
  if (const std::string_view topic = undecodable_topic(message); !topic.empty())
    return complain_of_topic(topic, message);
  if (const std::string_view address = unreachable_address(message); !address.empty())
    return complain_of_address(address);
  // a place in Cyclone's sources is a kind of message
  complain_once("Cyclone DDS", std::string(data->file).append(":").append(std::to_string(data->line)),
                message);
}

}  // namespace

void tell_complaints_once() {
  static std::once_flag begun;
  std::call_once(begun, [] {
    complaints();  // made before, so that it ends after whoever made Cyclone complain
    dds_set_log_sink(hear, nullptr);
  });
}

std::uint64_t undecodable(std::string_view topic) {
  Complaints& all = complaints();
  const std::lock_guard lock(all.mutex);
  const auto count = all.undecodable.find(topic);
  return count == all.undecodable.end() ? 0 : count->second;
}

}  // namespace omentum::transport::cyclone
