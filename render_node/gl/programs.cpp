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

Program surface(Shading shading, const char* name, const std::string& defines, std::string_view fragment,
                const std::string& is) {
  return surface_program(shading, name, shaders::surface_vert, defines, fragment, is);
}

}  // namespace

Program surface_program(Shading shading, const char* name, std::string_view vertex,
                        const std::string& defines, std::string_view fragment, const std::string& is) {
  if (shading != Shading::kPerVertex) return {name, vertex, prefix_of(shading) + defines, fragment};
  return {name, vertex, "", shaders::vertex_lit_frag,
          "#define PER_VERTEX\n#define " + is + "\n" + defines + std::string(shaders::common_glsl) +
              std::string(shaders::vertex_light_glsl)};
}

Programs::Programs(Shading shading)
    : backdrop_("backdrop", shaders::screen_vert, prefix_of(shading), shaders::backdrop_frag),
      lens_("lens", shaders::screen_vert, prefix_of(shading), shaders::lens_frag),
      tissue_(surface(shading, "tissue", "", shaders::tissue_frag, "TISSUE")),
      cut_(surface(shading, "cut tissue", "#define CUT\n", shaders::tissue_frag, "TISSUE")),
      bared_(
          surface(shading, "bared tissue", "#define CUT\n#define BARED\n", shaders::tissue_frag, "TISSUE")),
      map_(surface(shading, "map", "", shaders::map_frag, "MAP")),
      gut_(surface(shading, "gut", "#define GUT\n", shaders::tissue_frag, "TISSUE")),
      blood_(surface(shading, "blood", "", shaders::blood_frag, "SOLID")),
      smoke_("smoke", shaders::surface_vert, prefix_of(shading), shaders::smoke_frag),
      mesentery_(surface(shading, "mesentery", "#define SHEET\n", shaders::tissue_frag, "TISSUE")),
      wall_(surface(shading, "wall", "#define WALL\n", shaders::tissue_frag, "TISSUE")),
      solid_(surface(shading, "solid", "", shaders::solid_frag, "SOLID")),
      ground_(surface(shading, "ground", "", shaders::ground_frag, "GROUND")),
      signal_(surface(shading, "signal", "", shaders::signal_frag, "SIGNAL")) {}

const Program& Programs::of(Look look) const {
  switch (look) {
    case Look::kTissue:
      return tissue_;
    case Look::kCut:
      return cut_;
    case Look::kBared:
      return bared_;
    case Look::kMap:
      return map_;
    case Look::kGut:
      return gut_;
    case Look::kBlood:
      return blood_;
    case Look::kSmoke:
      return smoke_;
    case Look::kMesentery:
      return mesentery_;
    case Look::kWall:
      return wall_;
    case Look::kGround:
      return ground_;
    case Look::kSignal:
      return signal_;
    default:
      return solid_;
  }
}

}  // namespace omentum::render::gl
