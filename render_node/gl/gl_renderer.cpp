#include "render_node/gl/gl_renderer.h"

#include "render_node/draw_order.h"
#include "render_node/gl/gl_context.h"
#include "render_node/gl/mesh_buffer.h"
#include "render_node/gl/noise_texture.h"
#include "render_node/gl/panel_backend.h"
#include "render_node/gl/programs.h"
#include "render_node/gl/render_target.h"
#include "render_node/gl/scope_window.h"
#include "render_node/gl/stretch.h"
#include "render_node/gl/tube_painter.h"
#include "render_node/gl/wires.h"
#include "render_node/picture_quality.h"
#include "render_node/tissue_map.h"
#include "shader_sources.h"  // generated from gl/shaders/

#include <epoxy/gl.h>

#include <algorithm>
#include <cstring>
#include <optional>

namespace omentum::render::gl {
namespace {

constexpr int kShadowSide = 1024;                 // texels; a texel is 0.3 mm on a liver (shaders: lit())
constexpr int kPatternSide = 64;                  // texels: 1 MB
constexpr int kShadowUnit = 0, kPatternUnit = 1;  // texture units
constexpr float kSignalDepth =
    0.02f;  // share of the depth range that is kept for what is drawn over the world
constexpr float kShadowSlope = 2.0f, kShadowBias = 4.0f;  // glPolygonOffset, against self-shadowing

class GlRenderer final : public Renderer {
 public:
  GlRenderer(std::unique_ptr<GlContext> context, float ui_scale)
      : context_(std::move(context)), pattern_(make_tissue_pattern(kPatternSide)), shadow_(kShadowSide) {
    glGenVertexArrays(1, &no_vertices_);
    panel_.emplace(*context_, ui_scale);
  }
  ~GlRenderer() override { glDeleteVertexArrays(1, &no_vertices_); }

  MeshId add_mesh(const MeshData& mesh) override {
    meshes_.emplace_back(mesh);
    return static_cast<MeshId>(meshes_.size() - 1);
  }
  void update_vertices(MeshId mesh, std::span<const Vertex> vertices) override {
    meshes_[static_cast<std::size_t>(mesh)].update(vertices);
  }

  void update_triangles(MeshId mesh, std::size_t first, std::span<const MeshTriangle> triangles) override {
    meshes_[static_cast<std::size_t>(mesh)].update(first, triangles);
  }
  void replace_mesh(MeshId mesh, const MeshData& with) override {
    meshes_[static_cast<std::size_t>(mesh)].replace(with);
  }

  TubeId add_tube() override { return tubes_.add(); }
  void update_tube(TubeId tube, std::span<const SkinFrame> frames) override { tubes_.update(tube, frames); }

  Input begin_frame() override { return panel_->begin_frame(); }
  Pointer look_at_pointer() override { return context_->look_at_pointer(); }

  void draw(const Frame& frame) override {
    fit_targets();
    const RenderTarget& scene = target(frame.quality);
    if (casts_shadows(frame)) cast_shadows(frame);
    draw_scene(frame, scene);
    resolve(frame, scene);
    if (frame.with_panel) panel_->draw(output(), fitted_);
  }

  Picture read_back() override {
    Picture picture{context_->size(), {}};
    const auto [width, height] = picture.size;
    const std::size_t row = 4 * static_cast<std::size_t>(width);
    std::vector<std::uint8_t> upward(row * static_cast<std::size_t>(height));
    glBindFramebuffer(GL_READ_FRAMEBUFFER, output());
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glReadPixels(0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE, upward.data());
    picture.rgba.resize(upward.size());
    for (int y = 0; y < height; ++y) {  // OpenGL's rows go upwards
      std::memcpy(&picture.rgba[row * static_cast<std::size_t>(y)],
                  &upward[row * static_cast<std::size_t>(height - 1 - y)], row);
    }
    for (std::size_t i = 3; i < picture.rgba.size(); i += 4) picture.rgba[i] = 255;
    return picture;
  }

  void end_frame() override { context_->end_frame(); }

  Size size() const override { return context_->size(); }
  bool has_window() const override { return context_->has_window(); }
  float ui_scale() const override { return panel_->scale(); }
  std::string software() const override {
    const std::string name = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
    const bool is_program = name.find("llvmpipe") == 0 || name.find("softpipe") == 0 || name.find("SWR") == 0;
    return is_program ? name.substr(0, name.find(' ')) : "";
  }

 private:
  unsigned output() const { return output_ ? output_->framebuffer() : 0; }

  // a window may have been resized
  void fit_targets() {
    const Size size = context_->size();
    if (fitted_ == size) return;
    fitted_ = size;
    for (auto& target : targets_) target.reset();
    if (!has_window()) output_.emplace(size, 0, false);
  }

  const RenderTarget& target(Quality quality) {
    auto& target = targets_[static_cast<std::size_t>(quality)];
    if (target) return *target;
    GLint most = 0;
    glGetIntegerv(GL_MAX_SAMPLES, &most);
    return target.emplace(drawn_size(quality, fitted_), std::min(means_of(quality).samples, most), true);
  }

  static bool casts_shadows(const Frame& frame) {
    return means_of(frame.quality).shading <= Shading::kHardShadows;
  }

  void cast_shadows(const Frame& frame) {
    shadow_.begin();
    glEnable(GL_DEPTH_TEST);
    glEnable(GL_DEPTH_CLAMP);  // shafts reach out of the box towards the lamp and shade all the same
    glEnable(GL_POLYGON_OFFSET_FILL);
    glPolygonOffset(kShadowSlope, kShadowBias);
    shadow_program_.use();
    shadow_program_.set("clip_from_W", frame.lighting.clip_from_W);
    for (const DrawItem& item : frame.items) {
      if (!casts_shadow(item.look)) continue;
      shadow_program_.set("W_from_mesh", item.W_from_mesh);
      mesh(item.mesh).draw();
    }
    tubes_.cast_shadows(frame);
    glDisable(GL_POLYGON_OFFSET_FILL);
    glDisable(GL_DEPTH_CLAMP);
  }

  void draw_scene(const Frame& frame, const RenderTarget& scene) {
    drawn_ = scene.size();
    glBindFramebuffer(GL_FRAMEBUFFER, scene.framebuffer());
    glViewport(0, 0, drawn_.width, drawn_.height);
    glClear(GL_DEPTH_BUFFER_BIT);
    const ScopeWindow window(frame, drawn_);
    shadow_.bind_texture(kShadowUnit);
    pattern_.bind(kPatternUnit);

    glEnable(GL_DEPTH_TEST);
    glEnable(GL_CULL_FACE);
    for (const Look look : opaque_looks(frame.quality)) draw_items(frame, look);
    glDepthRange(kSignalDepth, 1);
    if (frame.wires)
      wires_.draw(
          frame, [this](MeshId id) -> const MeshBuffer& { return mesh(id); },
          [&] { tubes_.draw_wires(frame); });
    glDisable(GL_CULL_FACE);
    glDepthFunc(GL_LEQUAL);
    fill_screen(programs(frame).backdrop(), frame);
    glDepthFunc(GL_LESS);
    blend_looks(frame);
    glDisable(GL_DEPTH_TEST);

    if (frame.through_endoscope) {
      glEnable(GL_BLEND);
      glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
      fill_screen(programs(frame).lens(), frame);
      glDisable(GL_BLEND);
    }
  }

  void blend_looks(const Frame& frame) {
    glEnable(GL_CULL_FACE);
    glEnable(GL_BLEND);
    glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
    glDepthMask(GL_FALSE);
    for (const Look look : blended_looks(frame.quality)) draw_items(frame, look);
    glDepthMask(GL_TRUE);
    glDisable(GL_BLEND);
    glDisable(GL_CULL_FACE);
  }

  void draw_items(const Frame& frame, Look look) {
    const auto set_all = [&](const Program& p) {
      set_scene(p, frame);
      p.set("clip_from_W", Mat4f(frame.view.clip_from_eye * frame.view.eye_from_W));
      if (look == Look::kMap) set_colours(p);
    };
    const bool over = look == Look::kSignal;
    glDepthRange(over ? 0 : kSignalDepth, over ? kSignalDepth : 1);
    tubes_.draw(frame, look, set_all);
    if (std::ranges::none_of(frame.items, [&](const DrawItem& item) { return item.look == look; })) return;
    const Program& program = programs(frame).of(look);
    program.use();
    set_all(program);
    for (const DrawItem& item : frame.items) {
      if (item.look != look) continue;
      program.set("W_from_mesh", item.W_from_mesh);
      program.set("material_colour", item.material.colour);
      program.set("material_metalness", item.material.metalness);
      program.set("material_roughness", item.material.roughness);
      program.set("material_glow", item.material.glow);
      if (look == Look::kSmoke) program.set("material_opacity", item.material.opacity);
      const MeshBuffer& buffer = mesh(item.mesh);
      means_of(frame.quality).corners_alone ? buffer.draw_corners() : buffer.draw();
    }
  }

  void set_scene(const Program& program, const Frame& frame) {
    program.set("eye", frame.view.eye);
    program.set("far_key", frame.lighting.towards_key);
    program.set("lamp", frame.lighting.lamp);
    program.set("lamp_reach", frame.lighting.lamp_reach_m);
    program.set("light_from_W", frame.lighting.clip_from_W);
    program.set("unit_length", frame.lighting.radius_m);
    program.set("picture_size", static_cast<float>(drawn_.width), static_cast<float>(drawn_.height));
    program.set("middle", frame.middle);
    program.set("scope", frame.through_endoscope ? 1.0f : 0.0f);
    program.set("shadow_map", kShadowUnit);
    program.set("pattern", kPatternUnit);
  }

  static void set_colours(const Program& program) {
    for (std::size_t i = 0; i < kMapColourCount; ++i)
      program.set(("map_colours[" + std::to_string(i) + "]").c_str(), map_colours()[i]);
  }

  void fill_screen(const Program& program, const Frame& frame) {
    program.use();
    set_scene(program, frame);
    glBindVertexArray(no_vertices_);
    glDrawArrays(GL_TRIANGLES, 0, 3);
  }

  void resolve(const Frame& frame, const RenderTarget& scene) {
    const auto [width, height] = fitted_;
    if (scene.texture() == 0) {  // several samples per pixel
      glBindFramebuffer(GL_READ_FRAMEBUFFER, scene.framebuffer());
      glBindFramebuffer(GL_DRAW_FRAMEBUFFER, output());
      glBlitFramebuffer(0, 0, width, height, 0, 0, width, height, GL_COLOR_BUFFER_BIT, GL_NEAREST);
    } else {
      glBindFramebuffer(GL_FRAMEBUFFER, output());
      const ScopeWindow window(frame, fitted_);
      stretch_.draw(scene, output(), fitted_);
    }
    glBindFramebuffer(GL_FRAMEBUFFER, output());
    glViewport(0, 0, width, height);
  }

  Programs& programs(const Frame& frame) {
    const Shading shading = means_of(frame.quality).shading;
    auto& programs = programs_[static_cast<std::size_t>(shading)];
    return programs ? *programs : programs.emplace(shading);
  }
  const MeshBuffer& mesh(MeshId id) const { return meshes_[static_cast<std::size_t>(id)]; }

  // the context comes first and goes last: everything below lives in it
  std::unique_ptr<GlContext> context_;
  Program shadow_program_{"shadow", shaders::shadow_vert, "", shaders::shadow_frag};
  std::array<std::optional<Programs>, kShadingCount> programs_;  // made when first needed
  TubePainter tubes_;
  Stretch stretch_;
  NoiseTexture pattern_;
  Wires wires_;
  ShadowMap shadow_;
  unsigned no_vertices_ = 0;
  std::vector<MeshBuffer> meshes_;
  Size fitted_;                                                     // what the targets were made for
  Size drawn_;                                                      // of the target being drawn
  std::array<std::optional<RenderTarget>, kQualityCount> targets_;  // made when first needed
  std::optional<RenderTarget> output_;                              // off-screen only
  std::optional<PanelBackend> panel_;
};

}  // namespace

std::unique_ptr<Renderer> open_window(Size size, const std::string& title, float ui_scale) {
  return std::make_unique<GlRenderer>(open_glfw_context(size, title), ui_scale);
}

std::unique_ptr<Renderer> open_offscreen(Size size, float ui_scale) {
  return std::make_unique<GlRenderer>(open_egl_context(size), ui_scale);
}

}  // namespace omentum::render::gl
