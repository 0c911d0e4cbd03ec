#include "organ_tools/scene_prepare/scene_fit.h"

#include "geometry/rotation.h"
#include "organ_tools/scene_prepare/press_sites.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

namespace omentum::scene_prepare {

namespace {

/// Pressed deeper than this part of the organ's thickness, a linear model looks wrong.
constexpr double kDepthShare = 0.25;
/// A slide takes at most this part of the organ's diagonal.
constexpr double kSlideShare = 0.2;
/// How much of the picture's height the organ's bounding sphere fills.
constexpr double kFill = 0.9;

/// Rotation and translation that take the scene's press point and normal to the organ's.
Eigen::Isometry3d carry(const scene::HandSpec& from, const PressSite& to) {
  const auto R = geometry::rotation_onto(from.press_normal, to.normal);
  return Eigen::Translation3d(to.point) * R * Eigen::Translation3d(-from.press_point);
}

void set_site(scene::HandSpec& hand, const PressSite& site) {
  hand.press_point = site.point;
  hand.press_normal = site.normal;
  hand.slide_direction = site.slide;
}

void move_trocar(scene::Scene& scene, std::uint32_t tool, const Eigen::Isometry3d& motion) {
  for (scene::ToolSpec& spec : scene.tools)
    if (spec.id == tool && spec.trocar) spec.trocar = motion * *spec.trocar;
}

/// Looks at the organ from the side that the scene chose, far enough to see it whole.
void move_camera(const OrganSkin& skin, scene::CameraSpec& camera, const Eigen::Isometry3d& motion) {
  const Vec3 view = camera.eye - camera.target;
  if (camera.mode == "endoscope" || view.norm() == 0) {
    camera.eye = motion * camera.eye;
    camera.target = motion * camera.target;
    return;
  }
  const double half_angle = camera.field_of_view_deg * std::numbers::pi / 360;
  const double distance = skin.diagonal() / 2 / (kFill * std::tan(half_angle));
  camera.target = skin.centre();
  camera.eye = skin.centre() + distance * view.normalized();
}

std::string shrunk(const scene::HandSpec& hand, const char* what, double from_m, double to_m) {
  char line[160];
  std::snprintf(line, sizeof line, "hand of tool %u: %s %.1f mm instead of %.1f mm on this organ", hand.tool,
                what, 1e3 * to_m, 1e3 * from_m);
  return line;
}

std::vector<scene::HandSpec*> hands_on(std::size_t organ, scene::Scene& scene) {
  std::vector<scene::HandSpec*> hands;
  for (scene::HandSpec& hand : scene.hands)
    if (hand.organ == scene.organs[organ].name) hands.push_back(&hand);
  return hands;
}

std::vector<double> shorten_slides(const std::vector<scene::HandSpec*>& hands, double longest_m,
                                   std::vector<std::string>& notes) {
  std::vector<double> slides;
  for (scene::HandSpec* hand : hands) {
    const double slide = std::min(hand->slide_m, longest_m);
    if (slide < hand->slide_m) notes.push_back(shrunk(*hand, "slides", hand->slide_m, slide));
    hand->slide_m = slide;
    slides.push_back(slide);
  }
  return slides;
}

std::vector<std::string> place_hands(const OrganSkin& skin, scene::Scene& scene) {
  std::vector<std::string> notes;
  const std::vector<scene::HandSpec*> hands = hands_on(0, scene);
  const std::vector<double> slides = shorten_slides(hands, kSlideShare * skin.diagonal(), notes);
  const std::vector<PressSite> sites = choose_press_sites(skin, slides);
  Eigen::Isometry3d first = Eigen::Isometry3d::Identity();
  for (std::size_t i = 0; i < sites.size(); ++i) {
    scene::HandSpec& hand = *hands[i];
    const Eigen::Isometry3d motion = carry(hand, sites[i]);
    if (i == 0) first = motion;
    move_trocar(scene, hand.tool, motion);
    set_site(hand, sites[i]);
    const double depth =
        std::min(hand.depth_m, kDepthShare * skin.thickness({sites[i].point, sites[i].normal}));
    if (depth < hand.depth_m) notes.push_back(shrunk(hand, "presses", hand.depth_m, depth));
    hand.depth_m = depth;
  }
  move_camera(skin, scene.camera, first);
  return notes;
}

void name_after(const std::string& organ, scene::Scene& scene) {
  for (std::size_t i = 1; i < scene.organs.size(); ++i) {
    if (scene.organs[i].name != organ) continue;
    throw geometry::InputError(scene.organs.front().file.string() + ": found an organ called \"" + organ +
                               "\" as another one of the scene, expected another name (organ_build --name)");
  }
  for (scene::HandSpec* hand : hands_on(0, scene)) hand->organ = organ;
  scene.organs.front().name = organ;
  scene.name = scene.hands.empty() ? organ : organ + " pressed by a simulated hand";
}

}  // namespace

void project_hands(const OrganSkin& skin, std::size_t organ, scene::Scene& scene) {
  for (scene::HandSpec* hand : hands_on(organ, scene)) {
    const SkinPoint at = skin.closest(hand->press_point);
    Vec3 slide = hand->slide_direction;
    slide -= slide.dot(at.normal) * at.normal;
    if (slide.norm() < 1e-6) slide = at.normal.unitOrthogonal();
    set_site(*hand, {at.position, at.normal, slide.normalized()});
  }
}

std::vector<std::string> replace_first(const std::string& name, const OrganSkin& skin, scene::Scene& scene) {
  scene::OrganSpec& first = scene.organs.front();
  first.mesh = first.file.string();
  std::vector<std::string> notes = place_hands(skin, scene);
  name_after(name, scene);
  scene.scenery.clear();  // it lies around the scene's own organ
  return notes;
}

namespace {

// Where the region with this label of the organ file tears: boxes and balls have the labels that no region
// names, in the scene's order (organ/region_spec.h). A file of other regions than the scene's says nothing.
scene::TearSpec tears_of(std::int32_t label, std::vector<scene::RegionSpec>& regions) {
  auto own = std::ranges::find(regions, std::optional(label), &scene::RegionSpec::label);
  if (own == regions.end())
    own = std::ranges::find(regions, std::optional<std::int32_t>(), &scene::RegionSpec::label);
  if (own == regions.end()) return {};
  own->label = label;
  return own->tears;
}

}  // namespace

void take_material(const physics::MaterialMap& material, scene::OrganSpec& organ) {
  organ.young_pa = material.common.young_pa;
  organ.poisson = material.common.poisson;
  organ.density_kg_m3 = material.common.density_kg_m3;
  std::vector<scene::RegionSpec> of_scene = std::move(organ.regions);
  if (of_scene.size() != material.regions.size()) of_scene.clear();
  organ.regions.clear();
  for (const auto& [label, own] : material.regions)
    organ.regions.push_back(
        {label, {}, {}, own.young_pa, own.poisson, own.density_kg_m3, tears_of(label, of_scene)});
}

}  // namespace omentum::scene_prepare
