// Which frames a video is made of, and that its pictures are there without a gap.
#include "render_node/png_file.h"
#include "render_node/video_recorder.h"
#include "render_node/video_slots.h"

#include "tests/support/process.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <fstream>
#include <numeric>

namespace omentum::render {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::SizeIs;

TEST(VideoSlots, FramesFasterThanTheVideoAreLeftOut) {
  VideoSlots slots(25, 10);
  std::vector<std::int64_t> taken;
  for (int frame = 0; frame < 60; ++frame)
    if (const auto number = slots.take(10 + frame / 60.0)) taken.push_back(*number);
  std::vector<std::int64_t> every(25);
  std::iota(every.begin(), every.end(), 0);
  EXPECT_EQ(taken, every);
}

TEST(VideoSlots, FramesOfItsOwnRateAreAllTaken) {
  VideoSlots slots(30, 0);
  for (int frame = 0; frame < 1000; ++frame) EXPECT_EQ(slots.take(frame / 30.0), frame);
}

TEST(VideoSlots, ALateFrameHasItsOwnMomentAndTheVideoLastsAsLongAsTheSession) {
  VideoSlots slots(25, 0);
  EXPECT_EQ(slots.take(0.001), 0);
  EXPECT_EQ(slots.take(0.41), 10);
  EXPECT_EQ(slots.take(0.42), std::nullopt) << "taken";
  EXPECT_EQ(slots.take(0.45), 11);
  EXPECT_EQ(slots.count(2.0), 50);
  EXPECT_EQ(slots.count(0.45), 12) << "what was taken is shown";
}

TEST(ShownPictures, StandUntilTheNextCame) {
  EXPECT_THAT(shown_pictures(std::vector<std::int64_t>{2, 3, 6}, 8), ElementsAre(2, 2, 2, 3, 3, 3, 6, 6));
  EXPECT_THAT(shown_pictures({}, 8), IsEmpty());
}

TEST(VideoPictureName, SortsByNumber) {
  EXPECT_EQ(video_picture_name(42), "000042.png");
  EXPECT_LT(video_picture_name(99'999), video_picture_name(100'000));
}

class VideoRecording : public testing::Test {
 protected:
  // A frame of this moment, of one shade.
  void frame(double time_s, std::uint8_t shade) {
    if (!recorder_.due(time_s)) return;
    recorder_.take({{8, 8}, std::vector<std::uint8_t>(4 * 64, shade)});
  }
  int shade(int number) { return read_png(folder_ / "video" / video_picture_name(number)).rgba[0]; }
  omentum::test::ScratchFolder folder_;
  runtime::FaultList faults_;
  VideoRecorder recorder_{folder_.path(), 10, faults_};
};

TEST_F(VideoRecording, RepeatsWhatWasSeenWhereAFrameCameLate) {
  recorder_.begin(5);
  frame(5.01, 10);
  frame(5.05, 20);  // of the same tenth
  frame(5.31, 30);
  recorder_.end(5.6);
  EXPECT_FALSE(recorder_.on());
  recorder_.finish(6);
  std::vector<int> shades;
  for (int k = 0; k < 6; ++k) shades.push_back(shade(k));
  EXPECT_THAT(shades, ElementsAre(10, 10, 10, 30, 30, 30));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "video" / video_picture_name(6)));
  const auto report = recorder_.report();
  ASSERT_THAT(report, SizeIs(1));
  EXPECT_EQ(report[0]["pictures"], 6);
  EXPECT_EQ(report[0]["repeated"], 4);
  EXPECT_EQ(report[0]["dropped"], 0);
  EXPECT_NEAR(report[0]["seconds"].get<double>(), 0.6, 1e-9);
  EXPECT_FALSE(faults_.any());
}

TEST_F(VideoRecording, WhatFindsNoRoomIsCountedAndNoFault) {
  recorder_.begin(0);
  constexpr int kFrames = 40;  // within microseconds: packing so many pictures of this size takes longer
  for (int k = 0; k < kFrames; ++k)
    if (recorder_.due(k / 10.0))
      recorder_.take({{500, 400}, std::vector<std::uint8_t>(std::size_t{4} * 500 * 400, 99)});
  const RecordingRow row = recorder_.row(kFrames / 10.0);
  EXPECT_GT(row.dropped, 0u);
  EXPECT_EQ(row.pictures + row.dropped, static_cast<std::uint64_t>(kFrames));
  recorder_.finish(kFrames / 10.0);
  const auto video = recorder_.report()[0];
  EXPECT_EQ(video["pictures"], kFrames);
  EXPECT_EQ(video["repeated"], video["dropped"]);
  EXPECT_FALSE(faults_.any());
}

TEST_F(VideoRecording, ASecondVideoLeavesTheFirst) {
  for (int video = 0; video < 2; ++video) {
    recorder_.begin(video);
    frame(video, 7);
    recorder_.end(video + 0.1);
  }
  recorder_.finish(2);
  for (const char* name : {"video", "video_2"})
    EXPECT_TRUE(std::filesystem::exists(folder_ / name / "000000.png")) << name;
}

TEST_F(VideoRecording, AFolderThatCannotBeMadeIsAFault) {
  std::ofstream(folder_ / "file") << "x";
  VideoRecorder recorder(folder_ / "file", 10, faults_);
  recorder.begin(0);
  EXPECT_FALSE(recorder.on());
  EXPECT_TRUE(faults_.any());
}

}  // namespace
}  // namespace omentum::render
