// The scene as something to draw: organs, instruments, arrows and markers, from state to a Frame.
#pragma once

#include "render_node/back_to_front.h"
#include "render_node/camera_score.h"
#include "render_node/close_up.h"
#include "render_node/exposure_raster.h"
#include "render_node/instrument_shape.h"
#include "render_node/organ_drawing.h"
#include "render_node/scene_tubes.h"
#include "render_node/scenery.h"
#include "render_node/smoke.h"
#include "render_node/tissue_map.h"

#include <algorithm>
#include <memory>
#include <optional>

namespace omentum::render {

/// One instrument now. `force_n`: on the hand, in W.
struct ToolNow {
  bool seen = false;  // false: nothing valid is known, it is not drawn
  Vec3 p_WT = Vec3::Zero();
  Eigen::Quaterniond q_WT = Eigen::Quaterniond::Identity();
  double grip_rad = 0;
  bool cuts = false;  // its button for that is pressed
  Vec3 force_n = Vec3::Zero();
  std::size_t contact_organ = 0;
  std::vector<std::uint32_t> contact_nodes;  // places in the mesh file, from 0
  std::vector<float> contact_forces_n;       // on each of them
  std::optional<Vec3> burning_at;            // the middle of its edge, in W, while it cuts
};

/// What the person at the window chose.
struct ViewChoices {
  Camera orbit;
  bool endoscope = false;
  bool arrows = true;
  TissueMap map = TissueMap::kOff;  // as which organs are drawn whose values are known
  bool folds = false;               // tubes coloured by how they are folded (Raghupathi 2004, fig. 10)
  bool markers = false;  // the nodes in contact: for whoever looks into the contact, not at the organ
  bool touches = false;  // parts of the organs that touch (touch_view.h)
  bool wires = false;    // the triangles of what is drawn
};

/// Arrows: this long per newton, up to a longest one; weaker forces than the least have none.
inline constexpr double kArrowMetresPerNewton = 0.02;  // 1 N, a firm press on a liver, is clearly seen
inline constexpr double kLongestArrow_m = 0.12;
inline constexpr double kLeastArrow_n = 0.02;  // below what a hand feels

/// Holds the meshes that it gave the renderer. One thread, the renderer's.
class SceneView {
 public:
  SceneView(const scene::Scene& scene, std::vector<std::unique_ptr<OrganDrawing>> organs, Renderer& renderer);
  SceneView(const scene::Scene& scene, const std::vector<OrganShape>& organs, Renderer& renderer);

  /// What else is seen, from now on. Once.
  void surround(std::vector<SceneryPiece> pieces) { scenery_.set(std::move(pieces), outline()); }

  /// `values`: of a whole state of that organ (OrganDrawing::deform).
  void deform(std::size_t organ, std::span<const float> values);
  /// The organ as a state has it, of which `removed` is gone. `shares`: of the map's scale at each of the
  /// state's nodes (tissue_map.h); empty where they are not known. False: it has no such states; nothing was
  /// changed.
  [[nodiscard]] bool show(std::size_t organ, const RemovedSet& removed, std::span<const float> values,
                          std::span<const float> shares = {});
  /// `dt_s` go by under these forces (OrganDrawing::live), which is seen from the next show() or refresh()
  /// on.
  void live(std::size_t organ, std::span<const NodeForce> forces, double dt_s);
  /// And smoke rises from edges that burn.
  void smoke(std::span<const ToolNow> tools, double dt_s);
  /// Where no state came: shows what changed without one.
  void refresh(std::size_t organ);
  /// What organs are a map of is of no use any more: until they are shown anew they are drawn as tissue.
  void forget_map();
  /// Whether an organ's shares are known.
  bool mapped(std::size_t organ) const { return organs_[organ].mapped; }

  /// How finely tubes are drawn from now on, within tube_resolution.h's bounds.
  void set_tube_resolution(const TubeResolution& resolution) { tubes_.set_resolution(resolution); }
  const TubeResolution& tube_resolution() const { return tubes_.resolution(); }
  /// Of all tubes, as the next frame draws them.
  TubeCost tube_cost() const { return tubes_.cost(); }

  /// The ground's shade follows organs that wander: for now and then, it takes milliseconds.
  void shade_ground();

  /// `tools`: as many as the scene's, in its order. `panel_share`: of the width, covered on the left.
  Frame frame(const ViewChoices& choices, std::span<const ToolNow> tools, double panel_share) const;

  /// Before the frame is drawn: what light goes through, the farthest first as it sees it.
  void order_translucent(const Frame& frame);

  /// What a picture of a dent shows: the same scene from nearby, without the panel.
  Frame close_up(const Dent& dent, const ViewChoices& choices, std::span<const ToolNow> tools) const;

  /// The dent that a tool presses; none where it touches nothing.
  std::optional<Dent> dent_of(const ToolNow& tool) const;

  /// The share of an organ that nothing hides, tools included, as the scene's own camera or its endoscope
  /// sees it, wherever a person turned the picture; none where it is out of sight. Draws into `raster`.
  std::optional<double> exposed_share(std::size_t organ, std::span<const ToolNow> tools,
                                      ExposureRaster& raster) const;

  /// How the scope is held towards `target`, whatever the person at the window looks at; none while no scope
  /// is seen.
  std::optional<CameraMoment> scope_moment(const Vec3& target, std::span<const ToolNow> tools) const;

  /// Where the orbit camera starts.
  Camera first_camera() const;
  const Ball& ball() const { return ball_; }
  /// Tetrahedra of an organ as it is drawn.
  std::int32_t removed_count(std::size_t organ) const { return organs_[organ].drawing->removed_count(); }
  /// Of an organ that is one long tube, m; 0 of any other.
  double length_m(std::size_t organ) const { return organs_[organ].drawing->length_m(); }
  /// Null for an organ that tools do not dent.
  const PressedSurface* surface(std::size_t organ) const { return organs_[organ].drawing->surface(); }
  /// What is drawn of an organ where it is not cut, as many vertices as ever.
  const MeshData& mesh(std::size_t organ) const { return organs_[organ].drawing->mesh(); }
  std::size_t organ_count() const { return organs_.size(); }
  bool has_tube() const {
    return std::ranges::any_of(organs_, [](const DrawnOrgan& o) { return o.drawing->length_m() > 0; });
  }

 private:
  struct DrawnOrgan {
    std::unique_ptr<OrganDrawing> drawing;
    MeshId mesh{};                      // of no meaning for a tube
    std::optional<std::size_t> tube{};  // of tubes_
    std::optional<MeshId> bared{};      // made when it is first cut
    std::vector<MeshId> parts{};        // as the drawing has them
    std::optional<MeshId> blood{};      // made when it first bleeds
    bool stale = false;                 // what is on the screen lacks a change
    bool mapped = false;                // its vertices have their shares of the map
  };
  struct DrawnPart {
    InstrumentPart part;
    MeshId mesh{};
  };
  Outline outline() const;
  void send_vertices(DrawnOrgan& organ);
  void show_cut(DrawnOrgan& organ);
  const PressedSurface* touched_surface(const ToolNow& tool) const;
  Ball shadow_ball() const;  // what the shadow map covers
  Camera camera(const ViewChoices& choices, std::span<const ToolNow> tools) const;
  Frame frame_from(const Camera& camera, const ViewChoices& choices, std::span<const ToolNow> tools,
                   double panel_share) const;
  bool hidden_from_scope(const Vec3& eye, const Vec3& target, std::span<const ToolNow> tools) const;
  void add_organ(const DrawnOrgan& organ, const ViewChoices& choices, Frame& frame) const;
  void add_instrument(std::size_t tool, const ToolNow& now, std::vector<DrawItem>& items) const;
  void add_arrow(std::size_t tool, const ToolNow& now, std::vector<DrawItem>& items) const;
  void add_markers(std::size_t tool, const ToolNow& now, std::vector<DrawItem>& items) const;

  Renderer& renderer_;
  scene::Scene scene_;
  std::vector<DrawnOrgan> organs_;
  SceneTubes tubes_;
  Scenery scenery_;
  std::vector<std::vector<DrawnPart>> instruments_;  // per tool of the scene
  Ball ball_;
  MeshData drape_;  // the ground's
  MeshId ground_{}, arrow_shaft_{}, arrow_head_{}, marker_{}, puff_{};
  Smoke smoke_;
  BackToFront back_to_front_;  // workspace
};

}  // namespace omentum::render
