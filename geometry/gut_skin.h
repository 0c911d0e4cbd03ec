// The surface of an intestine and its mesentery, as instruments meet it.
#pragma once

#include "geometry/gut_shape.h"

#include <span>
#include <vector>

namespace omentum::geometry {

/// Rings around the gut's axis and both faces of the mesentery, of triangles about kSkinEdge_m wide around
/// the tube, and as wide as the masses lie apart on the mesentery. Nodes are numbered by layout and lengths
/// at the start alone: ring by ring along the gut, then the upper and the lower face, row by row; so every
/// process knows them.
///
/// A node's place is x = sum_k w_k x_k + offset: the weights are constant (a cardinal spline through the
/// axis, Raghupathi 2004, section 5; barycentric on the mesentery), the offset turns with the frame of its
/// ring or the normal of its face. Rings stand across the axis and are turned about it towards where the
/// mesentery hangs on, with a share of the ring before, which decides where the mesentery goes along the gut.
class GutSkin {
 public:
  static constexpr std::size_t kMostWeights = 4;
  static constexpr double kSkinEdge_m = 0.0125;

  /// Which masses carry a node; of what is not used the weight is 0.
  struct Node {
    std::array<MassId, kMostWeights> mass{};
    std::array<double, kMostWeights> weight{};
  };

  explicit GutSkin(const GutShape& shape);

  std::size_t node_count() const { return nodes_.size(); }
  const Node& node(NodeId n) const { return nodes_[static_cast<std::size_t>(n)]; }
  /// Counter-clockwise seen from outside. Those of the mesentery that have no area at the start are left out.
  std::span<const std::array<NodeId, 3>> triangles() const { return triangles_; }
  /// Whether nothing moves it: all that carries it is held.
  bool is_held(NodeId n) const;

  /// Where all nodes are: `x` [masses] in W, m; `places` [nodes]. Allocates nothing.
  void place(std::span<const Vec3> x, std::span<Vec3> places) const noexcept;

 private:
  struct Ring {
    std::int32_t segment = 0;  // of the axis
    double at = 0;             // along it, 0 to 1
    Node centre, along;        // of place and direction
  };

  void add_rings(const GutShape& shape);
  void add_ring(std::int32_t segment, double at);
  void add_tube_triangles();
  void add_sheet(const GutShape& shape);
  void add_face_triangles(const GutShape& shape, std::size_t first, bool is_upper);
  Vec3 towards_mesentery(std::span<const Vec3> x, const Ring& ring) const noexcept;
  Vec3 sheet_normal(std::span<const Vec3> x, std::int32_t row, std::int32_t column) const noexcept;
  void place_tube(std::span<const Vec3> x, std::span<Vec3> places) const noexcept;
  void place_sheet(std::span<const Vec3> x, std::span<Vec3> places) const noexcept;

  GutLayout layout_;
  double radius_m_, half_thickness_m_;
  std::size_t around_;        // nodes of a ring
  std::vector<Vec3> circle_;  // [around] of unit radius, in the ring's own plane; z is 0
  std::vector<Ring> rings_;
  std::vector<Node> nodes_;  // rings, then both faces
  std::vector<std::array<NodeId, 3>> triangles_;
};

/// sum_k w_k x_k.
Vec3 weighted(const GutSkin::Node& node, std::span<const Vec3> x) noexcept;

}  // namespace omentum::geometry
