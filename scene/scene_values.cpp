#include "scene/scene_values.h"

#include "files/sha256.h"

#include <charconv>
#include <span>

namespace omentum::scene {
namespace {

std::string text_of(double number) {
  char digits[32];  // the shortest form of a double has at most 24
  return {digits, std::to_chars(digits, digits + sizeof(digits), number).ptr};
}

std::string text_of(bool value) {
  return value ? "true" : "false";
}

std::string text_of(std::uint32_t number) {
  return std::to_string(number);
}

std::string text_of(std::int32_t number) {
  return std::to_string(number);
}

std::string text_of(std::span<const double> numbers) {
  std::string text = "[";
  for (const double number : numbers) text.append(text.size() > 1 ? ", " : "").append(text_of(number));
  return text += ']';
}

std::string text_of(const Vec3& v) {
  return text_of(std::span(v.data(), 3));
}

std::string text_of(const std::string& text) {
  return printable(text);
}

template <class T>
std::string text_of(const std::optional<T>& value) {
  return value ? text_of(*value) : "none";
}

std::string supports_of(const OrganSpec& organ) {
  const bool is_rule = organ.fixed.starts_with("plane:") || organ.fixed.starts_with("box:");
  return is_rule ? organ.fixed : "a file";
}

/// The values of one table of the scene.
class Table {
 public:
  Table(std::string name, std::vector<std::string>& values) : name_(std::move(name)), values_(values) {}
  Table(const std::string& list, std::size_t index, std::vector<std::string>& values)
      : Table(list + "[" + std::to_string(index) + "]", values) {}

  template <class T>
  void add(const std::string& key, const T& value) {
    values_.push_back(name_ + "." + key + " = " + text_of(value));
  }

 private:
  std::string name_;
  std::vector<std::string>& values_;
};

void add(const TearSpec& tears, const std::string& of, Table& table) {
  table.add(of + "tear_volume_change", tears.volume_change);
  table.add(of + "tear_mean_elongation", tears.mean_elongation);
  table.add(of + "tear_edge_elongation", tears.edge_elongation);
  table.add(of + "tear_stress_pa", tears.stress_pa);
}

void add(const DynamicsSpec& dynamics, Table& table) {
  table.add("integrator", dynamics.integrator);
  table.add("step_s", dynamics.step_s);
  table.add("mass_damping_per_s", dynamics.mass_damping_per_s);
  table.add("stiffness_damping_s", dynamics.stiffness_damping_s);
  table.add("gravity_m_s2", dynamics.gravity_m_s2);
  add(dynamics.tears, "", table);
  table.add("cut_delay_s", dynamics.cut_delay_s);
  table.add("cut_rate_per_s", dynamics.cut_rate_per_s);
  table.add("smallest_piece_m3", dynamics.smallest_piece_m3);
  if (!dynamics.pieces.empty()) table.add("pieces", dynamics.pieces);
  if (dynamics.pieces == "fall") table.add("piece_gravity_m_s2", dynamics.piece_gravity_m_s2);
  if (!dynamics.law.empty()) table.add("law", dynamics.law);
}

void add(const geometry::GutAnatomy& anatomy, Table& table) {
  table.add("length_m", anatomy.length_m);
  table.add("tube_radius_m", anatomy.tube_radius_m);
  table.add("cylinder_radius_m", anatomy.cylinder_radius_m);
  table.add("vessel_length_m", anatomy.vessel_length_m);
  table.add("mesentery_thickness_m", anatomy.mesentery_thickness_m);
  table.add("fold_pitch_m", anatomy.fold_pitch_m);
  table.add("legs", anatomy.legs);
  table.add("rows", anatomy.rows);
  table.add("columns", anatomy.columns);
  table.add("origin", anatomy.origin);
  table.add("along", anatomy.along);
  table.add("up", anatomy.up);
}

void add(const GutMaterialSpec& material, Table& table) {
  table.add("gut_mass_kg_m", material.gut_mass_kg_m);
  table.add("gut_stretch_n", material.gut_stretch_n);
  table.add("gut_bending_n_m2", material.gut_bending_n_m2);
  table.add("mesentery_mass_kg_m2", material.mesentery_mass_kg_m2);
  table.add("mesentery_stretch_n_m", material.mesentery_stretch_n_m);
  table.add("spring_damping_s", material.spring_damping_s);
  table.add("calming_time_s", material.calming_time_s);
}

void add(const IntestineSpec& intestine, Table& table) {
  add(intestine.anatomy, table);
  add(intestine.material, table);
  table.add("method", intestine.method);
  table.add("step_s", intestine.step_s);
  table.add("gravity_m_s2", intestine.gravity_m_s2);
  table.add("collision", intestine.collision);
  table.add("seed", intestine.seed);
  table.add("friction", intestine.friction);
  table.add("wall_stiffness_n_m", intestine.wall_stiffness_n_m);
}

void add(const ObstacleSpec& obstacle, Table table) {
  table.add("shape", obstacle.shape);
  table.add("centre", obstacle.centre);
  table.add("normal", obstacle.normal);
  table.add("half_axes_m", obstacle.half_axes_m);
}

void add(const OrganSpec& organ, Table table) {
  table.add("name", organ.name);
  table.add("model", organ.model);
  if (organ.intestine) return add(*organ.intestine, table);
  table.add("young_pa", organ.young_pa);
  table.add("poisson", organ.poisson);
  table.add("density_kg_m3", organ.density_kg_m3);
  table.add("fixed", supports_of(organ));
  if (organ.dynamics) add(*organ.dynamics, table);
  for (std::size_t i = 0; i < organ.regions.size(); ++i) {
    const RegionSpec& region = organ.regions[i];
    const std::string of = "regions[" + std::to_string(i) + "].";
    table.add(of + "label", region.label);
    table.add(of + "box", region.box);
    table.add(of + "ball", region.ball);
    table.add(of + "young_pa", region.young_pa);
    table.add(of + "poisson", region.poisson);
    table.add(of + "density_kg_m3", region.density_kg_m3);
    if (organ.dynamics) add(region.tears, of, table);
  }
}

void add(const ToolSpec& tool, Table table) {
  table.add("id", tool.id);
  table.add("name", tool.name);
  table.add("shape", tool.shape);
  for (std::size_t i = 0; i < tool.points.size(); ++i)
    table.add("points[" + std::to_string(i) + "]", tool.points[i]);
  table.add("shaft_radius_m", tool.shaft_radius_m);
  table.add("shaft_length_m", tool.shaft_length_m);
  if (!tool.device.empty()) table.add("device", tool.device);
  if (tool.shape == "grasper") table.add("grip_force_n", tool.grip_force_n);
  table.add("trocar", tool.trocar);
  if (tool.scope) {
    table.add("optics_deg", tool.scope->optics_deg);
    table.add("field_of_view_deg", tool.scope->field_of_view_deg);
  }
  for (std::size_t i = 0; i < tool.edge.size(); ++i)
    table.add("edge[" + std::to_string(i) + "]", tool.edge[i]);
}

void add(const HandSpec& hand, Table table) {
  table.add("tool", hand.tool);
  table.add("organ", hand.organ);
  table.add("mass_kg", hand.mass_kg);
  table.add("stiffness_n_m", hand.stiffness_n_m);
  table.add("damping_n_s_m", hand.damping_n_s_m);
  table.add("press_point", hand.press_point);
  table.add("press_normal", hand.press_normal);
  table.add("slide_direction", hand.slide_direction);
  table.add("hover_m", hand.hover_m);
  table.add("depth_m", hand.depth_m);
  table.add("slide_m", hand.slide_m);
  table.add("cut", hand.cut);
  table.add("start_s", hand.start_s);
  table.add("approach_s", hand.approach_s);
  table.add("press_s", hand.press_s);
  table.add("hold_s", hand.hold_s);
  table.add("slide_s", hand.slide_s);
  table.add("release_s", hand.release_s);
  for (std::size_t i = 0; i < hand.way.size(); ++i) {
    const std::string of = "way[" + std::to_string(i) + "].";
    table.add(of + "to", hand.way[i].to);
    table.add(of + "seconds", hand.way[i].seconds);
    table.add(of + "grip_rad", hand.way[i].grip_rad);
    if (hand.way[i].roll_rad != 0) table.add(of + "roll_rad", hand.way[i].roll_rad);
  }
}

void add(const HapticsSpec& haptics, Table table) {
  table.add("friction", haptics.friction);
  table.add("contact", haptics.contact);
  table.add("max_force_n", haptics.max_force_n);
  table.add("max_torque_nm", haptics.max_torque_nm);
  table.add("max_slew_n_s", haptics.max_slew_n_s);
  table.add("ramp_s", haptics.ramp_s);
  table.add("stale_s", haptics.stale_s);
  table.add("decay_s", haptics.decay_s);
}

std::string or_none(const std::string& name) {
  return name.empty() ? "none" : name;
}

// one node takes the cut's measure, another one the camera's
void add(const ScoreSpec& score, Table table) {
  table.add("exposed_organ", or_none(score.exposed_organ));
  table.add("from_s", score.from_s);
  table.add("line_of", or_none(score.line_of));
  for (std::size_t i = 0; i < score.planned_line.size(); ++i)
    table.add("planned_line[" + std::to_string(i) + "]", score.planned_line[i]);
  table.add("line_width_m", score.line_width_m);
  table.add("pull_limit_n", score.pull_limit_n);
  if (!score.camera) return;
  table.add("camera.tool", score.camera->tool);
  table.add("camera.organ", or_none(score.camera->organ));
  table.add("camera.place", score.camera->place);
  table.add("camera.within_deg", score.camera->within_deg);
}

}  // namespace

std::vector<std::string> scene_values(const Scene& scene) {
  std::vector<std::string> values;
  for (std::size_t i = 0; i < scene.organs.size(); ++i) add(scene.organs[i], {"organs", i, values});
  for (std::size_t i = 0; i < scene.obstacles.size(); ++i) add(scene.obstacles[i], {"obstacles", i, values});
  for (std::size_t i = 0; i < scene.tools.size(); ++i) add(scene.tools[i], {"tools", i, values});
  for (std::size_t i = 0; i < scene.hands.size(); ++i) add(scene.hands[i], {"hands", i, values});
  add(scene.haptics, {"haptics", values});
  add(scene.score, {"score", values});
  return values;
}

std::string printable(std::string_view text) {
  std::string line;
  for (const char letter : text) {
    const auto byte = static_cast<unsigned char>(letter);
    const bool control = byte < 0x20 || byte == 0x7f;
    line += control ? std::string("\\x") + "0123456789abcdef"[byte >> 4] + "0123456789abcdef"[byte & 15]
                    : std::string(1, letter);
  }
  return line;
}

std::string scene_hash(const std::vector<std::string>& values) {
  files::Sha256 sha;
  for (const std::string& value : values) {
    sha.add(value.data(), value.size());
    sha.add("\n", 1);
  }
  return sha.hexadecimal();
}

}  // namespace omentum::scene
