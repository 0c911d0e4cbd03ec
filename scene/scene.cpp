#include "scene/scene.h"

#include "messages/common.h"
#include "scene/camera_keys.h"
#include "scene/device_keys.h"
#include "scene/dynamics_keys.h"
#include "scene/hand_way_keys.h"
#include "scene/intestine_keys.h"
#include "scene/organ_mesh_keys.h"
#include "scene/scenery_keys.h"
#include "scene/scope_keys.h"
#include "scene/score_keys.h"
#include "scene/toml_section.h"

#include <algorithm>
#include <cctype>
#include <string>
#include <string_view>

namespace omentum::scene {
namespace {

using enum TomlSection::Need;

constexpr Range kPoisson{.minimum = -1, .maximum = 0.5, .above = true, .below = true};

// A scene may make force safety stricter or suit it to a device; it must not disarm it.
// The strongest table-top devices give 40 N and some N m at the handle: more is a wrong unit.
constexpr Range kMaxForce_n{.minimum = 0, .maximum = 50, .above = true};
constexpr Range kMaxTorque_nm{.minimum = 0, .maximum = 5, .above = true};
// Above 5 N in a tick of 1 ms nothing is left of a limit of 10 N that is approached gently.
constexpr Range kSlew_n_s{.minimum = 0, .maximum = 5000, .above = true};
// Fading in faster is a blow to a hand that engages inside an organ; slower than 10 s looks like a dead
// device.
constexpr Range kRamp_s{.minimum = 0.02, .maximum = 10};
// Longer than haptic_node grants the slowest device (kLongestStale_s) a hand is driven by no measurement.
constexpr Range kStale_s{.minimum = 0, .maximum = 0.025, .above = true};
// Faster is a blow, slower pushes a hand that has let go, or whose device is dead.
constexpr Range kDecay_s{.minimum = 0.002, .maximum = 0.05};

// Less does not lift a fold of gut; more tears any tissue before it slips.
constexpr Range kGrip_n{.minimum = 0.1, .maximum = 50};

// No instrument's edge is longer: more is a wrong unit.
constexpr double kLongestEdge_m = 0.2;

void read_model(TomlSection& s, OrganSpec& organ) {
  std::vector<std::string> words;
  for (const OrganModelWord& model : kOrganModels) words.emplace_back(model.word);
  s.read_word("model", organ.model, kOptional, words);
  const OrganModelWord& chosen = *std::ranges::find(kOrganModels, organ.model, &OrganModelWord::word);
  organ.kind = chosen.kind;
  if (chosen.kind == OrganKind::kTube) {
    organ.intestine = read_intestine(s);
    organ.look = "gut";
  } else if (chosen.feel == Feel::kLocalModels) {
    organ.dynamics = read_dynamics(s, organ.model);
  }
}

RegionSpec read_region(TomlSection& s, bool tears) {
  RegionSpec region;
  s.read("label", region.label);
  s.read("box", region.box, 6);
  s.read("ball", region.ball, 4);
  s.read("young_pa", region.young_pa, kPositive);
  s.read("poisson", region.poisson, kPoisson);
  s.read("density_kg_m3", region.density_kg_m3, kPositive);
  if (tears) region.tears = read_tears(s);
  s.refuse_unknown_keys();
  if (region.label.has_value() + !region.box.empty() + !region.ball.empty() != 1)
    s.refuse("label", "none or several of label, box and ball", "one of them");
  if (!region.ball.empty() && !(region.ball[3] > 0))
    s.refuse("ball", "a radius of " + std::to_string(region.ball[3]), "one above 0");
  if (!region.young_pa && !region.poisson && !region.density_kg_m3)
    s.refuse("young_pa", "nothing, nor poisson or density_kg_m3",
             "what of the material differs from the organ's");
  return region;
}

// Nodes tell each other a rule in one line, "organs[N].fixed = " before it.
void read_supports(TomlSection& s, OrganSpec& organ) {
  constexpr std::size_t kMost = msg::MAX_LINE - 18;
  s.read("fixed", organ.fixed, kRequired);
  const bool is_rule = organ.fixed.starts_with("plane:") || organ.fixed.starts_with("box:");
  if (is_rule && organ.fixed.size() > kMost)
    s.refuse("fixed", std::to_string(organ.fixed.size()) + " characters",
             "at most " + std::to_string(kMost) + ", or a file");
}

void refuse_what_is_built(TomlSection& s) {
  for (const char* key : {"metres_per_unit", "fixed", "dynamic", "dynamic_mesh"})
    if (s.has(key)) s.refuse(key, "one beside an organ file", "none: the file is built with its own");
}

void read_mesh(TomlSection& s, const std::filesystem::path& scene, OrganSpec& organ) {
  std::string file;
  s.read("mesh", organ.mesh, kRequired);
  if (is_organ_file(organ.mesh)) {
    refuse_what_is_built(s);
  } else {
    s.read("metres_per_unit", organ.metres_per_unit, kOptional, kPositive);
    read_supports(s, organ);
    if (organ.model == "hybrid") read_dynamic_part(s, scene, *organ.dynamics);
    if (organ.model == "hybrid-cut") s.read("dynamic", organ.dynamics->dynamic_part, kRequired);
  }
  // a scene that is prepared names the file, and says what that is of
  const TomlSection::Need need = is_organ_file(organ.mesh) && !s.has("file") ? kOptional : kRequired;
  s.read("young_pa", organ.young_pa, need, kPositive);
  s.read("poisson", organ.poisson, need, kPoisson);
  s.read("density_kg_m3", organ.density_kg_m3, need, kPositive);
  s.read("file", file, kOptional);
  for (TomlSection& region : s.sections("regions"))
    organ.regions.push_back(read_region(region, organ.dynamics && has_masses(organ.model)));
  s.read_word("look", organ.look, kOptional, {"liver", "gallbladder", "colon"});
  organ.mesh = mesh_named(s, "mesh", organ.mesh, scene);
  if (!file.empty()) organ.file = beside(scene, file);
}

OrganSpec read_organ(TomlSection& s, const std::filesystem::path& scene) {
  OrganSpec organ;
  s.read("name", organ.name, kRequired);
  read_model(s, organ);
  if (organ.kind == OrganKind::kTetrahedralMesh) read_mesh(s, scene, organ);
  s.refuse_unknown_keys();
  return organ;
}

// What cuts, and where it does: both keys or none.
void read_edge(TomlSection& s, ToolSpec& tool) {
  bool cuts = false;
  s.read("cuts", cuts, kOptional);
  s.read("edge", tool.edge, cuts ? kRequired : kOptional);
  if (!cuts && s.has("edge"))
    s.refuse("edge", "an edge of a tool that does not cut", "cuts = true beside it");
  if (!cuts) return;
  if (tool.edge.size() != 2)
    s.refuse("edge", std::to_string(tool.edge.size()) + " points", "two, its begin and end");
  const double length_m = (tool.edge[1] - tool.edge[0]).norm();
  if (!(length_m > 0 && length_m <= kLongestEdge_m))
    s.refuse("edge", "an edge of " + std::to_string(length_m) + " m",
             "one above 0 and up to " + std::to_string(kLongestEdge_m) + " m");
}

ToolSpec read_tool(TomlSection& s) {
  ToolSpec tool;
  s.read("id", tool.id, kRequired, msg::MAX_TOOLS - 1);
  s.read("name", tool.name, kRequired);
  s.read_word("shape", tool.shape, kRequired, {"probe", "grasper", kScopeShape});
  read_device(s, tool);
  read_points_or_scope(s, tool);
  s.read("shaft_radius_m", tool.shaft_radius_m, kOptional, kPositive);
  s.read("shaft_length_m", tool.shaft_length_m, kOptional, kPositive);
  s.read("trocar", tool.trocar);
  if (tool.shape == "grasper") s.read("grip_force_n", tool.grip_force_n, kOptional, kGrip_n);
  read_edge(s, tool);
  s.refuse_unknown_keys();
  return tool;
}

void read_press(TomlSection& s, HandSpec& hand) {
  s.read("press_point", hand.press_point, kRequired);
  s.read_direction("press_normal", hand.press_normal, kRequired);
  s.read_direction("slide_direction", hand.slide_direction, kOptional);
  s.read("hover_m", hand.hover_m, kOptional, kPositive);
  s.read("depth_m", hand.depth_m, kOptional, kNotNegative);
  s.read("slide_m", hand.slide_m, kOptional, kNotNegative);
  s.read("start_s", hand.start_s, kOptional, kNotNegative);
  s.read("approach_s", hand.approach_s, kOptional, kPositive);
  s.read("press_s", hand.press_s, kOptional, kPositive);
  s.read("hold_s", hand.hold_s, kOptional, kNotNegative);
  s.read("slide_s", hand.slide_s, kOptional, kPositive);
  s.read("release_s", hand.release_s, kOptional, kPositive);
}

HandSpec read_hand(TomlSection& s) {
  HandSpec hand;
  s.read("tool", hand.tool, kRequired, msg::MAX_TOOLS - 1);
  s.read("organ", hand.organ, kOptional);
  s.read("mass_kg", hand.mass_kg, kOptional, kPositive);
  s.read("stiffness_n_m", hand.stiffness_n_m, kOptional, kPositive);
  s.read("damping_n_s_m", hand.damping_n_s_m, kOptional, kNotNegative);
  hand.way = read_way(s);
  s.read("cut", hand.cut, kOptional);
  if (hand.way.empty()) {
    read_press(s, hand);
  } else {
    hand.press_point = hand.way.front().to;
  }
  s.refuse_unknown_keys();
  return hand;
}

HapticsSpec read_haptics(TomlSection s) {
  HapticsSpec haptics;
  s.read("friction", haptics.friction, kOptional, kNotNegative);
  s.read_word("contact", haptics.contact, kOptional, {"point", "spread"});
  s.read("max_force_n", haptics.max_force_n, kOptional, kMaxForce_n);
  s.read("max_torque_nm", haptics.max_torque_nm, kOptional, kMaxTorque_nm);
  s.read("max_slew_n_s", haptics.max_slew_n_s, kOptional, kSlew_n_s);
  s.read("ramp_s", haptics.ramp_s, kOptional, kRamp_s);
  s.read("stale_s", haptics.stale_s, kOptional, kStale_s);
  s.read("decay_s", haptics.decay_s, kOptional, kDecay_s);
  s.refuse_unknown_keys();
  // the paper's spread imposes three whole displacements: what sticks there sticks without a limit, as glue
  // does
  if (haptics.contact == "spread" && haptics.friction > 0)
    s.refuse("friction", "friction with contact = \"spread\"", "0, or contact = \"point\"");
  return haptics;
}

void refuse_repeated_organs(const Scene& scene, std::vector<TomlSection>& sections) {
  for (std::size_t i = 0; i < scene.organs.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (scene.organs[i].name != scene.organs[j].name) continue;
      sections[i].refuse("name", "\"" + scene.organs[i].name + "\" again", "another name for each organ");
    }
  }
}

void refuse_repeated_tools(const Scene& scene, std::vector<TomlSection>& sections) {
  for (std::size_t i = 0; i < scene.tools.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (scene.tools[i].id != scene.tools[j].id) continue;
      sections[i].refuse("id", std::to_string(scene.tools[i].id) + " again", "another id for each tool");
    }
  }
}

void refuse_wrong_hands(const Scene& scene, std::vector<TomlSection>& sections) {
  for (std::size_t i = 0; i < scene.hands.size(); ++i) {
    const std::uint32_t id = scene.hands[i].tool;
    const auto is_tool = [id](const ToolSpec& tool) { return tool.id == id; };
    const auto is_hand = [id](const HandSpec& hand) { return hand.tool == id; };
    const auto tool = std::ranges::find_if(scene.tools, is_tool);
    if (tool == scene.tools.end())
      sections[i].refuse("tool", std::to_string(id), "the id of one of the [[tools]]");
    if (scene.hands[i].cut && tool->edge.empty())
      sections[i].refuse("cut", "true with a tool that does not cut", "a tool with cuts = true");
    if (std::any_of(scene.hands.begin(), scene.hands.begin() + static_cast<std::ptrdiff_t>(i), is_hand)) {
      sections[i].refuse("tool", std::to_string(id) + " again", "another tool for each hand");
    }
  }
}

// A hand that names no organ presses the first one.
void find_pressed_organs(Scene& scene, std::vector<TomlSection>& sections) {
  for (std::size_t i = 0; i < scene.hands.size(); ++i) {
    std::string& pressed = scene.hands[i].organ;
    if (pressed.empty()) pressed = scene.organs.front().name;
    const auto is_pressed = [&](const OrganSpec& organ) { return organ.name == pressed; };
    if (std::ranges::none_of(scene.organs, is_pressed))
      sections[i].refuse("organ", "\"" + pressed + "\"", "the name of one of the [[organs]]");
  }
}

void give_to_intestines(const TomlSection& root, const std::vector<ObstacleSpec>& obstacles,
                        std::vector<OrganSpec>& organs) {
  bool given = false;
  for (OrganSpec& organ : organs)
    if (organ.intestine) organ.intestine->obstacles = obstacles, given = true;
  refuse_wrong_obstacles(root, obstacles.size(), given);
}

void refuse_wrong_count(const TomlSection& root, const std::string& key, std::size_t count,
                        std::size_t most) {
  if (count >= 1 && count <= most) return;
  root.refuse(key, std::to_string(count), "1 to " + std::to_string(most) + " of [[" + key + "]]");
}

}  // namespace

bool is_organ_file(const std::string& mesh) {
  std::string ending = std::filesystem::path(mesh).extension();
  std::ranges::transform(ending, ending.begin(), [](unsigned char c) { return std::tolower(c); });
  return ending == ".h5";
}

Scene load_scene(const std::filesystem::path& file) {
  TomlSection root = open_toml(file);
  Scene scene;
  scene.file = file;
  root.read("name", scene.name, kRequired);
  auto organs = root.sections("organs");
  auto obstacles = root.sections("obstacles");
  auto tools = root.sections("tools");
  auto hands = root.sections("hands");
  const bool has_camera = root.has("camera");
  scene.haptics = read_haptics(root.section("haptics"));
  scene.camera = read_camera(root.section("camera"), has_camera);
  scene.scenery = read_scenery(root.sections("scenery"), file);
  TomlSection score = root.section("score");
  root.refuse_unknown_keys();

  for (TomlSection& s : organs) scene.organs.push_back(read_organ(s, file));
  for (TomlSection& s : obstacles) scene.obstacles.push_back(read_obstacle(s));
  give_to_intestines(root, scene.obstacles, scene.organs);
  for (TomlSection& s : tools) scene.tools.push_back(read_tool(s));
  for (TomlSection& s : hands) scene.hands.push_back(read_hand(s));
  refuse_wrong_count(root, "organs", organs.size(), msg::MAX_ORGANS);
  refuse_wrong_count(root, "tools", tools.size(), msg::MAX_TOOLS);
  refuse_repeated_organs(scene, organs);
  refuse_repeated_tools(scene, tools);
  refuse_second_scope(scene.tools, tools);
  refuse_wrong_hands(scene, hands);
  find_pressed_organs(scene, hands);
  scene.score = read_score(std::move(score), scene.organs, scene.tools);
  return scene;
}

}  // namespace omentum::scene
