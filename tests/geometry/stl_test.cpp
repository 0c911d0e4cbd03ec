// Surfaces of STL files.
#include "geometry/mesh_io/stl.h"
#include "geometry/tetra_mesh.h"

#include <gmock/gmock.h>

#include <cstring>
#include <fstream>

namespace omentum::geometry {
namespace {

using ::testing::HasSubstr;

std::filesystem::path put_stl(const std::string& contents) {
  const auto* info = ::testing::UnitTest::GetInstance()->current_test_info();
  const auto file = std::filesystem::path(::testing::TempDir()) / (std::string(info->name()) + ".stl");
  std::ofstream(file, std::ios::binary) << contents;
  return file;
}

std::string ascii_facet(const std::string& a, const std::string& b, const std::string& c) {
  return "facet normal 0 0 1\nouter loop\nvertex " + a + "\nvertex " + b + "\nvertex " + c +
         "\nendloop\nendfacet\n";
}

std::string binary_stl(const std::string& title, const std::vector<std::array<float, 9>>& triangles) {
  std::string bytes = title;
  bytes.resize(80, ' ');
  const auto add = [&bytes](const auto& value) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof(value));
  };
  add(static_cast<std::uint32_t>(triangles.size()));
  for (const auto& corners : triangles) {
    add(std::array<float, 3>{0, 0, 1});
    add(corners);
    add(std::uint16_t{0});
  }
  return bytes;
}

std::string refusal_of(const std::string& contents) {
  try {
    read_stl(put_stl(contents));
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

/// Two triangles of a square of 10, and one that is only a line.
void expect_square(const TriangleSurface& surface) {
  ASSERT_EQ(surface.positions.size(), 4u) << "corners in one place are one";
  ASSERT_EQ(surface.triangles.size(), 2u);
  Vec3 area = Vec3::Zero();
  for (const auto& [a, b, c] : surface.triangles) {
    const Vec3 p = surface.positions[static_cast<std::size_t>(a)];
    area += 0.5 * (surface.positions[static_cast<std::size_t>(b)] - p)
                      .cross(surface.positions[static_cast<std::size_t>(c)] - p);
  }
  EXPECT_NEAR((area - Vec3(0, 0, 100)).norm(), 0, 1e-9) << "outward as the file has it";
}

TEST(Stl, AsciiIsReadAndWelded) {
  const auto file = put_stl("solid square of two\n" + ascii_facet("0 0 0", "10 0 0", "10 10 0") +
                            ascii_facet("0 0 0", "1e1 10 0", "0 10 0") +
                            ascii_facet("0 0 0", "0 0 0", "10 0 0") + "endsolid square of two\n");
  EXPECT_TRUE(is_stl(file));
  expect_square(read_stl(file));
}

TEST(Stl, BinaryIsReadWhateverItsTitleSays) {
  for (const char* title : {"made by hand", "solid is what a title may begin with"}) {
    const auto file = put_stl(binary_stl(
        title,
        {{0, 0, 0, 10, 0, 0, 10, 10, 0}, {0, 0, 0, 10, 10, 0, 0, 10, 0}, {0, 0, 0, 0, 0, 0, 10, 0, 0}}));
    EXPECT_TRUE(is_stl(file)) << title;
    expect_square(read_stl(file));
  }
}

TEST(Stl, WhatIsBrokenIsRefusedWithItsPlace) {
  const std::string good = binary_stl("cut off", {{0, 0, 0, 10, 0, 0, 10, 10, 0}});
  EXPECT_THAT(refusal_of(good.substr(0, good.size() - 7)), HasSubstr("expected an STL surface"));
  EXPECT_THAT(refusal_of("solid s\nfacet normal 0 0 1\nouter loop\nvertex 0 0 zero\n"),
              HasSubstr(".stl:4: found 'zero', expected a coordinate of a vertex"));
  EXPECT_THAT(refusal_of("solid s\nouter loop\nvertex 0 0 0\nendloop\n"), HasSubstr(":4: found 1 vertices"));
  EXPECT_THAT(refusal_of("solid s\nvertex 0 0 nan\n"), HasSubstr("finite corners"));
  EXPECT_THAT(refusal_of("solid empty\nendsolid\n"), HasSubstr("found no triangle"));
  EXPECT_FALSE(is_stl(put_stl("$MeshFormat\n2.2 0 8\n")));
}

TEST(Stl, ARealOneIsClosed) {
  const std::filesystem::path file = OMENTUM_SOURCE_DIR "/../shared/data/surface/openhelp_Stomach.stl";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << "the real surfaces are absent";
  const TriangleSurface stomach = read_stl(file);
  EXPECT_EQ(stomach.positions.size(), 4864u);
  EXPECT_EQ(stomach.triangles.size(), 9724u);
}

}  // namespace
}  // namespace omentum::geometry
