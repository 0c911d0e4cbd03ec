// Boundary faces that other tissue lies on, which shares no nodes with them.
#pragma once

#include "geometry/surface.h"

#include <cstdint>
#include <span>
#include <vector>

namespace omentum::geometry {

/// The face opposite to a corner of a tetrahedron is none of the surface until one of `by` goes; without any
/// it never is.
struct CoveredFace {
  TetId behind;
  int corner;
  std::vector<TetId> by{};
};

/// Which of them are hidden, tetrahedron by tetrahedron that goes or comes back. Takes its memory when it is
/// made. One thread.
class CoveredFaces {
 public:
  /// `tetrahedron_count`: of the mesh that all of them are of; faces differ.
  CoveredFaces(std::span<const CoveredFace> faces, std::size_t tetrahedron_count);

  std::span<const CoveredFace> faces() const noexcept { return faces_; }
  /// Places in faces() of what this tetrahedron covers.
  std::span<const std::int32_t> covered_by(TetId t) const noexcept;
  /// Place in faces(); -1: that face is none of them.
  std::int32_t place_of(TetId behind, int corner) const noexcept;
  bool is_hidden(std::int32_t face) const noexcept { return missing_[static_cast<std::size_t>(face)] == 0; }

  /// One that covers it goes, or comes back. True: it was hidden until then, or is from then on.
  bool uncover(std::int32_t face) noexcept { return missing_[static_cast<std::size_t>(face)]++ == 0; }
  bool cover(std::int32_t face) noexcept { return --missing_[static_cast<std::size_t>(face)] == 0; }

 private:
  std::vector<CoveredFace> faces_;     // by tetrahedron and corner
  std::vector<std::int32_t> missing_;  // [faces] of `by`
  std::vector<std::int32_t> start_;    // [T+1] into covered_; empty without faces
  std::vector<std::int32_t> covered_;
};

/// A surface without these faces of its mesh: its nodes stay, in their order, also where none of their
/// triangles does.
Surface without_covered(const TetraMesh& mesh, const Surface& surface, std::span<const CoveredFace> faces);

}  // namespace omentum::geometry
