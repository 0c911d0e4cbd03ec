// A mesh in the graphics memory.
#pragma once

#include "render_node/renderer.h"

namespace omentum::render::gl {

/// Owns vertex array, vertices and indices. Movable, so that a vector can hold it.
class MeshBuffer {
 public:
  explicit MeshBuffer(const MeshData& mesh);
  MeshBuffer(MeshBuffer&& other) noexcept;
  MeshBuffer& operator=(MeshBuffer&&) = delete;
  ~MeshBuffer();

  void update(std::span<const Vertex> vertices);
  /// From the triangle `first` on, within those that there are; whole runs of a mesh that was split.
  void update(std::size_t first, std::span<const MeshTriangle> triangles);
  void replace(const MeshData& mesh);
  void draw() const;
  /// The corners of its runs alone (corner_triangles.h).
  void draw_corners() const;

 private:
  void fill(const MeshData& mesh);
  // In the bound array's indices.
  static void store(std::size_t first, std::span<const MeshTriangle> triangles);

  unsigned array_ = 0, vertices_ = 0, indices_ = 0;
  std::size_t triangle_count_ = 0, corner_count_ = 0;  // in indices_ one after the other
  int split_ = 1;
};

}  // namespace omentum::render::gl
