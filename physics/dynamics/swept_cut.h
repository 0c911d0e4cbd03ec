// Which tetrahedra of a deformed mesh a cutting edge meets on its way.
#pragma once

#include "geometry/tetra_mesh.h"

#include <limits>
#include <span>
#include <vector>

namespace omentum::physics {

/// What an edge swept between two moments: the triangles (from[0], from[1], to[1]) and (from[0], to[1],
/// to[0]), in W, m. Where each begins as the last one ended, they join without a gap.
struct SweptEdge {
  std::array<geometry::Vec3, 2> from, to;
};

/// Whether a closed triangle and a closed tetrahedron have a point in common, by separating planes: those of
/// the faces of both, and those along an edge of each. A triangle that is a segment or a point is none the
/// worse; nor does it matter how the tetrahedron is oriented. What touches within rounding counts as met.
bool meets(const std::array<geometry::Vec3, 3>& triangle, const std::array<geometry::Vec3, 4>& tetrahedron);

/// Finds the tetrahedra that swept edges meet, in their deformed places. A tree of boxes over the tetrahedra
/// is made once, by the places at rest, and its boxes follow the deformation: a cut leaves neighbours
/// neighbours, so that the tree stays good however the organ is bent. No allocation after construction; one
/// thread at a time.
class SweptCut {
 public:
  /// `mesh` must outlive this. All tetrahedra are at rest.
  explicit SweptCut(const geometry::TetraMesh& mesh);

  /// `displacements`: [3N], finite, from rest, in W, m. O(T).
  void follow(std::span<const double> displacements) noexcept;
  /// The tetrahedra that `edge` meets, ascending, each once; valid until the next call.
  std::span<const geometry::TetId> find(const SweptEdge& edge) noexcept;

 private:
  /// Of nothing, until it holds something.
  struct Box {
    Eigen::Array3d low = Eigen::Array3d::Constant(std::numeric_limits<double>::infinity());
    Eigen::Array3d high = Eigen::Array3d::Constant(-std::numeric_limits<double>::infinity());
    void hold(const geometry::Vec3& point);
    void hold(const Box& other);
    bool apart_from(const Box& other) const;
  };
  /// Of the tree, in depth-first order: the first child follows its parent.
  struct Branch {
    Box box;
    std::int32_t first, last;  // of order_
    std::int32_t second;       // the other child; 0: a leaf
  };

  void grow(std::int32_t first, std::int32_t last, std::span<const geometry::Vec3> centres);
  std::array<geometry::Vec3, 4> corners(geometry::TetId t) const;
  void collect(std::size_t leaf, const SweptEdge& edge, const Box& swept) noexcept;

  const geometry::TetraMesh& mesh_;
  std::vector<geometry::Vec3> places_;  // [N], in W, m
  std::vector<geometry::TetId> order_;  // [T], neighbours next to each other
  std::vector<Branch> branches_;
  std::vector<geometry::TetId> found_;
};

}  // namespace omentum::physics
