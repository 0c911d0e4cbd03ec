// A process that is stopped for a while, by a debugger or a laptop's lid, and goes on.
#include "tests/transport/peer_process.h"
#include "transport/latest.h"

#include <gtest/gtest.h>

#include <atomic>
#include <thread>

namespace omentum::transport {
namespace {

using test::eventually;
using test::PeerProcess;

struct Pairing {
  Vendor frozen;
  Vendor partner;
};

/// Sends poses as fast as a device, and knows the newest that was answered.
class Asker {
 public:
  explicit Asker(Bus& bus)
      : forces_(bus.reader<msg::ToolForce>(
            [this](const msg::ToolForce& force) { answered_.store(force.echo_seq); })),
        statuses_(
            bus.reader<msg::NodeStatus>([this](const msg::NodeStatus& status) { ticks_ = status.ticks; })),
        poses_(bus.writer<msg::ToolPose>()),
        thread_([this](const std::stop_token& stop) { ask(stop); }) {}

  /// Whether a pose sent from now on is answered, and a status told from now on arrives.
  testing::AssertionResult is_answered() const {
    const std::uint64_t asked = asked_, ticks = ticks_;
    if (eventually([&] { return answered_ > asked && ticks_ > ticks + 1; }))
      return testing::AssertionSuccess();
    return testing::AssertionFailure()
           << "poses: " << poses_->status().matched << " readers, " << asked_ << " sent, " << asked
           << " then; answers: " << forces_->status().matched << " writers, to " << answered_
           << "; statuses: " << statuses_->status().matched << " writers, " << ticks_ << " told, " << ticks
           << " then";
  }

 private:
  void ask(const std::stop_token& stop) {
    for (msg::ToolPose pose; !stop.stop_requested();
         std::this_thread::sleep_for(std::chrono::milliseconds(1))) {
      asked_ = ++pose.seq;
      poses_->write(pose);
    }
  }

  std::atomic<std::uint64_t> asked_{0}, answered_{0}, ticks_{0};
  std::unique_ptr<Reader<msg::ToolForce>> forces_;
  std::unique_ptr<Reader<msg::NodeStatus>> statuses_;
  std::unique_ptr<Writer<msg::ToolPose>> poses_;
  std::jthread thread_;  // last: it uses what is above
};

// Partners that found each other just now still announce themselves often, and meet again by that alone.
constexpr std::chrono::milliseconds kSettled{1500};

class FrozenPeer : public testing::TestWithParam<Pairing> {
 protected:
  void freeze_and_expect_answers(std::chrono::milliseconds time, int times) {
    const int domain = test::domain_of_test();
    const auto bus = Bus::open({.vendor = GetParam().partner, .domain = domain, .name = "frozen_peer_test"});
    const Asker asker(*bus);
    PeerProcess peer("answers", GetParam().frozen, domain);
    ASSERT_TRUE(asker.is_answered());
    for (int turn = 0; turn < times; ++turn) {
      std::this_thread::sleep_for(kSettled);
      peer.freeze(time);
      ASSERT_TRUE(asker.is_answered()) << "stopped for the " << turn + 1 << ". time";
    }
  }
};

// longer than Cyclone's lease and Fast DDS' patience with a mailbox, shorter than Fast DDS' lease
TEST_P(FrozenPeer, AnswersAgainAfterThreeSeconds) {
  freeze_and_expect_answers(std::chrono::seconds(3), 2);
}

class LongFrozenPeer : public FrozenPeer {};

// longer than any lease: it is forgotten, and comes back as a new participant
TEST_P(LongFrozenPeer, AnswersAgain) {
  freeze_and_expect_answers(std::chrono::seconds(12), 1);
}

std::string name(const testing::TestParamInfo<Pairing>& info) {
  const auto part = [](Vendor vendor) { return vendor == Vendor::kFast ? "Fast" : "Cyclone"; };
  return std::string(part(info.param.frozen)) + "With" + part(info.param.partner);
}

INSTANTIATE_TEST_SUITE_P(AllPairings, FrozenPeer,
                         testing::Values(Pairing{Vendor::kFast, Vendor::kFast},
                                         Pairing{Vendor::kFast, Vendor::kCyclone},
                                         Pairing{Vendor::kCyclone, Vendor::kFast},
                                         Pairing{Vendor::kCyclone, Vendor::kCyclone}),
                         name);
// Cyclone tells whoever asks anew
INSTANTIATE_TEST_SUITE_P(Fast, LongFrozenPeer,
                         testing::Values(Pairing{Vendor::kFast, Vendor::kFast},
                                         Pairing{Vendor::kFast, Vendor::kCyclone}),
                         name);

}  // namespace
}  // namespace omentum::transport
