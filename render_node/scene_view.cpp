#include "render_node/scene_view.h"

#include "geometry/rotation.h"
#include "render_node/lighting.h"
#include "render_node/organ_look.h"
#include "render_node/scope_view.h"
#include "render_node/solids.h"

#include <algorithm>

namespace omentum::render {
namespace {

const Material kDrape{{0.016f, 0.046f, 0.056f}, 0.0f, 0.9f};

constexpr double kArrowRadius_m = 0.0013, kHeadRadius_m = 0.0034, kHeadLength_m = 0.009;
constexpr double kMarkerRadius_m = 0.0011;
constexpr double kShadowReach =
    1.45;  // of the organs' radius: the instruments' near parts and the shadow beside the organ

// An endoscope without a tool or pose of its own looks from here.
constexpr double kScopeDistance = 0.42;  // of the orbit camera's start

constexpr std::size_t kGroundSamples = 400;  // of the organs, for a shade that follows them: 4 ms

constexpr double kLeastHeight = 0.45;  // of the unit viewing direction: never from under the table

// From where a whole scene is best seen: the side on which it is pressed, from above.
Vec3 viewing_direction(const scene::Scene& scene) {
  Vec3 pressed = Vec3::Zero();
  for (const auto& hand : scene.hands) pressed += hand.press_normal;
  Vec3 along(pressed.x(), pressed.y(), 0);
  along = along.norm() > 0.3 * std::max(1.0, pressed.norm()) ? along.normalized() : Vec3(0, -1, 0);
  const Vec3 side = along.cross(Vec3::UnitZ());
  Vec3 from = (along + 0.45 * side).normalized();
  const double height = std::clamp(pressed.norm() > 0 ? pressed.normalized().z() : 0.5, kLeastHeight, 0.62);
  return std::sqrt(1 - height * height) * from + height * Vec3::UnitZ();
}

// Of the plane that organs fall on, if the scene has one.
std::optional<double> table_height(const scene::Scene& scene) {
  constexpr double kLevel = 0.999;  // cosine of its slope: a drape is drawn level
  for (const scene::ObstacleSpec& obstacle : scene.obstacles)
    if (obstacle.shape == "plane" && obstacle.normal.z() > kLevel) return obstacle.centre.z();
  return std::nullopt;
}

std::vector<std::unique_ptr<OrganDrawing>> drawings_of(const std::vector<OrganShape>& organs) {
  std::vector<std::unique_ptr<OrganDrawing>> drawings;
  for (const OrganShape& shape : organs) drawings.push_back(make_drawing(shape));
  return drawings;
}

// z of the mesh along `direction`, scaled.
Mat4f placed(const Vec3& origin, const Vec3& direction, double width, double length) {
  const Eigen::Matrix3d turn = geometry::rotation_onto(Vec3::UnitZ(), direction).toRotationMatrix();
  Eigen::Matrix4d pose = Eigen::Matrix4d::Identity();
  pose.topLeftCorner<3, 3>() = turn * Vec3(width, width, length).asDiagonal();
  pose.topRightCorner<3, 1>() = origin;
  return pose.cast<float>();
}

Material signal_material(std::uint32_t tool) {
  return {tool_colour(tool), 0, 1};
}

}  // namespace

SceneView::SceneView(const scene::Scene& scene, const std::vector<OrganShape>& organs, Renderer& renderer)
    : SceneView(scene, drawings_of(organs), renderer) {}

SceneView::SceneView(const scene::Scene& scene, std::vector<std::unique_ptr<OrganDrawing>> organs,
                     Renderer& renderer)
    : renderer_(renderer), scene_(scene), tubes_(renderer), scenery_(renderer) {
  for (std::unique_ptr<OrganDrawing>& drawing : organs) {
    DrawnOrgan& organ = organs_.emplace_back(DrawnOrgan{std::move(drawing)});
    TubeFrames* const tube = organ.drawing->tube();
    if (tube) organ.tube = tubes_.add(*tube);
    if (!tube) organ.mesh = renderer.add_mesh(organ.drawing->mesh());
    for (const OrganPart& part : organ.drawing->parts()) organ.parts.push_back(renderer.add_mesh(*part.mesh));
  }
  const Outline all = outline();
  ball_ = ball_around(all.points);
  for (const auto& tool : scene.tools) {
    auto& parts = instruments_.emplace_back();
    for (auto& part : instrument_parts(tool, tool_colour(tool.id))) {
      const MeshId mesh = renderer.add_mesh(part.mesh);
      parts.push_back({std::move(part), mesh});
    }
  }
  drape_ = ground_under(all.points, all.normals, ball_, all.area_m2, table_height(scene));
  ground_ = renderer.add_mesh(drape_);
  arrow_shaft_ = renderer.add_mesh(unit_shaft());
  arrow_head_ = renderer.add_mesh(unit_head());
  marker_ = renderer.add_mesh(unit_ball());
  puff_ = renderer.add_mesh(Smoke::square());
}

Outline SceneView::outline() const {
  Outline all;
  for (const DrawnOrgan& organ : organs_) {
    const Outline of_organ = organ.drawing->outline();
    all.points.insert(all.points.end(), of_organ.points.begin(), of_organ.points.end());
    all.normals.insert(all.normals.end(), of_organ.normals.begin(), of_organ.normals.end());
    all.area_m2 += of_organ.area_m2;
  }
  return all;
}

void SceneView::shade_ground() {
  const auto wanders = [](const DrawnOrgan& organ) { return organ.drawing->wanders(); };
  if (scenery_.encloses() || std::ranges::none_of(organs_, wanders)) return;
  const Outline all = outline();
  render::shade_ground(all.points, all.normals, all.area_m2, kGroundSamples, drape_);
  renderer_.update_vertices(ground_, drape_.vertices);
}

void SceneView::deform(std::size_t organ, std::span<const float> values) {
  organs_[organ].drawing->deform(values);
  send_vertices(organs_[organ]);
}

void SceneView::send_vertices(DrawnOrgan& organ) {
  organ.stale = false;
  if (organ.tube) tubes_.send(*organ.tube);
  if (!organ.tube) renderer_.update_vertices(organ.mesh, organ.drawing->mesh().vertices);
  const std::vector<OrganPart> parts = organ.drawing->parts();
  for (std::size_t p = 0; p < parts.size(); ++p)
    renderer_.update_vertices(organ.parts[p], parts[p].mesh->vertices);
  if (organ.blood) renderer_.update_vertices(*organ.blood, organ.drawing->blood()->vertices);
}

bool SceneView::show(std::size_t organ, const RemovedSet& removed, std::span<const float> values,
                     std::span<const float> shares) {
  OrganDrawing& drawing = *organs_[organ].drawing;
  const CutOutcome outcome = drawing.cut(removed, values.size() / 3);
  if (outcome == CutOutcome::kMisfit) return false;
  organs_[organ].mapped = 3 * shares.size() == values.size() && drawing.map(shares);
  deform(organ, values);
  if (outcome == CutOutcome::kCut) {
    show_cut(organs_[organ]);
  } else if (const auto& bared = organs_[organ].bared) {
    renderer_.update_vertices(*bared, drawing.bared()->vertices);
  }
  return true;
}

void SceneView::forget_map() {
  for (DrawnOrgan& organ : organs_) organ.mapped = false;
}

Camera SceneView::first_camera() const {
  return start_camera(scene_.camera, ball_, viewing_direction(scene_), renderer_.size().aspect());
}

Camera SceneView::camera(const ViewChoices& choices, std::span<const ToolNow> tools) const {
  if (!choices.endoscope) return choices.orbit;
  if (const auto scope = scope_of(scene_); scope && tools[*scope].seen) {
    return scope_camera(tools[*scope].p_WT, tools[*scope].q_WT, *scene_.tools[*scope].scope);
  }
  Camera fixed = first_camera();
  if (scene_.camera.mode == "endoscope") return fixed;
  fixed.eye = fixed.target + kScopeDistance * (fixed.eye - fixed.target);
  fixed.field_of_view_deg = scene::ScopeSpec{}.field_of_view_deg;
  return fixed;
}

Frame SceneView::frame(const ViewChoices& choices, std::span<const ToolNow> tools, double panel_share) const {
  Frame frame = frame_from(camera(choices, tools), choices, tools, panel_share);
  frame.through_endoscope = choices.endoscope;
  // inside of a body the drape is the backdrop
  if (choices.endoscope)
    std::erase_if(frame.items, [](const DrawItem& i) { return i.look == Look::kGround; });
  if (choices.endoscope) frame.lighting = scope_light(camera(choices, tools), shadow_ball());
  smoke_.draw(frame.view.eye, puff_, frame.items);
  return frame;
}

Frame SceneView::close_up(const Dent& dent, const ViewChoices& choices,
                          std::span<const ToolNow> tools) const {
  std::vector<Shaft> shafts;
  for (const ToolNow& tool : tools) {
    if (tool.seen) shafts.push_back({tool.p_WT, tool.q_WT * Vec3::UnitZ()});
  }
  ViewChoices near = choices;
  near.markers = near.arrows = near.wires = false;  // they would cover the dent
  std::vector<const MeshData*> meshes;
  for (const DrawnOrgan& organ : organs_) {
    const std::vector<const MeshData*> of_organ = meshes_of(*organ.drawing);
    meshes.insert(meshes.end(), of_organ.begin(), of_organ.end());
  }
  const Camera camera =
      close_up_of(dent, meshes, shafts, choices.orbit, drape_.vertices.front().position.z());
  Frame frame = frame_from(camera, near, tools, 0);
  frame.lighting = rake_light(camera, shadow_ball());
  frame.with_panel = false;
  return frame;
}

const PressedSurface* SceneView::touched_surface(const ToolNow& tool) const {
  return tool.contact_organ < organs_.size() ? surface(tool.contact_organ) : nullptr;
}

std::optional<Dent> SceneView::dent_of(const ToolNow& tool) const {
  const PressedSurface* const touched = touched_surface(tool);
  if (!tool.seen || touched == nullptr) return std::nullopt;
  std::vector<PressedNode> pressed;
  for (std::size_t i = 0; i < std::min(tool.contact_nodes.size(), tool.contact_forces_n.size()); ++i) {
    const auto node = touched->node(tool.contact_nodes[i]);
    if (node.valid()) pressed.push_back({node, tool.contact_forces_n[i]});
  }
  return measure_dent(touched->skin, pressed);
}

Ball SceneView::shadow_ball() const {
  return {ball_.centre, kShadowReach * ball_.radius};
}

Frame SceneView::frame_from(const Camera& from, const ViewChoices& choices, std::span<const ToolNow> tools,
                            double panel_share) const {
  Frame frame;
  frame.view = view_of(from, ball_, renderer_.size().aspect(), panel_share / 2);
  frame.lighting = light_scene(from, shadow_ball());
  frame.middle = static_cast<float>(0.5 + panel_share / 2);
  frame.wires = choices.wires;
  if (!scenery_.encloses()) frame.items.push_back({ground_, Look::kGround, Mat4f::Identity(), kDrape});
  scenery_.draw(frame.items);
  for (const DrawnOrgan& organ : organs_) add_organ(organ, choices, frame);
  for (std::size_t t = 0; t < tools.size(); ++t) {
    if (!tools[t].seen) continue;
    // who looks through a scope does not see it
    if (!choices.endoscope || !scene_.tools[t].scope) add_instrument(t, tools[t], frame.items);
    if (choices.arrows) add_arrow(t, tools[t], frame.items);
    if (choices.markers) add_markers(t, tools[t], frame.items);
  }
  return frame;
}

void SceneView::add_organ(const DrawnOrgan& organ, const ViewChoices& choices, Frame& frame) const {
  const OrganDrawing& drawing = *organ.drawing;
  const bool is_map = choices.map != TissueMap::kOff && organ.mapped;
  const auto add = [&](MeshId mesh, Look look, const Material& material) {
    frame.items.push_back({mesh, is_map ? Look::kMap : look, Mat4f::Identity(), material});
  };
  if (organ.tube) frame.tubes.push_back(tubes_.item(*organ.tube, is_map, choices.folds, drawing.material()));
  const bool is_cut = organ.bared && drawing.removed_count() > 0;
  if (!organ.tube) add(organ.mesh, is_cut ? Look::kCut : drawing.look(), drawing.material());
  if (is_cut) add(*organ.bared, Look::kBared, drawing.bared_material());
  if (is_cut && organ.blood && !is_map) add(*organ.blood, Look::kBlood, blood_material());
  const std::vector<OrganPart> parts = drawing.parts();
  for (std::size_t p = 0; p < parts.size(); ++p) add(organ.parts[p], parts[p].look, parts[p].material);
}

void SceneView::add_instrument(std::size_t tool, const ToolNow& now, std::vector<DrawItem>& items) const {
  for (const auto& [part, mesh] : instruments_[tool]) {
    DrawItem& item = items.emplace_back(
        DrawItem{mesh, Look::kSolid, part_pose(part, now.p_WT, now.q_WT, now.grip_rad), part.material});
    if (now.cuts) item.material.glow += part.glow_cutting;
  }
}

void SceneView::add_arrow(std::size_t tool, const ToolNow& now, std::vector<DrawItem>& items) const {
  const double force = now.force_n.norm();
  if (!(force >= kLeastArrow_n)) return;
  const Vec3 direction = now.force_n / force;
  const double length = std::min(force * kArrowMetresPerNewton, kLongestArrow_m);
  const double head = std::min(kHeadLength_m, 0.6 * length), shaft = length - head;
  const double scale = head / kHeadLength_m;  // a weak force has a small arrow, not a squashed one
  const Material material = signal_material(scene_.tools[tool].id);
  items.push_back(
      {arrow_shaft_, Look::kSignal, placed(now.p_WT, direction, scale * kArrowRadius_m, shaft), material});
  items.push_back({arrow_head_, Look::kSignal,
                   placed(now.p_WT + shaft * direction, direction, scale * kHeadRadius_m, head), material});
}

void SceneView::add_markers(std::size_t tool, const ToolNow& now, std::vector<DrawItem>& items) const {
  const PressedSurface* const touched = touched_surface(now);
  if (touched == nullptr) return;
  for (const std::uint32_t node : now.contact_nodes) {
    const geometry::SurfaceId surface_node = touched->node(node);
    if (!surface_node.valid()) continue;
    const Vec3 at = touched->skin.position(surface_node).cast<double>();
    items.push_back({marker_, Look::kSignal, placed(at, Vec3::UnitZ(), kMarkerRadius_m, kMarkerRadius_m),
                     signal_material(scene_.tools[tool].id)});
  }
}

}  // namespace omentum::render
