// The drawn surface of a deforming organ.
#pragma once

#include "render_node/bared_skin.h"
#include "render_node/bleeding.h"
#include "render_node/organ_cut.h"
#include "render_node/pallor.h"
#include "render_node/shading_net.h"

namespace omentum::render {

/// Of a mesh's triangles, `count` from `first` on.
struct TriangleRun {
  std::size_t first = 0, count = 0;
};

/// From displacements of the surface's nodes to lit vertices. Nodes are numbered as in the organ's states.
class OrganSkin {
 public:
  /// `rest`: [S], m, in the surface's order. `lining`: more triangles of its nodes, which are drawn behind
  /// the others and take no part in their normals: where two skins meet that share no nodes, what shines
  /// through between them is tissue.
  OrganSkin(const geometry::Surface& surface, std::span<const geometry::Vec3> rest,
            std::span<const geometry::Triangle> lining = {});

  /// From here on the organ is cut like this (or whole again); its next state is to be shown before it is
  /// drawn. The skin that is left stays as it was: its triangles keep their places in mesh(), those that are
  /// gone become points.
  void cut(const CutShape& shape);
  /// Which triangles of mesh() the last cut() changed.
  const std::vector<TriangleRun>& changed() const { return changed_; }

  /// `displacements`: x, y, z of each node, m.
  void deform(std::span<const float> displacements);

  /// `shares`: of the map's scale at each node (tissue_map.h), which the vertices have from now on.
  void map(std::span<const float> shares);

  /// `dt_s` go by: under these presses, on the skin and where it lies bare, tissue pales (pallor.h), and
  /// blood runs. Whether it changed.
  bool live(std::span<const Press> on_skin, std::span<const Press> on_bared, double dt_s);

  const MeshData& mesh() const { return mesh_; }
  /// What lies bare; without triangles where nothing does.
  const MeshData& bared() const { return bared_.mesh(); }
  const Bleeding& bleeding() const { return bleeding_; }
  std::int32_t node_count() const { return static_cast<std::int32_t>(rest_.size()); }
  /// Whether a triangle is left at that node.
  bool has(geometry::SurfaceId node) const { return used_[static_cast<std::size_t>(node)] != 0; }
  Vec3f position(geometry::SurfaceId node) const { return positions_[node]; }
  Vec3f rest(geometry::SurfaceId node) const { return rest_[node]; }
  /// Whether none but what lies bare is left at that node.
  bool bare(geometry::SurfaceId node) const { return used_[static_cast<std::size_t>(node)] == kBare; }
  Vec3f normal(geometry::SurfaceId node) const { return bare(node) ? closed_normals_[node] : normals_[node]; }
  Vec3f rest_normal(geometry::SurfaceId node) const { return rest_normals_[node]; }
  /// The largest displacement of any node that is left, m: what linear elasticity must be small against
  /// (dents: dent.h).
  double largest_displacement_m() const { return largest_displacement_m_; }
  /// The longest side of the box around the rest surface, m: "mesh size" in the limit of linearity.
  double extent_m() const { return extent_m_; }

 private:
  void take_away(const std::vector<std::uint8_t>& gone);
  void set_nodes(const CutShape& shape);

  std::size_t skin_count_;                     // of triangles_ that are the skin; the others line it
  std::vector<geometry::Triangle> triangles_;  // of the whole organ
  std::vector<geometry::Triangle> left_;       // of the skin
  std::vector<geometry::Triangle> closed_;     // and what lies bare
  std::vector<std::uint8_t> gone_;             // 1: of triangles_, not left
  static constexpr std::uint8_t kSkin = 1, kBare = 2;
  std::vector<std::uint8_t> used_;  // kSkin: a node of left_; kBare: only of what lies bare; 0: of neither
  // of the nodes: normals_ of the skin alone, closed_normals_ of all that there is
  std::vector<Vec3f> rest_, rest_normals_, positions_, normals_, closed_normals_;
  std::vector<Vec3f> drawn_;  // positions_, without the teeth of a cut
  std::vector<float> openness_;
  int level_;
  ShadingNet net_, closed_net_;  // of left_ and of closed_
  SurfaceRefinement refinement_;
  BaredSkin bared_;
  MeshData mesh_;
  std::vector<TriangleRun> changed_;
  Pallor pallor_, bared_pallor_;
  Bleeding bleeding_;
  double largest_displacement_m_ = 0;
  double extent_m_ = 0;
};

}  // namespace omentum::render
