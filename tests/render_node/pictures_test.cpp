// Which frames become files, and the files themselves.
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

TEST(PictureSchedule, WhereFinePicturesAreDearNumberedOnesArePlain) {
  PictureSchedule schedule(2);
  schedule.took(0.4);
  EXPECT_EQ(schedule.quality("frame_0001.png"), Quality::kFine);
  schedule.took(1.2);
  schedule.took(0.1);
  EXPECT_EQ(schedule.quality("frame_0002.png"), Quality::kPlain);
  EXPECT_EQ(schedule.quality("final.png"), Quality::kFine);
}

TEST(PictureSchedule, WhereAFinePictureWouldStallAWindowItsCloseUpIsADraft) {
  const PictureSchedule schedule(2, true);
  EXPECT_EQ(schedule.quality(kIndentPicture), Quality::kDraft);
  EXPECT_EQ(schedule.quality("frame_0001.png"), Quality::kPlain) << "somebody asked for it";
  EXPECT_EQ(schedule.quality(kLastPicture), Quality::kFine);
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
