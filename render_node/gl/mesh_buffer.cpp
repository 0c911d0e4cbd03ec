#include "render_node/gl/mesh_buffer.h"

#include "geometry/precondition.h"

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
      triangle_count_(other.triangle_count_) {}

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
  glBufferSubData(GL_ELEMENT_ARRAY_BUFFER, static_cast<GLintptr>(first * sizeof(MeshTriangle)),
                  static_cast<GLsizeiptr>(triangles.size_bytes()), triangles.data());
}

void MeshBuffer::replace(const MeshData& mesh) {
  glBindVertexArray(array_);
  fill(mesh);
}

// The array is bound.
void MeshBuffer::fill(const MeshData& mesh) {
  triangle_count_ = mesh.triangles.size();
  glBufferData(GL_ELEMENT_ARRAY_BUFFER, static_cast<GLsizeiptr>(triangle_count_ * sizeof(MeshTriangle)),
               mesh.triangles.data(), GL_DYNAMIC_DRAW);
  update(mesh.vertices);
}

void MeshBuffer::draw() const {
  glBindVertexArray(array_);
  glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(3 * triangle_count_), GL_UNSIGNED_INT, nullptr);
}

}  // namespace omentum::render::gl
