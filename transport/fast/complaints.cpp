#include "transport/fast/complaints.h"

#include "transport/complaints.h"

#include <fastdds/dds/log/Log.hpp>

#include <memory>
#include <mutex>
#include <string>
#include <string_view>

namespace omentum::transport::fast {

namespace {

using eprosima::fastdds::dds::Log;
using eprosima::fastdds::dds::LogConsumer;

// Written now and then when a writer with a lease is heard for the first time; nothing comes of it.
constexpr std::string_view kIdleTalk = "Error when restarting liveliness timer";

class Complaints final : public LogConsumer {
 public:
  // on the log's own thread
  void Consume(const Log::Entry& entry) override {
    if (entry.message.starts_with(kIdleTalk)) return;
    // a place in Fast DDS' sources is a kind of message
    const char* category = entry.context.category ? entry.context.category : "";
    const char* function = entry.context.function ? entry.context.function : "";
    complain_once("Fast DDS",
                  std::string(category) + ' ' + function + ' ' + std::to_string(entry.context.line),
                  entry.message);
  }
};

}  // namespace

void tell_complaints_once() {
  static std::once_flag begun;
  std::call_once(begun, [] {
    Log::ClearConsumers();
    Log::RegisterConsumer(std::make_unique<Complaints>());
  });
}

}  // namespace omentum::transport::fast
