// A scene as data: which organ, which tools, which hands, how it is looked at. TOML files in scenes/.
#pragma once

#include "geometry/types.h"
#include "scene/camera_score_spec.h"
#include "scene/dynamics_spec.h"
#include "scene/intestine_spec.h"
#include "scene/scenery_spec.h"
#include "scene/scope_spec.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace omentum::scene {

using geometry::Vec3;

/// What an organ consists of: how it is loaded, touched and drawn. How it moves is its model's affair.
enum class OrganKind : std::uint8_t {
  kTetrahedralMesh,  // of a file
  kTube,             // an intestine and its mesentery, made from the scene's numbers
};

/// How a hand knows what an organ answers.
enum class Feel : std::uint8_t {
  kTensors,      // haptic_node has its precomputed tensors
  kLocalModels,  // deform_node tells of the surface around each tool, again and again
};

/// Where a model's law is tissue's: what has to be small for it.
enum class Trusted : std::uint8_t {
  kSmallDisplacements,  // beside the organ's size: the law is linear in them
  kSmallStrains,        // however far tissue is moved and turned
  kAlways,              // its springs are what they are at any length: there is no law to leave
};

/// A model that a scene may choose for an organ, the kind of organ that it moves, and how that is felt.
struct OrganModelWord {
  std::string_view word;
  OrganKind kind;
  Feel feel = Feel::kTensors;
  Trusted trusted = Trusted::kSmallDisplacements;
};
inline constexpr std::array kOrganModels{
    OrganModelWord{"quasi-static", OrganKind::kTetrahedralMesh},
    OrganModelWord{"quasi-static-cut", OrganKind::kTetrahedralMesh, Feel::kLocalModels},
    OrganModelWord{"tensor-mass", OrganKind::kTetrahedralMesh, Feel::kLocalModels},
    OrganModelWord{"corotational", OrganKind::kTetrahedralMesh, Feel::kLocalModels, Trusted::kSmallStrains},
    OrganModelWord{"spring-mass", OrganKind::kTetrahedralMesh, Feel::kLocalModels, Trusted::kSmallStrains},
    OrganModelWord{"hybrid", OrganKind::kTetrahedralMesh, Feel::kLocalModels},
    OrganModelWord{"hybrid-cut", OrganKind::kTetrahedralMesh, Feel::kLocalModels},
    OrganModelWord{"intestine", OrganKind::kTube, Feel::kLocalModels, Trusted::kAlways},
};

/// A part of an organ that is of another material: at one of label, box and ball; what is absent of the
/// material is the organ's (organ_build --region).
struct RegionSpec {
  std::optional<std::int32_t> label;  // that the mesh file gives tetrahedra
  std::vector<double> box;            // x0, y0, z0, x1, y1, z1, m; or empty
  std::vector<double> ball;           // x, y, z, radius, m; or empty
  std::optional<double> young_pa, poisson, density_kg_m3;
  TearSpec tears;
};

/// An organ as the scene describes it: enough to build its file, or a built file; of a tube its anatomy, and
/// no file at all.
struct OrganSpec {
  std::string name;
  std::string model{kOrganModels.front().word};
  OrganKind kind = kOrganModels.front().kind;  // the model's
  std::string
      mesh;  // a mesh or organ file (relative to the scene), or "phantom:..." (scene.cpp has the words)
  double metres_per_unit = 1;
  // 0, all or some: what the mesh, an organ file, was built of (scene_prepare fills it in)
  double young_pa = 0, poisson = 0, density_kg_m3 = 0;
  std::vector<RegionSpec> regions;         // of several that overlap the last one holds
  std::string fixed;                       // as organ_build --fixed takes it; of an organ file empty
  std::string look = "liver";              // "liver", "gallbladder" or "colon"; of a tube "gut"
  std::optional<DynamicsSpec> dynamics;    // of a mesh whose model moves it by itself, or that is cut
  std::optional<IntestineSpec> intestine;  // of a tube
  std::filesystem::path file;  // the organ file (.h5); the launcher fills it in, --organ overrides it
};

/// Whether an OrganSpec's mesh is a built organ, which has its material, supports and metres.
bool is_organ_file(const std::string& mesh);

/// From the tip of a grasper to where its jaws turn, m, as a 5 mm dissector's: the picture's and the hand's.
inline constexpr double kJawLength_m = 0.018;
/// The pull that jaws hold where a scene says nothing, N. Jaws are chosen to hold bowel that is pulled by 5 N
/// without marking it (Heijnsdijk, de Visser, Dankelman and Gouma, Slip and damage properties of jaws of
/// laparoscopic graspers, Surg Endosc 18, 2004); tissue slips out above that, by about a half.
inline constexpr double kGripForce_n = 8;

/// An instrument. Collision sees it as points in its own frame T (origin at the tip, z from the tip to the
/// handle).
struct ToolSpec {
  std::uint32_t id = 0;
  std::string name;
  std::string shape;  // "probe", "grasper" or "endoscope": how it is drawn, and whether it has jaws or optics
  std::vector<Vec3> points;  // [P] p_TP, m; of an endoscope none
  double shaft_radius_m = 0.0025, shaft_length_m = 0.3;
  double grip_force_n = kGripForce_n;  // tissue that pulls harder slips out of the jaws
  std::optional<Vec3> trocar;      // pivot in W, m: five degrees of freedom (pivot, insertion, roll, grip)
  std::optional<ScopeSpec> scope;  // of an endoscope
  std::vector<Vec3> edge;  // begin and end of what cuts while its button is pressed, in T, m; or empty
  std::string device;      // the name of that which has it before all others; empty: the first one has it
};

/// A place that a simulated hand goes to.
struct HandWaypoint {
  Vec3 to = Vec3::Zero();  // of the tip, in W, m
  double seconds = 1;      // from the waypoint before; of the first one, from the last
  double grip_rad = 0;     // how far its jaws are open there; 0: closed
  double roll_rad = 0;     // about the shaft there, from where a hand holds it by itself
};

/// A simulated hand: a mass on a spring and damper to a target that moves along a script: it presses an organ
/// at one place, or it goes along waypoints.
struct HandSpec {
  std::uint32_t tool = 0;
  std::string organ;  // the name of that which it presses
  double mass_kg = 0.2, stiffness_n_m = 400, damping_n_s_m = 12;
  Vec3 press_point = Vec3::Zero();       // on the rest surface, in W, m
  Vec3 press_normal = Vec3::UnitZ();     // outward, unit
  Vec3 slide_direction = Vec3::UnitX();  // along the surface, unit
  double hover_m = 0.03;                 // start this far above
  double depth_m = 0.01;                 // the target goes this far below the rest surface (0: hovers only)
  double slide_m = 0.03;
  bool cut = false;  // presses the tool's button while it slides
  double start_s = 1, approach_s = 2, press_s = 1.5, hold_s = 2, slide_s = 3, release_s = 1.5;  // then again
  std::vector<HandWaypoint> way;  // instead of all that from press_point on, which is the first of them
};

/// How contacts answer, and the scene's part of force safety. The limits have bounds of their own
/// (scene.cpp): no scene disarms them.
struct HapticsSpec {
  double friction = 0;            // Coulomb coefficient; 0 is frictionless; needs contact = "point"
  std::string contact = "point";  // "point" (continuous point constraint) or "spread" (Cotin 1999's alpha_v)
  double max_force_n = 10;        // the scene's own limits, below any device's
  double max_torque_nm = 0.5;
  double max_slew_n_s = 2000;
  double ramp_s = 0.2;     // fading in after engage and reconnect
  double stale_s = 0.005;  // a pose older than this (or 2.5 intervals of a slower device) ...
  double decay_s = 0.02;   // ... decays the force to zero within this
};

struct CameraSpec {
  std::string mode = "orbit";  // "orbit" or "endoscope"
  Vec3 eye = Vec3::Zero(), target = Vec3::Zero(), up = Vec3::UnitZ();
  double field_of_view_deg = 40;
};

/// Of the planned cut, m, and the pull that may not be passed, N (docs/score.md says why).
inline constexpr double kLineWidth_m = 0.005, kPullLimit_n = 5;

/// What a trainee is measured by (docs/score.md).
struct ScoreSpec {
  std::string exposed_organ{};  // its name: the share of it that nothing hides is told; empty: none
  double from_s = 0;  // since render_node began: what is seen earlier, while organs settle, does not count
  std::string line_of{};                    // the name of the organ that is to be cut; empty: none
  std::vector<Vec3> planned_line{};         // [2 or more] along which, in W, m, the organ at rest; or empty
  double line_width_m = kLineWidth_m;       // what is removed farther from the line's cut lies outside of it
  double pull_limit_n = kPullLimit_n;       // a pull that is stronger counts
  std::optional<CameraScoreSpec> camera{};  // who holds the endoscope
};

struct Scene {
  std::string name;
  std::filesystem::path file;
  std::vector<OrganSpec> organs;
  std::vector<ObstacleSpec> obstacles;  // of intestines
  std::vector<ScenerySpec> scenery;
  std::vector<ToolSpec> tools;
  std::vector<HandSpec> hands;
  HapticsSpec haptics;
  CameraSpec camera;
  ScoreSpec score;
};

/// Reads and checks a scene. Throws std::runtime_error "FILE:LINE: key: found ..., expected ..." for a
/// missing file, a syntax error, an unknown key (named, so that a typing error does not pass), a missing or
/// wrong value.
Scene load_scene(const std::filesystem::path& file);

}  // namespace omentum::scene
