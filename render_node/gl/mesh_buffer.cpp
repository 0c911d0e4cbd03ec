#include "render_node/gl/mesh_buffer.h"

#include "geometry/precondition.h"
#include "render_node/corner_triangles.h"

#include <epoxy/gl.h>

#include <cstddef>
#include <utility>

namespace omentum::render::gl {
namespace {

void attribute(unsigned location, int components, std::size_t offset) {
  glEnableVertexAttribArray(location);
  glVertexAttribPointer(location, components, GL_FLOAT, GL_FALSE, sizeof(Vertex),
                        reinterpret_cast<void*>(offset));  // NOLINT(performance-no-int-to-ptr): OpenGL's way
}

}  // namespace

MeshBuffer::MeshBuffer(const MeshData& mesh) {
  glGenVertexArrays(1, &array_);
  glGenBuffers(1, &vertices_);
  glGenBuffers(1, &indices_);
  glBindVertexArray(array_);
  glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices_);
  fill(mesh);
  attribute(0, 3, offsetof(Vertex, position));
  attribute(1, 3, offsetof(Vertex, normal));
  attribute(2, 3, offsetof(Vertex, rest));
  attribute(3, 1, offsetof(Vertex, openness));
  attribute(4, 1, offsetof(Vertex, charring));
  attribute(5, 1, offsetof(Vertex, share));
  attribute(6, 1, offsetof(Vertex, pallor));
  glBindVertexArray(0);
}

MeshBuffer::MeshBuffer(MeshBuffer&& other) noexcept
    : array_(std::exchange(other.array_, 0)),
      vertices_(std::exchange(other.vertices_, 0)),
      indices_(std::exchange(other.indices_, 0)),
      triangle_count_(other.triangle_count_),
      corner_count_(other.corner_count_),
      split_(other.split_) {}

MeshBuffer::~MeshBuffer() {
  glDeleteVertexArrays(1, &array_);
  glDeleteBuffers(1, &vertices_);
  glDeleteBuffers(1, &indices_);
}

void MeshBuffer::update(std::span<const Vertex> vertices) {
  glBindBuffer(GL_ARRAY_BUFFER, vertices_);
  glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(vertices.size_bytes()), vertices.data(),
               GL_STREAM_DRAW);
}

void MeshBuffer::update(std::size_t first, std::span<const MeshTriangle> triangles) {
  geometry::require(first + triangles.size() <= triangle_count_, "triangles that the mesh has");
  glBindVertexArray(array_);
  store(first, triangles);
  if (split_ == 1) return;
  const auto run = static_cast<std::size_t>(split_ * split_);
  geometry::require(first % run == 0, "whole runs of triangles");
  store(triangle_count_ + first / run, corner_triangles(triangles, split_));
}

void MeshBuffer::replace(const MeshData& mesh) {
  glBindVertexArray(array_);
  fill(mesh);
}

// The array is bound.
void MeshBuffer::fill(const MeshData& mesh) {
  split_ = mesh.split;
  std::vector<MeshTriangle> corners = mesh.few;
  if (split_ > 1) corners = corner_triangles(mesh.triangles, split_);
  triangle_count_ = mesh.triangles.size();
  corner_count_ = corners.size();
  glBufferData(GL_ELEMENT_ARRAY_BUFFER,
               static_cast<GLsizeiptr>((triangle_count_ + corner_count_) * sizeof(MeshTriangle)), nullptr,
               GL_DYNAMIC_DRAW);
  store(0, mesh.triangles);
  store(triangle_count_, corners);
  update(mesh.vertices);
}

void MeshBuffer::store(std::size_t first, std::span<const MeshTriangle> triangles) {
  glBufferSubData(GL_ELEMENT_ARRAY_BUFFER, static_cast<GLintptr>(first * sizeof(MeshTriangle)),
                  static_cast<GLsizeiptr>(triangles.size_bytes()), triangles.data());
}

void MeshBuffer::draw() const {
  glBindVertexArray(array_);
  glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(3 * triangle_count_), GL_UNSIGNED_INT, nullptr);
}

void MeshBuffer::draw_corners() const {
  if (corner_count_ == 0) return draw();
  const std::size_t offset = triangle_count_ * sizeof(MeshTriangle);
  glBindVertexArray(array_);
  glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(3 * corner_count_), GL_UNSIGNED_INT,
                 reinterpret_cast<void*>(offset));  // NOLINT(performance-no-int-to-ptr): OpenGL's way
}

}  // namespace omentum::render::gl
