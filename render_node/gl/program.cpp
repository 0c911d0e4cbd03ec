#include "render_node/gl/program.h"

#include <epoxy/gl.h>

#include <array>
#include <stdexcept>

namespace omentum::render::gl {
namespace {

constexpr const char* kVersion = "#version 330 core\n";

unsigned compile(GLenum kind, const std::string& name, std::string_view prefix, std::string_view source) {
  const unsigned shader = glCreateShader(kind);
  const std::array<const char*, 3> text{kVersion, prefix.data(), source.data()};
  const std::array<GLint, 3> length{-1, static_cast<GLint>(prefix.size()), static_cast<GLint>(source.size())};
  glShaderSource(shader, 3, text.data(), length.data());
  glCompileShader(shader);
  GLint good = 0;
  glGetShaderiv(shader, GL_COMPILE_STATUS, &good);
  if (!good) {
    std::array<char, 2048> log{};
    glGetShaderInfoLog(shader, log.size(), nullptr, log.data());
    glDeleteShader(shader);
    throw std::runtime_error("shader " + name + ": " + log.data());
  }
  return shader;
}

}  // namespace

Program::Program(const std::string& name, std::string_view vertex, std::string_view prefix,
                 std::string_view fragment, std::string_view vertex_prefix) {
  const unsigned v = compile(GL_VERTEX_SHADER, name, vertex_prefix, vertex);
  const unsigned f = compile(GL_FRAGMENT_SHADER, name, prefix, fragment);
  id_ = glCreateProgram();
  glAttachShader(id_, v);
  glAttachShader(id_, f);
  glLinkProgram(id_);
  glDeleteShader(v);
  glDeleteShader(f);
  GLint good = 0;
  glGetProgramiv(id_, GL_LINK_STATUS, &good);
  if (!good) {
    std::array<char, 2048> log{};
    glGetProgramInfoLog(id_, log.size(), nullptr, log.data());
    glDeleteProgram(id_);
    throw std::runtime_error("shader " + name + ": " + log.data());
  }
}

Program::~Program() {
  glDeleteProgram(id_);
}

void Program::use() const {
  glUseProgram(id_);
}
void Program::set(const char* uniform, const Mat4f& value) const {
  glUniformMatrix4fv(glGetUniformLocation(id_, uniform), 1, GL_FALSE, value.data());
}
void Program::set(const char* uniform, const Vec3f& value) const {
  glUniform3fv(glGetUniformLocation(id_, uniform), 1, value.data());
}
void Program::set(const char* uniform, float x, float y) const {
  glUniform2f(glGetUniformLocation(id_, uniform), x, y);
}
void Program::set(const char* uniform, float value) const {
  glUniform1f(glGetUniformLocation(id_, uniform), value);
}
void Program::set(const char* uniform, int texture_unit) const {
  glUniform1i(glGetUniformLocation(id_, uniform), texture_unit);
}

}  // namespace omentum::render::gl
