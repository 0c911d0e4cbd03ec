// A reader that is stopped at any moment, by a debugger or by whoever has its processor, stops no writer.
#include "tests/transport/peer_process.h"
#include "transport/bus.h"

#include <gtest/gtest.h>

#include <atomic>
#include <fstream>
#include <thread>

namespace omentum::transport {
namespace {

using test::eventually;
using test::PeerProcess;

/// Writes poses at some 10 kHz, so that a reader wakes for each of them, and is stopped while it takes one.
class PoseStream {
 public:
  explicit PoseStream(const BusOptions& options)
      : bus_(Bus::open(options)),
        poses_(bus_->writer<msg::ToolPose>()),
        thread_([this](const std::stop_token& stop) { write(stop); }) {}

  std::uint64_t written() const { return written_; }
  int readers() const { return poses_->status().matched; }

 private:
  void write(const std::stop_token& stop) {
    for (msg::ToolPose pose; !stop.stop_requested(); written_ = ++pose.seq) {
      poses_->write(pose);
      std::this_thread::sleep_for(std::chrono::microseconds(10));
    }
  }

  std::unique_ptr<Bus> bus_;
  std::atomic<std::uint64_t> written_{0};
  std::unique_ptr<Writer<msg::ToolPose>> poses_;
  std::jthread thread_;  // last: it uses what is above
};

class StoppedReader : public testing::TestWithParam<Vendor> {};

// Of 400 stops 4 found a reader within the lock of Fast DDS' shared memory, and the writer stood for a
// second.
TEST_P(StoppedReader, StopsNoWriter) {
  constexpr int kStops = 300;
  constexpr std::uint64_t kMore = 10;        // one may have been on its way when the reader stopped
  constexpr std::uint64_t kPatience = 4000;  // poses of a stream that nobody reads, meanwhile
  const int domain = test::domain_of_test();
  PeerProcess reader("answers", GetParam(), domain);
  const PoseStream read({.vendor = GetParam(), .domain = domain, .name = "stopped_reader_test"});
  const PoseStream unread({.vendor = GetParam(), .domain = test::domain_of_test(), .name = "nobody_reads"});
  ASSERT_TRUE(eventually([&] { return read.readers() == 1; }));
  for (int turn = 0; turn < kStops; ++turn) {
    std::this_thread::sleep_for(std::chrono::microseconds(300 + 37 * turn % 500));
    const PeerProcess::Stop stop(reader);
    const std::uint64_t before = read.written(), unread_before = unread.written();
    while (read.written() < before + kMore && unread.written() < unread_before + kPatience)
      std::this_thread::sleep_for(std::chrono::microseconds(100));
    ASSERT_GE(read.written(), before + kMore) << "the reader was stopped for the " << turn + 1 << ". time";
  }
}

INSTANTIATE_TEST_SUITE_P(Each, StoppedReader, testing::Values(Vendor::kFast, Vendor::kCyclone),
                         [](const auto& info) { return info.param == Vendor::kFast ? "Fast" : "Cyclone"; });

// memory in which several processes take locks: who is stopped with one stops the others
TEST_P(StoppedReader, SharesNoMemory) {
  const int domain = test::domain_of_test();
  PeerProcess reader("answers", GetParam(), domain);
  const PoseStream read({.vendor = GetParam(), .domain = domain, .name = "stopped_reader_test"});
  ASSERT_TRUE(eventually([&] { return read.readers() == 1; }));
  std::ifstream maps("/proc/self/maps");
  for (std::string line; std::getline(maps, line);)
    EXPECT_EQ(line.find("/dev/shm/"), std::string::npos) << line;
}

}  // namespace
}  // namespace omentum::transport
