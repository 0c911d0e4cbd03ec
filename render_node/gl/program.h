// A compiled pair of shaders.
#pragma once

#include "render_node/renderer.h"

#include <string>
#include <string_view>
#include <utility>

namespace omentum::render::gl {

/// Owns a GL program. Throws std::runtime_error with the compiler's log and the program's name.
class Program {
 public:
  /// Both sources begin without #version; `prefix` goes before the fragment shader.
  Program(const std::string& name, std::string_view vertex, std::string_view prefix,
          std::string_view fragment, std::string_view vertex_prefix = "");
  Program(Program&& other) noexcept : id_(std::exchange(other.id_, 0)) {}
  Program& operator=(Program&&) = delete;
  ~Program();
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  void use() const;
  /// Of the program in use. A name that the compiler optimized away is ignored.
  void set(const char* uniform, const Mat4f& value) const;
  void set(const char* uniform, const Vec3f& value) const;
  void set(const char* uniform, float x, float y) const;
  void set(const char* uniform, float value) const;
  void set(const char* uniform, int texture_unit) const;

 private:
  unsigned id_ = 0;
};

}  // namespace omentum::render::gl
