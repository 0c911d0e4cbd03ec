// One mesh in every format that is read, put together byte by byte from the formats' descriptions, by no code
// that the readers share.
#pragma once

#include "geometry/tetra_mesh.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdio>
#include <functional>
#include <ostream>
#include <string>
#include <vector>

namespace omentum::geometry {

// A file in the making.
class Bytes {
 public:
  template <class... Parts>
  Bytes& text(const Parts&... parts) {
    (add(parts), ...);
    return *this;
  }
  template <class T>
  Bytes& value(T value, std::endian order = std::endian::native) {
    std::array<char, sizeof(T)> bytes = std::bit_cast<std::array<char, sizeof(T)>>(value);
    if (order != std::endian::native) std::reverse(bytes.begin(), bytes.end());
    content.append(bytes.data(), bytes.size());
    return *this;
  }
  std::string content;

 private:
  void add(const std::string& part) { content += part; }
  void add(const char* part) { content += part; }
  void add(double part) {
    std::array<char, 40> digits;
    std::snprintf(digits.data(), digits.size(), " %.17g ", part);
    content += digits.data();
  }
  void add(std::size_t part) { content += " " + std::to_string(part) + " "; }
  void add(std::int32_t part) { content += " " + std::to_string(part) + " "; }
};

// Coordinates are sums of a few powers of two, so that single precision holds them too.
RawMesh example_mesh();
/// The same, whose first tetrahedra have the label 12 and the others 7.
RawMesh labelled_mesh();

struct Format {
  const char* name;
  const char* extension;
  std::function<std::string(const RawMesh&)> write;
};

inline void PrintTo(const Format& format, std::ostream* out) {
  *out << format.name;
}

// All that are read from one file.
const std::vector<Format>& formats();

}  // namespace omentum::geometry
