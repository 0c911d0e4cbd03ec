#include "scene/intestine_keys.h"

#include "scene/step_range.h"

#include <limits>

namespace omentum::scene {
namespace {

using enum TomlSection::Need;

// A session's memory and a state's message end somewhere: four metres in masses a millimetre apart.
constexpr std::uint32_t kMostRows = 16, kMostColumns = 4000;
// A wall that gives way more than its own thickness under a breath, or no more than bone does.
constexpr Range kWall_n_m{.minimum = 10, .maximum = 1e5};

void read_count(TomlSection& s, const std::string& key, std::int32_t& value, std::uint32_t least,
                std::uint32_t most) {
  auto count = static_cast<std::uint32_t>(value);
  s.read(key, count, kOptional, most);
  if (count < least) s.refuse(key, std::to_string(count), "at least " + std::to_string(least));
  value = static_cast<std::int32_t>(count);
}

void read_anatomy(TomlSection& s, geometry::GutAnatomy& anatomy) {
  s.read("length_m", anatomy.length_m, kOptional, kPositive);
  s.read("tube_radius_m", anatomy.tube_radius_m, kOptional, kPositive);
  s.read("cylinder_radius_m", anatomy.cylinder_radius_m, kOptional, kPositive);
  s.read("vessel_length_m", anatomy.vessel_length_m, kOptional, kPositive);
  s.read("mesentery_thickness_m", anatomy.mesentery_thickness_m, kOptional, kNotNegative);
  s.read("fold_pitch_m", anatomy.fold_pitch_m, kOptional, kPositive);
  read_count(s, "legs", anatomy.legs, 3, 100);
  read_count(s, "rows", anatomy.rows, 2, kMostRows);
  read_count(s, "columns", anatomy.columns, 4, kMostColumns);
  s.read("origin", anatomy.origin, kOptional);
  s.read_direction("along", anatomy.along, kOptional);
  s.read_direction("up", anatomy.up, kOptional);
}

void read_material(TomlSection& s, GutMaterialSpec& material) {
  s.read("gut_mass_kg_m", material.gut_mass_kg_m, kPositive);
  s.read("gut_stretch_n", material.gut_stretch_n, kPositive);
  s.read("gut_bending_n_m2", material.gut_bending_n_m2, kNotNegative);
  s.read("mesentery_mass_kg_m2", material.mesentery_mass_kg_m2, kPositive);
  s.read("mesentery_stretch_n_m", material.mesentery_stretch_n_m, kPositive);
  s.read("spring_damping_s", material.spring_damping_s, kNotNegative);
  s.read("calming_time_s", material.calming_time_s, kPositive);
}

}  // namespace

IntestineSpec read_intestine(TomlSection& s) {
  IntestineSpec intestine;
  read_anatomy(s, intestine.anatomy);
  read_material(s, intestine.material);
  s.read_word("method", intestine.method, kOptional, {"projective", "explicit"});
  s.read("step_s", intestine.step_s, kStepRange_s);
  s.read("gravity_m_s2", intestine.gravity_m_s2, kOptional);
  s.read_word("collision", intestine.collision, kOptional, {"complete", "stochastic"});
  s.read("seed", intestine.seed, kOptional, std::numeric_limits<std::uint32_t>::max());
  s.read("friction", intestine.friction, kOptional, kNotNegative);
  s.read("wall_stiffness_n_m", intestine.wall_stiffness_n_m, kOptional, kWall_n_m);
  intestine.where = s.place("model");
  return intestine;
}

ObstacleSpec read_obstacle(TomlSection& s) {
  ObstacleSpec obstacle;
  s.read_word("shape", obstacle.shape, kRequired, {"plane", "ellipsoid", "box"});
  s.read("centre", obstacle.centre, kRequired);
  if (obstacle.shape == "plane") {
    s.read_direction("normal", obstacle.normal, kRequired);
  } else {
    s.read("half_axes_m", obstacle.half_axes_m, kRequired);
    if (!(obstacle.half_axes_m.array() > 0).all())
      s.refuse("half_axes_m", "a length of 0 or less", "three above 0");
  }
  obstacle.where = s.place("shape");
  s.refuse_unknown_keys();
  return obstacle;
}

void refuse_wrong_obstacles(const TomlSection& root, std::size_t count, bool met) {
  const std::string found = std::to_string(count);
  if (count > kMostObstacles)
    root.refuse("obstacles", found, "at most " + std::to_string(kMostObstacles) + " of [[obstacles]]");
  if (count > 0 && !met)
    root.refuse("obstacles", found + " in a scene without an intestine",
                "none, or an organ with model = \"intestine\": no other meets them");
}

}  // namespace omentum::scene
