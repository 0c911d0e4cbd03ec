#include "render_node/gl/programs.h"

#include "shader_sources.h"  // generated from gl/shaders/

namespace omentum::render::gl {
namespace {

// What all fragment shaders share.
std::string prefix_of(Shading shading) {
  const char* define = shading == Shading::kSoftShadows   ? "#define SOFT_SHADOWS\n"
                       : shading == Shading::kHardShadows ? ""
                                                          : "#define NO_SHADOWS\n";
  return define + std::string(shaders::common_glsl);
}

// How a look is drawn: its name, what it is to its fragment shader, that shader, and what it is to the light
// at a vertex.
struct LookShader {
  const char *name, *defines;
  std::string_view fragment;
  const char* is;
};
LookShader shader_of(Look look) {
  switch (look) {
    case Look::kTissue:
      return {"tissue", "", shaders::tissue_frag, "TISSUE"};
    case Look::kCut:
      return {"cut tissue", "#define CUT\n", shaders::tissue_frag, "TISSUE"};
    case Look::kBared:
      return {"bared tissue", "#define CUT\n#define BARED\n", shaders::tissue_frag, "TISSUE"};
    case Look::kMap:
      return {"map", "", shaders::map_frag, "MAP"};
    case Look::kGut:
      return {"gut", "#define GUT\n", shaders::tissue_frag, "TISSUE"};
    case Look::kBlood:
      return {"blood", "", shaders::blood_frag, "SOLID"};
    case Look::kMesentery:
      return {"mesentery", "#define SHEET\n", shaders::tissue_frag, "TISSUE"};
    case Look::kWall:
      return {"wall", "#define WALL\n", shaders::tissue_frag, "TISSUE"};
    case Look::kGround:
      return {"ground", "", shaders::ground_frag, "GROUND"};
    case Look::kSignal:
      return {"signal", "", shaders::signal_frag, "SIGNAL"};
    case Look::kSmoke:  // whose light is never a vertex'
    case Look::kSolid:
      break;
  }
  return {"solid", "", shaders::solid_frag, "SOLID"};
}

}  // namespace

Program surface_program(Shading shading, const char* name, std::string_view vertex,
                        const std::string& defines, std::string_view fragment, const std::string& is) {
  const std::string of_look = defines + std::string(shaders::mesentery_glsl);
  if (shading != Shading::kPerVertex) return {name, vertex, prefix_of(shading) + of_look, fragment};
  return {name, vertex, of_look, shaders::vertex_lit_frag,
          "#define PER_VERTEX\n#define " + is + "\n" + of_look + std::string(shaders::common_glsl) +
              std::string(shaders::vertex_light_glsl)};
}

const Program& Programs::of(Look look) {
  std::optional<Program>& program = of_[static_cast<std::size_t>(look)];
  if (program) return *program;
  if (look == Look::kSmoke)
    return program.emplace("smoke", shaders::surface_vert, prefix_of(shading_), shaders::smoke_frag);
  const auto [name, defines, fragment, is] = shader_of(look);
  return program.emplace(surface_program(shading_, name, shaders::surface_vert, defines, fragment, is));
}

const Program& Programs::backdrop() {
  if (!backdrop_)
    backdrop_.emplace("backdrop", shaders::screen_vert, prefix_of(shading_), shaders::backdrop_frag);
  return *backdrop_;
}

const Program& Programs::lens() {
  if (!lens_) lens_.emplace("lens", shaders::screen_vert, prefix_of(shading_), shaders::lens_frag);
  return *lens_;
}

}  // namespace omentum::render::gl
