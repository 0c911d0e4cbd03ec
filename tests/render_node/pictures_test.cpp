// Which frames become files, how fine frames are drawn, and the files themselves.
#include "render_node/frame_rate_control.h"
#include "render_node/picture_schedule.h"
#include "render_node/picture_writer.h"
#include "render_node/png_file.h"

#include "tests/support/process.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace omentum::render {
namespace {

TEST(PictureSchedule, NumbersFramesByPeriod) {
  PictureSchedule schedule(2);
  EXPECT_EQ(schedule.due(0.0, 0).numbered, "frame_0001.png");
  EXPECT_EQ(schedule.due(1.9, 0).numbered, "");
  EXPECT_EQ(schedule.due(2.0, 0).numbered, "frame_0002.png");
  EXPECT_EQ(schedule.due(9.0, 0).numbered, "frame_0003.png") << "one at a time after a pause";
}

TEST(PictureSchedule, DeepestDentIsTakenAgainWhenDeeper) {
  PictureSchedule schedule(0);
  EXPECT_FALSE(schedule.due(0, 0.0001).indent) << "nothing to see";
  EXPECT_TRUE(schedule.due(1, 0.004).indent);
  EXPECT_FALSE(schedule.due(1.5, 0.008).indent) << "once a second at most";
  EXPECT_FALSE(schedule.due(2.1, 0.0041).indent) << "5 % deeper at least";
  EXPECT_TRUE(schedule.due(2.2, 0.008).indent);
  EXPECT_FALSE(schedule.due(9, 0.005).indent);
}

TEST(FrameRateControl, FastMachineDrawsFinelyAtTheFullRate) {
  FrameRateControl control(30, 0.45);
  for (int k = 0; k < 100; ++k) {
    EXPECT_TRUE(control.due(k / 30.0));
    control.record(k / 30.0, 0.002);
  }
  EXPECT_EQ(control.quality(), Quality::kFine);
  EXPECT_FALSE(control.due(99 / 30.0 + 0.01));
}

TEST(FrameRateControl, SlowMachineGetsCoarserThenSlowerAndKeepsItsDuty) {
  FrameRateControl control(30, 0.45);
  const auto cost = [&] {
    return control.quality() == Quality::kFine ? 0.11 : control.quality() == Quality::kPlain ? 0.05 : 0.03;
  };
  double time = 0, busy = 0, begin = 0;
  for (int k = 0; k < 200; ++k) {
    while (!control.due(time)) time += 1e-3;
    if (k == 100) begin = time, busy = 0;
    control.record(time, cost());
    busy += cost();
    time += cost();
  }
  EXPECT_EQ(control.quality(), Quality::kCoarse);
  EXPECT_LT(busy / (time - begin), 0.5);
}

TEST(FrameRateControl, DoesNotSwing) {
  // neighbouring qualities differ by 2.5: none of them is both too dear and five times too cheap
  for (const double fine : {0.001, 0.01, 0.02, 0.04, 0.1, 0.3}) {
    FrameRateControl control(30, 0.45);
    int changes = 0;
    Quality last = control.quality();
    for (int k = 0; k < 500; ++k) {
      control.record(k, fine / std::pow(2.5, static_cast<int>(control.quality())));
      changes += control.quality() != last;
      last = control.quality();
    }
    EXPECT_LE(changes, 2) << fine;
  }
}

TEST(FrameRateControl, BecomesFinerAgain) {
  FrameRateControl control(30, 0.45);
  for (int k = 0; k < 50; ++k) control.record(k, 0.2);
  ASSERT_EQ(control.quality(), Quality::kCoarse);
  for (int k = 50; k < 500; ++k) control.record(k, 0.001);
  EXPECT_EQ(control.quality(), Quality::kFine);
}

Picture chequered(Size size) {
  Picture picture{size, {}};
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      for (const int c : {x * 7 % 256, y * 5 % 256, (x ^ y) % 256, 255}) {
        picture.rgba.push_back(static_cast<std::uint8_t>(c));
      }
    }
  }
  return picture;
}

TEST(PngFile, RoundTrips) {
  const omentum::test::ScratchFolder folder;
  const Picture picture = chequered({70, 41});
  write_png(picture, folder / "a.png");
  const Picture back = read_png(folder / "a.png");
  EXPECT_EQ(back.size, picture.size);
  EXPECT_EQ(back.rgba, picture.rgba);
}

TEST(PngFile, FailuresNameTheFileAndLeaveNothing) {
  const omentum::test::ScratchFolder folder;
  const auto missing = folder / "none" / "a.png";
  EXPECT_THAT(
      [&] {
        write_png(chequered({4, 4}), missing);
      },
      testing::ThrowsMessage<std::runtime_error>(testing::HasSubstr(missing.string())));
  std::filesystem::create_directory(folder / "taken.png");
  EXPECT_THROW(write_png(chequered({4, 4}), folder / "taken.png"), std::runtime_error);
  EXPECT_FALSE(std::filesystem::exists(folder / "taken.png.part"));
}

TEST(PictureWriter, WritesWhatIsLeftWhenItEnds) {
  const omentum::test::ScratchFolder folder;
  runtime::FaultList faults;
  {
    PictureWriter writer(folder / "made" / "on" / "demand", faults);
    writer.write(chequered({64, 64}), "a.png");
    writer.write(chequered({32, 32}), "b.png");
  }
  for (const char* name : {"a.png", "b.png"}) {
    EXPECT_TRUE(std::filesystem::exists(folder / "made" / "on" / "demand" / name)) << name;
  }
  EXPECT_FALSE(faults.any());
}

TEST(PictureWriter, FailureIsAFaultNotAnEnd) {
  const omentum::test::ScratchFolder folder;
  runtime::FaultList faults;
  {
    PictureWriter writer(folder.path(), faults);
    writer.write(chequered({8, 8}), "no_such_folder/a.png");
    writer.write(chequered({8, 8}), "b.png");
    EXPECT_NE(writer.finish().find("no_such_folder/a.png"), std::string::npos);
  }
  EXPECT_TRUE(faults.any());
  EXPECT_TRUE(std::filesystem::exists(folder / "b.png"));
}

TEST(PictureWriter, FolderThatCannotBeMadeIsRefusedAtStart) {
  const omentum::test::ScratchFolder folder;
  std::ofstream(folder / "file") << "x";
  runtime::FaultList faults;
  EXPECT_THROW(PictureWriter(folder / "file", faults), std::runtime_error);
}

}  // namespace
}  // namespace omentum::render
