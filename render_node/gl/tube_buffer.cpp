#include "render_node/gl/tube_buffer.h"

#include <epoxy/gl.h>

#include <cstddef>
#include <utility>

namespace omentum::render::gl {
namespace {

// Locations of shaders/tube.glsl: of the cylinder, then the vectors of a frame, then those of the next one.
constexpr unsigned kCorner = 0, kCap = 1, kFirstFrame = 2;
constexpr unsigned kVectors = sizeof(SkinFrame) / (4 * sizeof(float));

void attribute(unsigned location, int components, std::size_t stride, std::size_t offset) {
  glEnableVertexAttribArray(location);
  glVertexAttribPointer(location, components, GL_FLOAT, GL_FALSE, static_cast<GLsizei>(stride),
                        reinterpret_cast<void*>(offset));  // NOLINT(performance-no-int-to-ptr): OpenGL's way
}

void draw_triangles(std::size_t first, std::size_t count, std::size_t instances) {
  // NOLINTNEXTLINE(performance-no-int-to-ptr): OpenGL's way
  const auto* const offset = reinterpret_cast<void*>(first * sizeof(MeshTriangle));
  glDrawElementsInstanced(GL_TRIANGLES, static_cast<GLsizei>(3 * count), GL_UNSIGNED_INT, offset,
                          static_cast<GLsizei>(instances));
}

}  // namespace

CylinderBuffer::CylinderBuffer(int n, int around) {
  const TubeCylinder cylinder = make_tube_cylinder(n, around);
  wall_triangles_ = cylinder.wall_triangles;
  cap_triangles_ = cylinder.cap_triangles;
  glGenBuffers(1, &vertices_);
  glGenBuffers(1, &indices_);
  glBindVertexArray(0);  // or its indices would become these
  glBindBuffer(GL_ARRAY_BUFFER, vertices_);
  glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(cylinder.vertices.size() * sizeof(CylinderVertex)),
               cylinder.vertices.data(), GL_STATIC_DRAW);
  glBindBuffer(GL_ARRAY_BUFFER, indices_);  // any target will do to fill it
  glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(cylinder.triangles.size() * sizeof(MeshTriangle)),
               cylinder.triangles.data(), GL_STATIC_DRAW);
}

CylinderBuffer::~CylinderBuffer() {
  glDeleteBuffers(1, &vertices_);
  glDeleteBuffers(1, &indices_);
}

TubeBuffer::TubeBuffer() {
  glGenVertexArrays(1, &array_);
  glGenBuffers(1, &frames_);
}

TubeBuffer::TubeBuffer(TubeBuffer&& other) noexcept
    : array_(std::exchange(other.array_, 0)),
      frames_(std::exchange(other.frames_, 0)),
      count_(other.count_) {}

TubeBuffer::~TubeBuffer() {
  glDeleteVertexArrays(1, &array_);
  glDeleteBuffers(1, &frames_);
}

void TubeBuffer::update(std::span<const SkinFrame> frames) {
  count_ = frames.size();
  glBindBuffer(GL_ARRAY_BUFFER, frames_);
  glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(frames.size_bytes()), frames.data(), GL_STREAM_DRAW);
}

// Instances begin with that frame (OpenGL 3.3 has no other way to say so).
void TubeBuffer::take_frames(std::size_t first) const {
  glBindBuffer(GL_ARRAY_BUFFER, frames_);
  for (unsigned v = 0; v < 2 * kVectors; ++v) {
    attribute(kFirstFrame + v, 4, sizeof(SkinFrame), first * sizeof(SkinFrame) + v * 4 * sizeof(float));
    glVertexAttribDivisor(kFirstFrame + v, 1);
  }
}

void TubeBuffer::draw(const CylinderBuffer& cylinder) const {
  if (count_ < 2) return;
  glBindVertexArray(array_);
  glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, cylinder.indices_);
  glBindBuffer(GL_ARRAY_BUFFER, cylinder.vertices_);
  attribute(kCorner, 4, sizeof(CylinderVertex), 0);
  attribute(kCap, 2, sizeof(CylinderVertex), offsetof(CylinderVertex, outwards));
  const std::size_t pieces = count_ - 1, caps = cylinder.cap_triangles_;
  take_frames(0);
  draw_triangles(0, cylinder.wall_triangles_, pieces);
  draw_triangles(cylinder.wall_triangles_, caps, 1);
  take_frames(pieces - 1);
  draw_triangles(cylinder.wall_triangles_ + caps, caps, 1);
}

}  // namespace omentum::render::gl
