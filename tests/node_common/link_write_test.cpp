#include "node_common/link_write.h"

#include "tests/transport/peer_process.h"
#include "transport/topics.h"

#include <gtest/gtest.h>

#include <atomic>
#include <ctime>

#include <sched.h>

namespace omentum::node {
namespace {

double processor_time_s() {
  timespec time{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

/// All that this thread starts, and itself, share one processor.
class OneProcessor {
 public:
  OneProcessor() {
    sched_getaffinity(0, sizeof before_, &before_);
    int processor = 0;
    while (!CPU_ISSET(processor, &before_)) ++processor;
    cpu_set_t one;
    CPU_ZERO(&one);
    CPU_SET(processor, &one);
    sched_setaffinity(0, sizeof one, &one);
  }
  ~OneProcessor() { sched_setaffinity(0, sizeof before_, &before_); }

 private:
  cpu_set_t before_{};
};

bool may_be_realtime() {
  const runtime::RealtimeStart start(runtime::kHandLinkPriority);
  return sched_getscheduler(0) == SCHED_FIFO;
}

// The sending thread, woken in the middle of the write, would try the writer's lock for as long as the kernel
// lets it, 0.95 s of processor time for each.
TEST(LinkWrite, TheSendingThreadDoesNotSpinForTheLockOfAnOrdinaryThread) {
  if (!may_be_realtime()) GTEST_SKIP() << "no permission for real-time priorities";
  constexpr int kWritten = 20;
  constexpr double kMost_s = 0.3;  // what is needed is 0.02 s
  const OneProcessor processor;
  const transport::BusOptions options{.vendor = transport::Vendor::kFast,
                                      .domain = test::domain_of_test(),
                                      .profile = transport::Profile::kLan,
                                      .name = "link_write_test"};
  std::atomic<int> heard{0};
  const auto listening = transport::Bus::open(options);
  const auto reader = listening->reader<msg::NodeStatus>([&](const msg::NodeStatus&) { ++heard; });
  std::unique_ptr<transport::Bus> bus;
  std::unique_ptr<transport::Writer<msg::NodeStatus>> writer;
  {
    const runtime::RealtimeStart start(runtime::kHandLinkPriority);
    bus = transport::Bus::open(options);
    writer = bus->writer<msg::NodeStatus>();
  }
  ASSERT_TRUE(test::eventually([&] { return writer->status().matched == 1; }));
  const double begin_s = processor_time_s();
  for (int i = 1; i <= kWritten; ++i) {
    write_as_link(*writer, msg::NodeStatus{});
    ASSERT_TRUE(test::eventually([&] { return heard == i; }));
  }
  EXPECT_LT(processor_time_s() - begin_s, kMost_s);
}

}  // namespace
}  // namespace omentum::node
