#include "render_node/gl/tube_painter.h"

#include "shader_sources.h"  // generated from gl/shaders/

#include <algorithm>

namespace omentum::render::gl {
namespace {

std::string skinning(std::string_view vertex) {
  return std::string(shaders::tube_glsl) + std::string(vertex);
}

}  // namespace

TubePainter::Wall::Wall(Shading shading)
    : gut(surface_program(shading, "tube", skinning(shaders::tube_vert), "#define GUT\n",
                          shaders::tissue_frag, "TISSUE")),
      map(surface_program(shading, "map of a tube", skinning(shaders::tube_vert), "", shaders::map_frag,
                          "MAP")) {}

TubePainter::TubePainter()
    : shadow_("shadow of a tube", skinning(shaders::tube_shadow_vert), "", shaders::shadow_frag),
      wires_("wires of a tube", skinning(shaders::tube_shadow_vert), "", shaders::wires_frag) {}

TubeId TubePainter::add() {
  tubes_.emplace_back();
  return static_cast<TubeId>(tubes_.size() - 1);
}

void TubePainter::update(TubeId tube, std::span<const SkinFrame> frames) {
  tubes_[static_cast<std::size_t>(tube)].update(frames);
}

void TubePainter::cast_shadows(const Frame& frame) {
  if (frame.tubes.empty()) return;
  shadow_.use();
  shadow_.set("clip_from_W", frame.lighting.clip_from_W);
  for (const TubeItem& item : frame.tubes) {
    shadow_.set("radius", item.radius_m);
    draw(item, frame.quality);
  }
}

void TubePainter::draw_wires(const Frame& frame) {
  if (frame.tubes.empty()) return;
  wires_.use();
  wires_.set("clip_from_W", Mat4f(frame.view.clip_from_eye * frame.view.eye_from_W));
  for (const TubeItem& item : frame.tubes) {
    wires_.set("radius", item.radius_m);
    draw(item, frame.quality);
  }
}

void TubePainter::draw(const Frame& frame, Look look, const std::function<void(const Program&)>& set_scene) {
  if (std::ranges::none_of(frame.tubes, [&](const TubeItem& item) { return item.look == look; })) return;
  const Shading shading = means_of(frame.quality).shading;
  auto& wall = walls_[static_cast<std::size_t>(shading)];
  if (!wall) wall.emplace(shading);
  const Program& program = look == Look::kMap ? wall->map : wall->gut;
  program.use();
  set_scene(program);
  for (const TubeItem& item : frame.tubes) {
    if (item.look != look) continue;
    program.set("radius", item.radius_m);
    program.set("by_turn", item.by_turn ? 1.0f : 0.0f);
    program.set("turn_full", static_cast<float>(2 * item.resolution.eps));
    program.set("material_colour", item.material.colour);
    program.set("material_roughness", item.material.roughness);
    draw(item, frame.quality);
  }
}

void TubePainter::draw(const TubeItem& item, Quality quality) {
  const int n = clamped(item.resolution).n;
  const bool few = means_of(quality).corners_alone;
  auto& cylinder = (few ? few_cylinders_ : cylinders_)[static_cast<std::size_t>(n)];
  if (!cylinder) cylinder.emplace(n, few ? TubeCylinder::kFewAround : TubeCylinder::kAround);
  tubes_[static_cast<std::size_t>(item.tube)].draw(*cylinder);
}

}  // namespace omentum::render::gl
