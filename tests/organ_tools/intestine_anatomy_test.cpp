// The shape of an intestine as a file and as a picture.
#include "organ_tools/intestine_anatomy/gut_file.h"

#include "geometry/gut_anatomy.h"
#include "organ_tools/intestine_anatomy/gut_picture.h"
#include "tests/support/process.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <sstream>

namespace omentum::gut_picture {
namespace {

using geometry::Vec3;
using testing::HasSubstr;

const std::string kAbdomen = OMENTUM_SOURCE_DIR "/scenes/abdomen.toml";

TEST(GutFile, HoldsAxisMesenteryAndRadii) {
  const test::ScratchFolder folder;
  const geometry::GutShape gut = geometry::make_gut({});
  write_gut(folder / "gut.vtk", gut);
  std::istringstream in(test::read_text(folder / "gut.vtk"));
  std::string line;
  for (int i = 0; i < 4; ++i) std::getline(in, line);
  EXPECT_EQ(line, "DATASET POLYDATA");
  std::string word, type;
  int count = 0, numbers = 0;
  in >> word >> count >> type;
  ASSERT_EQ(count, 400);
  for (const Vec3& p : gut.positions) {
    Vec3 read;
    in >> read.x() >> read.y() >> read.z();
    ASSERT_EQ(read, p) << "to the last bit";
  }
  in >> word >> count >> numbers;
  EXPECT_EQ(word, "LINES");
  EXPECT_EQ(count, 1);
  for (int expected = -1; expected < 100; ++expected) {
    int found = -1;
    in >> found;
    EXPECT_EQ(found, expected < 0 ? 100 : expected);
  }
  in >> word >> count >> numbers;
  EXPECT_EQ(word, "POLYGONS");
  ASSERT_EQ(count, gut.layout.triangle_count());
  EXPECT_EQ(numbers, 4 * count);
  for (std::int32_t t = 0; t < count; ++t) {
    int corners = 0, a = 0, b = 0, c = 0;
    in >> corners >> a >> b >> c;
    ASSERT_EQ(corners, 3);
    const auto [x, y, z] = gut.layout.triangle(t);
    EXPECT_TRUE(a == x && b == y && c == z) << t;
  }
  while (in >> word && word != "default") continue;
  for (int m = 0; m < 400; ++m) {
    double radius = 0;
    ASSERT_TRUE(in >> radius);
    EXPECT_EQ(radius, m < 100 ? 0.02 : 0.005);
  }
  EXPECT_FALSE(in >> word) << "nothing behind it";
}

bool reddish(const force_map::Colour& c) {
  return c.red > 1.4f * c.green && c.green < 1.25f * c.blue;
}
bool yellowish(const force_map::Colour& c) {
  return c.red > c.green && c.green > 1.25f * c.blue;
}

TEST(GutPicture, ShowsTheTubeAndTheMesenteryInItsFolds) {
  PictureOptions options;
  options.from = Vec3(0, -1, 0.2).normalized();
  const geometry::GutShape gut = geometry::make_gut({});
  const force_map::Canvas canvas = draw_gut(gut, options);
  int tube = 0, mesentery = 0;
  for (int y = 0; y < canvas.height(); ++y) {
    for (int x = 0; x < canvas.width(); ++x) {
      tube += reddish(canvas.at(x, y));
      mesentery += yellowish(canvas.at(x, y));
    }
  }
  const int all = canvas.width() * canvas.height();
  EXPECT_GT(tube, all / 10);
  EXPECT_GT(mesentery, all / 40);
}

class IntestineAnatomy : public testing::Test {
 protected:
  test::ScratchFolder folder_;
};

TEST_F(IntestineAnatomy, WritesAndDrawsWhatTheSceneAndTheCommandLineSay) {
  const std::string file = folder_ / "gut.vtk", picture = folder_ / "gut.png";
  test::Process process("intestine_anatomy",
                        {kAbdomen, "--rows", "5", "-o", file, "--picture", picture, "--from", "0,0,1"});
  ASSERT_EQ(process.wait(), 0) << process.messages();
  EXPECT_THAT(process.output(), HasSubstr("5 legs; 5 x 75 masses"));
  EXPECT_THAT(process.output(), HasSubstr("(they touch at 40.0)"));
  EXPECT_THAT(test::read_text(file), HasSubstr("POINTS 375 double"));
  EXPECT_THAT(test::read_text(picture), testing::StartsWith("\x89PNG"));
}

TEST_F(IntestineAnatomy, WhatCannotBeEndsWithTwoAndOneLineAndNothingIsMade) {
  const std::string file = folder_ / "gut.vtk";
  const std::string liver = OMENTUM_SOURCE_DIR "/scenes/liver.toml";
  const struct {
    std::vector<std::string> arguments;
    const char* message;
  } refused[] = {{{"-o", file, "--legs", "12"}, "legs = 12: a gut of 4 m is too short"},
                 {{"-o", file, "--fold_pitch_m", "0.03"}, "fold_pitch_m = 0.03: expected at least 0.04658"},
                 {{"-o", file, "--legs", "6.5"}, "expected a whole number"},
                 {{"-o", file, "--origin", "1,2"}, "expected x,y,z"},
                 {{"-o", file, "--from", "0,0,0"}, "expected a direction x,y,z that is not 0,0,0"},
                 {{liver, "-o", file}, "expected an organ of model \"intestine\""},
                 {{(folder_ / "no.toml").string(), "-o", file}, "no.toml"},
                 {{"-o", (folder_ / "nowhere/gut.vtk").string()}, "cannot be written"},
                 {{}, "--output"}};
  for (const auto& [arguments, message] : refused) {
    test::Process process("intestine_anatomy", arguments);
    EXPECT_EQ(process.wait(), 2);
    EXPECT_THAT(process.messages(), testing::StartsWith("intestine_anatomy: "));
    EXPECT_THAT(process.messages(), HasSubstr(message));
    EXPECT_EQ(std::ranges::count(process.messages(), '\n'), 1);
  }
  EXPECT_TRUE(std::filesystem::is_empty(folder_.path()));
}

}  // namespace
}  // namespace omentum::gut_picture
