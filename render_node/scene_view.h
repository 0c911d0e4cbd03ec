// The scene as something to draw: organs, instruments, arrows and markers, from state to a Frame.
#pragma once

#include "render_node/close_up.h"
#include "render_node/instrument_shape.h"
#include "render_node/organ_look.h"

#include <memory>
#include <optional>

namespace omentum::render {

/// One organ at rest: what an organ file says of its surface.
struct OrganShape {
  geometry::Surface surface;
  std::vector<Vec3> rest;                                 // [S], m
  std::vector<geometry::SurfaceId> surface_of_file_node;  // invalid where none
  Material material = tissue_material("liver");
};

/// One instrument now. `force_n`: on the hand, in W.
struct ToolNow {
  bool seen = false;  // false: nothing valid is known, it is not drawn
  Vec3 p_WT = Vec3::Zero();
  Eigen::Quaterniond q_WT = Eigen::Quaterniond::Identity();
  double grip_rad = 0;
  Vec3 force_n = Vec3::Zero();
  std::size_t contact_organ = 0;
  std::vector<std::uint32_t> contact_nodes;  // places in the mesh file, from 0
  std::vector<float> contact_forces_n;       // on each of them
};

/// What the person at the window chose.
struct ViewChoices {
  Camera orbit;
  bool endoscope = false;
  bool arrows = true;
  bool markers = false;  // the nodes in contact: for whoever looks into the contact, not at the organ
};

/// Arrows: this long per newton, up to a longest one; weaker forces than the least have none.
inline constexpr double kArrowMetresPerNewton = 0.02;  // 1 N, a firm press on a liver, is clearly seen
inline constexpr double kLongestArrowM = 0.12;
inline constexpr double kLeastArrowN = 0.02;  // below what a hand feels

/// Holds the meshes that it gave the renderer. One thread, the renderer's.
class SceneView {
 public:
  SceneView(const runtime::Scene& scene, const std::vector<OrganShape>& organs, Renderer& renderer);

  /// `displacements`: [3S] of that organ, m.
  void deform(std::size_t organ, std::span<const float> displacements);

  /// `tools`: as many as the scene's, in its order. `panel_share`: of the width, covered on the left.
  Frame frame(const ViewChoices& choices, std::span<const ToolNow> tools, double panel_share) const;

  /// What a picture of a dent shows: the same scene from nearby, without the panel.
  Frame close_up(const Dent& dent, const ViewChoices& choices, std::span<const ToolNow> tools) const;

  /// The dent that a tool presses; none where it touches nothing.
  std::optional<Dent> dent_of(const ToolNow& tool) const;

  /// Where the orbit camera starts.
  Camera first_camera() const;
  const Ball& ball() const { return ball_; }
  const OrganSkin& skin(std::size_t organ) const { return organs_[organ].skin; }
  std::size_t organ_count() const { return organs_.size(); }

 private:
  struct DrawnOrgan {
    OrganSkin skin;
    std::vector<geometry::SurfaceId> surface_of_file_node;
    Material material;
    MeshId mesh{};
    /// Invalid where the file's node is not on the surface.
    geometry::SurfaceId surface_node(std::uint32_t file_node) const {
      return file_node < surface_of_file_node.size() ? surface_of_file_node[file_node]
                                                     : geometry::SurfaceId();
    }
  };
  struct DrawnPart {
    InstrumentPart part;
    MeshId mesh{};
  };
  Ball shadow_ball() const;  // what the shadow map covers
  Camera camera(const ViewChoices& choices, std::span<const ToolNow> tools) const;
  Frame frame_from(const Camera& camera, const ViewChoices& choices, std::span<const ToolNow> tools,
                   double panel_share) const;
  void add_instrument(std::size_t tool, const ToolNow& now, std::vector<DrawItem>& items) const;
  void add_arrow(std::size_t tool, const ToolNow& now, std::vector<DrawItem>& items) const;
  void add_markers(std::size_t tool, const ToolNow& now, std::vector<DrawItem>& items) const;

  Renderer& renderer_;
  runtime::Scene scene_;
  std::vector<DrawnOrgan> organs_;
  std::vector<std::vector<DrawnPart>> instruments_;  // per tool of the scene
  Ball ball_;
  double ground_m_ = 0;  // height of the table
  MeshId ground_{}, arrow_shaft_{}, arrow_head_{}, marker_{};
};

/// The scope among the scene's tools (one named "endoscope"), or none.
std::optional<std::size_t> scope_of(const runtime::Scene& scene);

}  // namespace omentum::render
