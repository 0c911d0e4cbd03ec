#include "geometry/mesh_io/stl.h"

#include "geometry/mesh_io/file_cursor.h"
#include "geometry/mesh_io/file_kind.h"

#include <cmath>
#include <map>
#include <optional>

namespace omentum::geometry {
namespace {

constexpr std::size_t kTitle_bytes = 80, kNormal_bytes = 3 * sizeof(float), kAttribute_bytes = 2;
constexpr std::size_t kTriangle_bytes = kNormal_bytes + 9 * sizeof(float) + kAttribute_bytes;

using Corner = std::array<double, 3>;

/// Gives each place one node.
class Weld {
 public:
  void add(const std::array<Corner, 3>& corners) {
    Triangle triangle{};
    for (std::size_t c = 0; c < 3; ++c) triangle[c] = node(corners[c]);
    const auto& [a, b, c] = triangle;
    if (a != b && b != c && c != a) surface_.triangles.push_back(triangle);
  }
  TriangleSurface take() { return std::move(surface_); }

 private:
  SurfaceId node(const Corner& corner) {
    const auto [found, is_new] = nodes_.try_emplace(corner, SurfaceId(surface_.positions.size()));
    if (is_new) surface_.positions.emplace_back(corner[0], corner[1], corner[2]);
    return found->second;
  }

  std::map<Corner, SurfaceId> nodes_;
  TriangleSurface surface_;
};

double finite(double value, const FileCursor& in) {
  if (!std::isfinite(value)) in.fail("a coordinate that is no number", "finite corners");
  return value;
}

// The number of triangles, and nothing where the file is not as long as so many are: titles of binary files
// may begin as ASCII ones do.
std::optional<std::uint32_t> begin_binary(FileCursor& in) {
  if (in.remaining() < kTitle_bytes + sizeof(std::uint32_t)) return std::nullopt;
  in.skip(kTitle_bytes, "a title of 80 bytes");
  const auto count = in.binary<std::uint32_t>("the number of triangles", std::endian::little);
  if (in.remaining() != kTriangle_bytes * count) return std::nullopt;
  return count;
}

TriangleSurface read_binary(FileCursor& in, std::uint32_t count) {
  Weld weld;
  for (std::uint32_t t = 0; t < count; ++t) {
    in.skip(kNormal_bytes, "a triangle's normal");
    std::array<Corner, 3> corners;
    for (Corner& corner : corners)
      for (double& x : corner)
        x = finite(static_cast<double>(in.binary<float>("a triangle's corner", std::endian::little)), in);
    in.skip(kAttribute_bytes, "two bytes behind a triangle");
    weld.add(corners);
  }
  return weld.take();
}

TriangleSurface read_ascii(FileCursor in) {
  if (in.word("solid") != "solid") in.fail("no triangles", "an STL surface, of ASCII or as long as it says");
  in.rest_of_line();
  Weld weld;
  std::array<Corner, 3> corners;
  std::size_t corner = 0;
  while (!in.at_end()) {
    const std::string_view word = in.word("a facet");
    if (word == "endsolid" || word == "solid") {
      in.rest_of_line();
    } else if (word == "vertex") {
      if (corner == 3) in.fail("a fourth vertex", "endloop");
      for (double& x : corners[corner]) x = finite(in.real("a coordinate of a vertex"), in);
      ++corner;
    } else if (word == "endloop") {
      if (corner != 3) in.fail(std::to_string(corner) + " vertices", "three of each facet");
      weld.add(corners);
      corner = 0;
    }
  }
  return weld.take();
}

}  // namespace

bool is_stl(const std::filesystem::path& file) {
  return foreign_kind(file) == "an STL surface";
}

TriangleSurface read_stl(const std::filesystem::path& file) {
  FileCursor in(file);
  const std::optional<std::uint32_t> count = begin_binary(in);
  TriangleSurface surface = count ? read_binary(in, *count) : read_ascii(FileCursor(file));
  if (surface.triangles.empty()) throw InputError(in.name() + ": found no triangle, expected a surface");
  return surface;
}

}  // namespace omentum::geometry
