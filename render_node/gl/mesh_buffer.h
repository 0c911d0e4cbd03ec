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
  void draw() const;

 private:
  unsigned array_ = 0, vertices_ = 0, indices_ = 0;
  int index_count_ = 0;
};

}  // namespace omentum::render::gl
