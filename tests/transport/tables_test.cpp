// Several operating tables on one machine: each has a domain, and none hears another.
#include "tests/transport/peer_process.h"

#include <gtest/gtest.h>

#include <atomic>
#include <memory>
#include <vector>

namespace omentum::transport {
namespace {

using test::eventually;

/// A session's loop in small: one bus that moves a tool, and one that reads it and tells what it read.
class Table {
 public:
  Table(std::uint32_t number, Vendor vendor)
      : number_(number),
        hand_(Bus::open({.vendor = vendor, .domain = domain_, .name = "hand"})),
        node_(Bus::open({.vendor = vendor, .domain = domain_, .name = "node"})),
        poses_(hand_->writer<msg::ToolPose>()),
        forces_(node_->writer<msg::ToolForce>()),
        heard_poses_(node_->reader<msg::ToolPose>([this](const msg::ToolPose& pose) {
          judge(pose.tool);
          forces_->write({.tool = pose.tool, .seq = pose.seq, .echo_seq = pose.seq});
        })),
        heard_forces_(hand_->reader<msg::ToolForce>([this](const msg::ToolForce& force) {
          judge(force.tool);
          answers_ += force.tool == number_;
        })) {}

  void move() {
    // what tells tables apart here is the tool; sessions all have a tool 0
    poses_->write({.tool = number_, .seq = ++seq_});
  }
  int answers() const { return answers_; }
  int others() const { return others_; }

 private:
  void judge(std::uint32_t tool) { others_ += tool != number_; }

  const std::uint32_t number_;
  const int domain_ = test::domain_of_test();
  std::uint64_t seq_ = 0;
  std::atomic<int> answers_{0}, others_{0};
  std::unique_ptr<Bus> hand_, node_;
  std::unique_ptr<Writer<msg::ToolPose>> poses_;
  std::unique_ptr<Writer<msg::ToolForce>> forces_;
  std::unique_ptr<Reader<msg::ToolPose>> heard_poses_;
  std::unique_ptr<Reader<msg::ToolForce>> heard_forces_;
};

TEST(Tables, TenOnOneMachineDoNotHearEachOther) {
  constexpr std::uint32_t kTables = 10;
  constexpr int kAnswers = 100;
  std::vector<std::unique_ptr<Table>> tables;
  for (std::uint32_t number = 0; number < kTables; ++number)
    tables.push_back(std::make_unique<Table>(number, number % 2 == 0 ? Vendor::kFast : Vendor::kCyclone));
  // each is at work, all at the same time
  EXPECT_TRUE(eventually([&] {
    bool all = true;
    for (const auto& table : tables) {
      table->move();
      all = all && table->answers() >= kAnswers;
    }
    return all;
  }));
  for (const auto& table : tables) EXPECT_EQ(table->others(), 0);
}

}  // namespace
}  // namespace omentum::transport
