// The drawn mesentery: a thin sheet through a grid of masses.
#pragma once

#include "geometry/gut_shape.h"
#include "render_node/fold_shade.h"
#include "render_node/renderer.h"

namespace omentum::render {

/// From places of a gut's masses to the lit vertices of both faces: cardinal splines along the gut and across
/// it, so that the sheet begins on the tube's axis. `rest` of a vertex is where it would be unfolded: along
/// the gut, away from it, and to which side. One thread.
class SheetSkin {
 public:
  /// Of the thickness that collides: the tissue is thinner than what keeps it apart.
  static constexpr double kDrawnThickness = 0.35;
  static constexpr std::int32_t kAcross = 4;  // steps from row to row

  explicit SheetSkin(const geometry::GutShape& rest);

  /// `masses`: all of the gut, row by row; `loops`: of its tube.
  void deform(std::span<const geometry::Vec3> masses, FoldShade loops);
  /// `shares`: of the map's scale at each mass (tissue_map.h), from the next state on.
  void map(std::span<const float> shares);

  /// Closed, as many vertices and triangles as ever.
  const MeshData& mesh() const { return mesh_; }
  /// For fields that are not this class's.
  std::span<Vertex> vertices() { return mesh_.vertices; }

 private:
  // A value between rows or columns of masses: spline weights of four of them, ghosts included.
  struct Place {
    std::int32_t before;  // the mass before it
    float share;          // of the way to the next one
    Eigen::Vector4f weight;
  };
  static std::vector<Place> places(std::int32_t masses, std::int32_t steps);
  static Vec3f blend(const Place& place, std::span<const Vec3f> ghosted);
  std::size_t at(std::size_t row, std::size_t column) const { return row * columns_.size() + column; }
  // Of columns_, from mass to mass.
  std::size_t steps_along() const {
    return (columns_.size() - 1) / static_cast<std::size_t>(layout_.columns - 1);
  }
  void lay_out_rest(std::span<const geometry::Vec3> rest);
  void make_triangles();
  void make_rim();
  void make_few_triangles();
  void place_middle(std::span<const geometry::Vec3> masses);
  void find_normals();
  void take_normals_of_neighbours();
  void shade(FoldShade& loops);
  float between_masses(std::span<const float> of_masses, std::size_t row, std::size_t column) const;
  void write_faces();

  geometry::GutLayout layout_;
  std::vector<Place> rows_, columns_;
  float half_m_;
  std::vector<Vec3f> along_;                    // [rows of masses + 2 ghosts][columns_]
  std::vector<Vec3f> middle_, normals_;         // [rows_][columns_]
  std::array<std::vector<float>, 2> openness_;  // [masses], of the front and of the back
  std::vector<float> shares_;                   // [masses]
  MeshData mesh_;                               // the front's vertices, then the back's
};

}  // namespace omentum::render
