#include "transport/cyclone/complaints.h"

#include <dds/ddsrt/log.h>

#include <cstdio>
#include <map>
#include <mutex>
#include <set>
#include <string>
#include <utility>

namespace omentum::transport::cyclone {

namespace {

using Place = std::pair<const char*, std::uint32_t>;  // in Cyclone's sources: a kind of message

struct Complaints {
  std::mutex mutex;
  std::set<Place> told_places;
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

void tell(std::string_view message) {
  while (!message.empty() && message.back() == '\n') message.remove_suffix(1);
  std::fprintf(stderr, "Cyclone DDS: %.*s (further ones are not told)\n", static_cast<int>(message.size()),
               message.data());
}

// on whatever thread complains
void hear(void*, const dds_log_data_t* data) {
  const std::string_view message(data->message, data->size);
  const std::string_view topic = undecodable_topic(message);
  Complaints& all = complaints();
  const std::lock_guard lock(all.mutex);
  bool first = false;
  if (topic.empty()) {
    first = all.told_places.emplace(data->file, data->line).second;
  } else {
    const auto known = all.undecodable.find(topic);
    first = known == all.undecodable.end();
    ++(first ? all.undecodable[std::string(topic)] : known->second);
  }
  if (first) tell(message);
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
