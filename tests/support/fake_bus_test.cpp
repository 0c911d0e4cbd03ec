#include "fake_bus.h"

#include "transport/topics.h"

#include <gtest/gtest-spi.h>
#include <gtest/gtest.h>

namespace omentum::test {
namespace {

using testing::ElementsAre;
using testing::Field;
using testing::IsEmpty;
using testing::SizeIs;

msg::ToolPose pose_of(std::uint64_t seq) {
  msg::ToolPose pose{};
  pose.seq = seq;
  return pose;
}

class FakeBusTest : public testing::Test {
 protected:
  template <class M>
  auto reader_of(std::vector<std::uint64_t>& seqs) {
    return participant_->reader<M>([&seqs](const M& sample) { seqs.push_back(sample.seq); });
  }

  FakeBus bus_;
  std::unique_ptr<transport::Bus> participant_ = bus_.opener()();
};

TEST_F(FakeBusTest, APostIsHeardAtOnceByEveryReader) {
  std::vector<std::uint64_t> one, two;
  const auto first = reader_of<msg::ToolPose>(one), second = reader_of<msg::ToolPose>(two);
  bus_.post(pose_of(7));
  EXPECT_THAT(one, ElementsAre(7));
  EXPECT_THAT(two, ElementsAre(7));
}

TEST_F(FakeBusTest, WhatIsWrittenIsHeardByTheLoopsToo) {
  std::vector<std::uint64_t> heard;
  const auto reader = reader_of<msg::ToolPose>(heard);
  const auto other = bus_.opener()();
  EXPECT_TRUE(other->writer<msg::ToolPose>()->write(pose_of(3)));
  EXPECT_THAT(heard, ElementsAre(3));
}

TEST_F(FakeBusTest, LateReadersHearDurableSamplesOfEachWriterAndKey) {
  constexpr transport::WriterId kOther{0x77};
  msg::DeviceInfo info{};
  bus_.post(info);
  info.name = "newest";
  bus_.post(info);
  bus_.post(info, kOther);
  info.tool = 1;
  bus_.post(info);
  std::vector<std::string> names, gone;
  const auto reader = participant_->reader(transport::ByWriter<msg::DeviceInfo>{
      [&](const msg::DeviceInfo& heard, const transport::WriterId&) { names.push_back(heard.name); },
      [&](const transport::WriterId& writer) { gone.push_back(writer == kOther ? "other" : "peer"); }});
  EXPECT_THAT(names, ElementsAre("newest", "newest", "newest"));
  bus_.leave<msg::DeviceInfo>(kOther);
  EXPECT_THAT(gone, ElementsAre("other"));
  const auto later =
      participant_->reader<msg::DeviceInfo>([&](const msg::DeviceInfo&) { names.push_back("again"); });
  EXPECT_THAT(names, SizeIs(5)) << "the peer's two";
}

TEST_F(FakeBusTest, LosesRejectsAndReordersWhatIsPosted) {
  std::vector<std::uint64_t> heard;
  const auto reader = reader_of<msg::ToolPose>(heard);
  bus_.lose<msg::ToolPose>(1);
  bus_.post(pose_of(1));
  bus_.reject<msg::ToolPose>(1);
  bus_.post(pose_of(2));
  bus_.swap_next_two<msg::ToolPose>();
  bus_.post(pose_of(3));
  bus_.post(pose_of(4));
  bus_.post(pose_of(5));
  EXPECT_THAT(heard, ElementsAre(4, 3, 5));
  EXPECT_EQ(reader->status().rejected, 1u);
  EXPECT_EQ(reader->status().samples, 3u);
}

TEST_F(FakeBusTest, WritersRefuseOnRequestAndBeyondTheBounds) {
  const auto writer = participant_->writer<msg::SessionCommand>();
  msg::SessionCommand command{};
  EXPECT_TRUE(writer->write(command));
  bus_.refuse_writes<msg::SessionCommand>(true);
  EXPECT_FALSE(writer->write(command));
  bus_.refuse_writes<msg::SessionCommand>(false);
  command.argument.assign(161, 'x');
  EXPECT_FALSE(writer->write(command));
  EXPECT_EQ(writer->status().samples, 1u);
  EXPECT_EQ(writer->status().rejected, 2u);
  EXPECT_THAT(bus_.take_all<msg::SessionCommand>(), SizeIs(1));
}

TEST_F(FakeBusTest, AWriterSaysHowManyReadersItHas) {
  const auto writer = participant_->writer<msg::ToolPose>();
  EXPECT_EQ(writer->status().matched, 0);
  {
    std::vector<std::uint64_t> heard;
    const auto reader = reader_of<msg::ToolPose>(heard);
    EXPECT_EQ(writer->status().matched, 1);
  }
  EXPECT_EQ(writer->status().matched, 0);
}

TEST_F(FakeBusTest, ExpectationsConsumeOneSampleEach) {
  const auto writer = participant_->writer<msg::ToolPose>();
  bus_.watch<msg::ToolPose>();
  bus_.expect<msg::ToolPose>(Field(&msg::ToolPose::seq, 2u));
  for (const std::uint64_t seq : {1, 2, 2}) writer->write(pose_of(seq));
  EXPECT_THAT(bus_.left_over(), ElementsAre(std::string(transport::kTopicSpec<msg::ToolPose>.name) +
                                            ": 2 written samples were not consumed"));
  EXPECT_THAT(bus_.take_all<msg::ToolPose>(), SizeIs(2));
  EXPECT_THAT(bus_.left_over(), IsEmpty());
}

TEST(FakeBusEnd, FailsItsTestForWhatNeverCameAndForWhatNobodyTook) {
  EXPECT_NONFATAL_FAILURE(
      {
        FakeBus bus;
        bus.expect<msg::ToolPose>(testing::_);
      },
      "no sample came");
  EXPECT_NONFATAL_FAILURE(
      {
        FakeBus bus;
        bus.watch<msg::ToolPose>();
        bus.opener()()->writer<msg::ToolPose>()->write({});
      },
      "not consumed");
  EXPECT_NONFATAL_FAILURE({ FakeBus().post(msg::ToolPose{}); }, "posted to nobody");
}

}  // namespace
}  // namespace omentum::test
