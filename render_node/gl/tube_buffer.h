// Tubes in the graphics memory: cylinders, and the frames that they are skinned on.
#pragma once

#include "render_node/tube_cylinder.h"

namespace omentum::render::gl {

/// Of one n, with so many vertices around. Owns vertices and indices.
class CylinderBuffer {
 public:
  CylinderBuffer(int n, int around);
  ~CylinderBuffer();
  CylinderBuffer(const CylinderBuffer&) = delete;
  CylinderBuffer& operator=(const CylinderBuffer&) = delete;

 private:
  friend class TubeBuffer;
  unsigned vertices_ = 0, indices_ = 0;
  std::size_t wall_triangles_ = 0, cap_triangles_ = 0;
};

/// Owns a tube's frames, as instances of a cylinder. Movable, so that a vector can hold it.
class TubeBuffer {
 public:
  TubeBuffer();
  TubeBuffer(TubeBuffer&& other) noexcept;
  TubeBuffer& operator=(TubeBuffer&&) = delete;
  ~TubeBuffer();

  void update(std::span<const SkinFrame> frames);
  /// Nothing of fewer than two frames.
  void draw(const CylinderBuffer& cylinder) const;

 private:
  void take_frames(std::size_t first) const;

  unsigned array_ = 0, frames_ = 0;
  std::size_t count_ = 0;
};

}  // namespace omentum::render::gl
