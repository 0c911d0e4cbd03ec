// The programs of one way to compute light, by what they draw.
#pragma once

#include "render_node/gl/program.h"
#include "render_node/picture_quality.h"

#include <array>
#include <optional>

namespace omentum::render::gl {

/// How many looks there are.
inline constexpr std::size_t kLookCount = static_cast<std::size_t>(Look::kSignal) + 1;

/// Of a surface that vertex shader `vertex` places. `defines`: what it is, to `fragment`; `is`: to the light
/// at a vertex (shaders/vertex_light.glsl). Throws as Program does.
Program surface_program(Shading shading, const char* name, std::string_view vertex,
                        const std::string& defines, std::string_view fragment, const std::string& is);

/// Owns them. Each is compiled when it is first asked for, since a compiler's time is a person's who waits
/// for the first picture, or for the first one of another quality. Throws as Program does.
class Programs {
 public:
  explicit Programs(Shading shading) : shading_(shading) {}

  const Program& of(Look look);
  const Program& backdrop();
  const Program& lens();

 private:
  Shading shading_;
  std::array<std::optional<Program>, kLookCount> of_;
  std::optional<Program> backdrop_, lens_;
};

}  // namespace omentum::render::gl
