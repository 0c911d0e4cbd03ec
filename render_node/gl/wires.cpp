#include "render_node/gl/wires.h"

#include "shader_sources.h"  // generated from gl/shaders/

#include <epoxy/gl.h>

namespace omentum::render::gl {
namespace {

// As much nearer to the eye as keeps a line before the triangle that it belongs to (glPolygonOffset).
constexpr float kSlope = -1.0f, kBias = -2.0f;

bool is_organ(Look look) {
  return look != Look::kSolid && look != Look::kWall && look != Look::kGround && look != Look::kSignal;
}

}  // namespace

Wires::Wires() : program_("wires", shaders::shadow_vert, "", shaders::wires_frag) {}

void Wires::draw(const Frame& frame, const std::function<const MeshBuffer&(MeshId)>& mesh,
                 const std::function<void()>& tubes) const {
  program_.use();
  program_.set("clip_from_W", Mat4f(frame.view.clip_from_eye * frame.view.eye_from_W));
  glPolygonMode(GL_FRONT_AND_BACK, GL_LINE);
  glEnable(GL_POLYGON_OFFSET_LINE);
  glPolygonOffset(kSlope, kBias);
  glEnable(GL_BLEND);
  glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
  for (const DrawItem& item : frame.items) {
    if (!is_organ(item.look)) continue;
    program_.set("W_from_mesh", item.W_from_mesh);
    mesh(item.mesh).draw();
  }
  tubes();
  glDisable(GL_BLEND);
  glDisable(GL_POLYGON_OFFSET_LINE);
  glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
}

}  // namespace omentum::render::gl
