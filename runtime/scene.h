// A scene as data: which organ, which tools, which hands, how it is looked at. TOML files in scenes/.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace omentum::runtime {

using Triple = std::array<double, 3>;

/// An organ as the scene describes it: enough to build its file, or a built file.
struct OrganSpec {
  std::string name;
  std::string
      mesh;  // a mesh or organ file (relative to the scene), or "phantom:..." (scene.cpp has the words)
  double metres_per_unit = 1;
  double young_pa = 0, poisson = 0, density_kg_m3 = 0;
  std::string fixed;           // as organ_build --fixed takes it
  std::string look = "liver";  // "liver" or "gallbladder": how it is drawn
  std::filesystem::path file;  // the organ file (.h5); the launcher fills it in, --organ overrides it
};

/// An instrument. Collision sees it as points in its own frame T (origin at the tip, z from the tip to the
/// handle).
struct ToolSpec {
  std::uint32_t id = 0;
  std::string name;
  std::string shape;           // "probe" or "grasper": how it is drawn
  std::vector<Triple> points;  // [P] p_TP, m
  double shaft_radius_m = 0.0025, shaft_length_m = 0.3;
  std::optional<Triple> trocar;  // pivot in W, m: five degrees of freedom (pivot, insertion, roll, grip)
};

/// A simulated hand: a mass on a spring and damper to a target that moves along a script.
struct HandSpec {
  std::uint32_t tool = 0;
  std::string organ;  // the name of that which it presses
  double mass_kg = 0.2, stiffness_n_m = 400, damping_n_s_m = 12;
  Triple press_point{};             // on the rest surface, in W, m
  Triple press_normal{0, 0, 1};     // outward, unit
  Triple slide_direction{1, 0, 0};  // along the surface, unit
  double hover_m = 0.03;            // start this far above
  double depth_m = 0.01;            // the target goes this far below the rest surface (0: hovers only)
  double slide_m = 0.03;
  double start_s = 1, approach_s = 2, press_s = 1.5, hold_s = 2, slide_s = 3, release_s = 1.5;  // then again
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
  Triple eye{}, target{}, up{0, 0, 1};
  double field_of_view_deg = 40;
};

struct Scene {
  std::string name;
  std::filesystem::path file;
  std::vector<OrganSpec> organs;
  std::vector<ToolSpec> tools;
  std::vector<HandSpec> hands;
  HapticsSpec haptics;
  CameraSpec camera;
};

/// Reads and checks a scene. Throws std::runtime_error "FILE:LINE: key: found ..., expected ..." for a
/// missing file, a syntax error, an unknown key (named, so that a typing error does not pass), a missing or
/// wrong value.
Scene load_scene(const std::filesystem::path& file);

}  // namespace omentum::runtime
