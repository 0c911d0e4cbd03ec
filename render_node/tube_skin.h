// The wall of a gut: a tube swept along its axis, for what the processor itself looks at. Pictures skin it
// (tube_frames.h).
#pragma once

#include "geometry/tube_axis.h"
#include "render_node/fold_shade.h"
#include "render_node/renderer.h"

namespace omentum::render {

/// From places of the axis' masses to lit vertices. `rest` of a vertex is where it would be on a straight
/// tube along x: along the gut's length at rest, and across, so that patterns stick to the wall. One thread.
class TubeSkin {
 public:
  /// Sections are this far from each other, of the radius, where the tube is straight, and closer in bends.
  static constexpr double kStep = 0.3;
  static constexpr int kAround = 20;  // vertices of a section: its outline shows no corners
  static constexpr int kCapRings = 4;

  /// `rest`: places of the axis' masses, at least three, in W, m.
  TubeSkin(std::span<const geometry::Vec3> rest, double radius_m);

  void deform(std::span<const geometry::Vec3> masses);
  /// `shares`: of the map's scale at each of those masses (tissue_map.h), from the next state on.
  void map(std::span<const float> shares);

  /// Closed, as many vertices and triangles as ever.
  const MeshData& mesh() const { return mesh_; }
  /// For fields that are not this class's.
  std::span<Vertex> vertices() { return mesh_.vertices; }
  const FoldShade& shade() const { return shade_; }
  /// Along its masses.
  double length_m() const { return length_m_; }
  double rest_length_m() const { return rest_at_.back(); }
  double radius_m() const { return radius_m_; }

 private:
  // A closed row of vertices: around a section, or of a cap before the first or behind the last one.
  struct Ring {
    std::size_t section;
    float outwards, forward;  // cosine and sine of the angle from the section's plane
  };
  void make_rings(std::size_t sections);
  void make_triangles();
  void find_bends();
  void write_ring(std::size_t ring);
  void write_poles();
  void shade_walls();
  void spread_shade();

  double radius_m_;
  geometry::TubeAxis axis_;
  geometry::AxisSampling sampling_;
  std::vector<double> rest_at_;  // [masses]: length along the gut at rest, m
  std::vector<float> shares_;    // [masses]
  double length_m_ = 0;
  std::vector<double> u_;                    // [sections]
  std::vector<geometry::TubeFrame> frames_;  // [sections]
  std::vector<Vec3f> bend_;                  // [sections]: towards the bend's centre, its curvature, 1/m
  std::vector<float> walls_;                 // [every kShadeStride-th section and the last][kShadeAround]
  std::vector<Ring> rings_;
  FoldShade shade_;
  MeshData mesh_;
};

}  // namespace omentum::render
