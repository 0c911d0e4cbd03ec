// What a mesh file calls its nodes and elements, and what programs may call them instead.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace omentum::geometry {

enum class Numbering {
  kFile,     // the mesh file's own numbers: Gmsh's tags, TetGen's indices, VTK's cells and points from 0
  kPosition  // places in the mesh file's list, from 0
};

/// Numbers of a file's nodes or elements, both ways. Copies nothing while they count up by one.
class FileNumbers {
 public:
  /// `own`: the file's own numbers, [count], or empty where it counts from 0; it must outlive this.
  FileNumbers(std::span<const std::int64_t> own, std::size_t count, Numbering numbering);

  /// Precondition: position < count.
  std::int64_t of(std::size_t position) const {
    return counted_ ? first_ + static_cast<std::int64_t>(position) : own_[position];
  }

  /// Which position a number means; nothing where the file does not have it. Of a number that the file has
  /// several times, the first. O(log count).
  std::optional<std::int32_t> position_of(std::int64_t number) const;

  /// "from 1 to 80", or "507 from 1 to 533" where there are gaps. Precondition:
  /// count > 0.
  std::string range() const;

 private:
  std::span<const std::int64_t> own_;
  std::size_t count_;
  bool counted_ = true;  // number = first_ + position
  std::int64_t first_ = 0;
  std::vector<std::int32_t> sorted_;  // positions by number, where not counted
};

}  // namespace omentum::geometry
