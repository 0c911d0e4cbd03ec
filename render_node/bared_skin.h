// The drawn inside of an organ, where it lies bare.
#pragma once

#include "render_node/surface_refinement.h"

namespace omentum::render {

/// Refined like the skin around it, but smooth only within itself: along its rim the light breaks, and its
/// edges there lie on those of the skin. One thread.
class BaredSkin {
 public:
  BaredSkin() = default;  // nothing lies bare
  /// `bared`: outward, numbered as `rest` is, [S'].
  BaredSkin(std::vector<geometry::Triangle> bared, std::span<const Vec3f> rest, int level);

  /// Takes the teeth off what is drawn: a cut runs between tetrahedra, tissue parts along a line. Every node
  /// goes towards its neighbours, kRelaxations times half of the way, those of the rim along it; but no
  /// farther than kMostMoved of their mean distance, so that small pieces stay what they are. `positions`:
  /// [S'].
  static constexpr int kRelaxations = 3;
  static constexpr float kMostMoved = 0.35f;
  void relax(std::span<Vec3f> positions);

  /// `positions`, `openness` and the skin's `normals` around it, which its rim follows: [S'].
  void deform(std::span<const Vec3f> positions, std::span<const Vec3f> normals,
              std::span<const float> openness);

  /// One value of each node, [S'], to a field of the vertices.
  void spread(std::span<const float> of_nodes, float Vertex::*field);

  const std::vector<geometry::Triangle>& triangles() const { return triangles_; }
  const MeshData& mesh() const { return mesh_; }
  /// For fields that are not this class's.
  std::span<Vertex> vertices() { return mesh_.vertices; }

 private:
  void find_rim();
  void find_reach();
  void number_nodes(std::size_t node_count);

  std::vector<geometry::Triangle> triangles_;        // by the organ's nodes
  std::vector<geometry::SurfaceId> node_;            // [B], the organ's node of each of these
  std::vector<geometry::Triangle> own_;              // the triangles by these
  std::vector<Vec3f> positions_, normals_, around_;  // [B]: places, own normals and the skin's
  std::vector<float> reach_;                         // [B], m: how far relax() may move each
  std::vector<float> openness_;                      // [B]
  SurfaceRefinement refinement_{{}, 0, 1};
  std::vector<std::size_t> rim_;                    // refined vertices on edges that the skin shares
  std::vector<std::array<std::int32_t, 2>> pulls_;  // the second of each of these nodes draws the first to it
  std::vector<float> pull_count_;                   // [B], of each as the first
  MeshData mesh_;
};

}  // namespace omentum::render
