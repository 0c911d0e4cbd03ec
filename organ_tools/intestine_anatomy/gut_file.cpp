#include "organ_tools/intestine_anatomy/gut_file.h"

#include "files/whole_file.h"

#include <cstdio>
#include <string>

namespace omentum::gut_picture {
namespace {

template <class... Values>
void add(std::string& text, const char* format, Values... values) {
  char line[120];
  std::snprintf(line, sizeof line, format, values...);
  text += line;
}

// Each list begins with how many numbers follow.
void add_cells(std::string& text, const geometry::GutLayout& layout) {
  add(text, "LINES 1 %d\n%d", layout.columns + 1, layout.columns);
  for (std::int32_t c = 0; c < layout.columns; ++c) add(text, " %d", c);
  add(text, "\nPOLYGONS %d %d\n", layout.triangle_count(), 4 * layout.triangle_count());
  for (std::int32_t t = 0; t < layout.triangle_count(); ++t) {
    const auto [a, b, c] = layout.triangle(t);
    add(text, "3 %d %d %d\n", std::int32_t{a}, std::int32_t{b}, std::int32_t{c});
  }
}

}  // namespace

void write_gut(const std::filesystem::path& file, const geometry::GutShape& gut) {
  std::string text = "# vtk DataFile Version 3.0\nintestine and mesentery, m\nASCII\nDATASET POLYDATA\n";
  add(text, "POINTS %d double\n", gut.layout.mass_count());
  for (const geometry::Vec3& p : gut.positions) add(text, "%.17g %.17g %.17g\n", p.x(), p.y(), p.z());
  add_cells(text, gut.layout);
  add(text, "POINT_DATA %d\nSCALARS radius_m double 1\nLOOKUP_TABLE default\n", gut.layout.mass_count());
  for (std::int32_t m = 0; m < gut.layout.mass_count(); ++m)
    add(text, "%.17g\n", m < gut.layout.columns ? gut.tube_radius_m : gut.mesentery_thickness_m / 2);
  files::write_whole(file, text);
}

}  // namespace omentum::gut_picture
