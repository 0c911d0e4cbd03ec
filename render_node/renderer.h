// What can be drawn, and the seam behind which it is drawn. render_node/gl/ draws with OpenGL; tests record.
#pragma once

#include "render_node/key_presses.h"
#include "render_node/pointer.h"
#include "render_node/tube_item.h"

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace omentum::render {

using Vec3f = Eigen::Vector3f;
using Mat4f = Eigen::Matrix4f;

struct Size {
  int width = 0, height = 0;
  friend bool operator==(Size, Size) = default;
  float aspect() const { return static_cast<float>(width) / static_cast<float>(height); }
};

/// A corner of a triangle. `rest` is where it was before any deformation: patterns stick to it.
/// `openness` is the fraction of ambient light that reaches it, `charring` how far heat browned it, 0 to 1;
/// `pallor` which share of its blood pressure squeezed out (pallor.h);
/// `share` how far up a map's scale the tissue there is (tissue_map.h), 1 or more: at its end.
struct Vertex {
  Vec3f position;
  Vec3f normal;  // outward, unit
  Vec3f rest;
  float openness = 1;
  float charring = 0;
  float pallor = 0;
  float share = 0;
};
static_assert(sizeof(Vertex) == 13 * sizeof(float), "uploaded as it lies in memory");

using MeshTriangle = std::array<std::uint32_t, 3>;  // counter-clockwise seen from outside

struct MeshData {
  std::vector<Vertex> vertices;
  std::vector<MeshTriangle> triangles;
  int split =
      1;  // each run of split^2 triangles was one, split as SurfaceRefinement does (corner_triangles.h)
  // What the coarsest pictures draw instead of `triangles`, of the same vertices; empty: what split says.
  std::vector<MeshTriangle> few{};
};

/// A mesh that a renderer holds.
enum class MeshId : std::uint32_t {};

/// How light meets a surface.
enum class Look : std::uint8_t {
  kTissue,     // wet, translucent, patterned
  kCut,        // the same, of an organ that was cut: heat may have charred it
  kBared,      // the inside of tissue, where it was cut or torn
  kBlood,      // drops on it
  kGut,        // tissue of a tube: fine vessels, rings of muscle
  kMesentery,  // a sheet of fat and vessels, through which light goes: its triangles lie back to front
  kMap,        // tissue as a map of what it is under (tissue_map.h)
  kWall,       // tissue that encloses the organs: seen from inside, darkens nothing
  kSolid,      // metal or plastic
  kSmoke,      // soft, and blended over all that lies behind
  kGround,     // the drape below, fading into the background
  kSignal,     // arrows and markers: not part of the world, drawn over it, nearly unlit
};

/// Colours are linear (not gamma-encoded) sRGB primaries.
struct Material {
  Vec3f colour{0.5f, 0.5f, 0.5f};
  float metalness = 0;
  float roughness = 0.5f;
  Vec3f glow = Vec3f::Zero();  // light that a kSolid gives off by itself
  float opacity = 1;           // of smoke
};

struct DrawItem {
  MeshId mesh{};
  Look look = Look::kSolid;
  Mat4f W_from_mesh = Mat4f::Identity();
  Material material{};
};

/// A tube, skinned on its frames by whoever draws it (tube_cylinder.h). `by_turn`: a map (Look::kMap) of how
/// much it is folded instead of its shares: from the middle of the scale on, pieces that `resolution.eps`
/// cuts.
struct TubeItem {
  TubeId tube{};
  Look look = Look::kGut;  // or kMap
  TubeResolution resolution;
  float radius_m = 0;
  Material material{};
  bool by_turn = false;
};

/// Where from: world to eye, eye to clip (OpenGL's: z from -1 to 1), and the eye's place in W, m.
struct View {
  Mat4f eye_from_W = Mat4f::Identity();
  Mat4f clip_from_eye = Mat4f::Identity();
  Vec3f eye = Vec3f::Zero();
};

/// The key light throws shadows inside of `clip_from_W`, a box, or a scope's cone; the fill light sits at the
/// eye.
struct Lighting {
  Vec3f towards_key = Vec3f::UnitZ();  // unit, in W
  Mat4f clip_from_W = Mat4f::Identity();
  float radius_m = 0.1f;  // of what is lit: lengths in shading are shares of it
  // A scope's light (scope_view.h) is not far away but here, in W, m, and as bright as the key light at that
  // distance, m; 0: the light is far away.
  Vec3f lamp = Vec3f::Zero();
  float lamp_reach_m = 0;
};

/// How much is spent on a frame (picture_quality.h, frame_rate_control.h). A panel is always drawn finely.
enum class Quality : std::uint8_t {
  kFine,    // smooth edges, soft shadows: pictures, and wherever a graphics card draws
  kPlain,   // one sample per pixel
  kCoarse,  // and fewer pixels, stretched
  kFlat,    // without shadows
  kDraft,   // light at the vertices, all pixels
  kSketch,  // a quarter of them
  kFaint,   // a ninth
};
inline constexpr std::size_t kQualityCount = 7;

/// One picture of the scene.
struct Frame {
  Quality quality = Quality::kFine;
  View view;
  Lighting lighting;
  std::vector<DrawItem> items;
  std::vector<TubeItem> tubes;
  bool through_endoscope = false;  // round field of view
  bool wires = false;              // the edges of the organs' triangles, over them
  float middle = 0.5f;             // of the view, share of the width: a panel may cover the left
  bool with_panel = true;          // the one that was laid out since begin_frame()
};

/// Eight-bit sRGB with opaque alpha, rows from top to bottom.
struct Picture {
  Size size;
  std::vector<std::uint8_t> rgba;
};

/// What the person at the window did since the last frame. Off-screen: nothing, ever.
struct Input {
  float orbit_x = 0, orbit_y = 0;  // pixels dragged with the left button
  float pan_x = 0, pan_y = 0;      // pixels dragged with the right or middle button
  float zoom = 0;                  // wheel steps, positive towards the target
  KeyPresses keys{};               // that went down
  bool close = false;
  Pointer pointer;  // the same, for whom it moves an instrument (pointer_rays.h)
};

/// Draws frames into a window or an off-screen target. One thread, the one that made it.
///
/// A frame is: begin_frame(), lay out the panel with Dear ImGui, draw(), read_back() if a picture is
/// wanted, end_frame(). It may be drawn and read back without the panel before that, for a picture of another
/// view.
class Renderer {
 public:
  virtual ~Renderer() = default;
  virtual MeshId add_mesh(const MeshData& mesh) = 0;
  /// As many vertices as the mesh was added with.
  virtual void update_vertices(MeshId mesh, std::span<const Vertex> vertices) = 0;
  /// Some of its triangles, from `first` on, become others; their number stays.
  virtual void update_triangles(MeshId mesh, std::size_t first, std::span<const MeshTriangle> triangles) = 0;
  /// Becomes another one, of any size.
  virtual void replace_mesh(MeshId mesh, const MeshData& with) = 0;

  /// Without frames, until it has some.
  virtual TubeId add_tube() = 0;
  /// Of any number, which may change.
  virtual void update_tube(TubeId tube, std::span<const SkinFrame> frames) = 0;

  virtual Input begin_frame() = 0;
  /// Between two frames: what the person did since it was asked last, here or by begin_frame(). The camera's
  /// part of the Input waits for the next frame, but not that of the pointer.
  virtual Pointer look_at_pointer() { return {}; }
  virtual void draw(const Frame& frame) = 0;  // the scene, then the panel over it
  virtual Picture read_back() = 0;
  virtual void end_frame() = 0;

  virtual Size size() const = 0;
  virtual bool has_window() const = 0;
  /// Of the panel in this frame, 1 where its text is kPanelFontPixels high (panel_style.h).
  virtual float ui_scale() const { return 1; }
  /// The rasterizer, where it is a program and not a graphics card; else empty.
  virtual std::string software() const { return {}; }
};

}  // namespace omentum::render
