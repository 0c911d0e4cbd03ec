// intestine_anatomy: the numbers of an intestine as a shape, in a file and in a picture.
#include "files/png_file.h"
#include "files/whole_file.h"
#include "geometry/gut_anatomy.h"
#include "geometry/gut_intersections.h"
#include "geometry/tetra_mesh.h"
#include "organ/csv.h"
#include "organ_tools/intestine_anatomy/gut_file.h"
#include "organ_tools/intestine_anatomy/gut_picture.h"
#include "runtime/command_line.h"
#include "scene/scene.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>

namespace {

using namespace omentum;
using geometry::GutAnatomy;
using geometry::Vec3;

struct AnatomyCommand {
  std::filesystem::path scene, file, picture;
  std::string from = "0.4,-0.5,0.9";
  std::vector<std::function<void(GutAnatomy&)>> changes;  // what the command line says, after the scene
};

template <class... Values>
std::string text(const char* format, Values... values) {
  char line[200];
  std::snprintf(line, sizeof line, format, values...);
  return line;
}

// So many numbers, or nothing.
std::optional<std::vector<double>> numbers(const std::string& text, std::size_t count) {
  auto found = organ::parse_numbers(text);
  if (!found || found->size() != count) return std::nullopt;
  return found;
}

void add_number(runtime::CommandLine& line, AnatomyCommand& command, const char* key, const char* what,
                double GutAnatomy::*member) {
  const auto take = [&command, member](const std::string& text) -> std::string {
    const auto found = numbers(text, 1);
    if (!found) return "expected a number";
    command.changes.emplace_back([member, value = found->front()](GutAnatomy& a) { a.*member = value; });
    return "";
  };
  line.option(key, take, what + text(" (default %g)", GutAnatomy{}.*member)).type_name("METRES");
}

void add_count(runtime::CommandLine& line, AnatomyCommand& command, const char* key, const char* what,
               std::int32_t GutAnatomy::*member) {
  const auto take = [&command, member](const std::string& text) -> std::string {
    const auto found = numbers(text, 1);
    constexpr double kMost = 1e6;
    if (!found || !(std::abs(found->front()) <= kMost) || std::trunc(found->front()) != found->front())
      return "expected a whole number";
    command.changes.emplace_back(
        [member, value = static_cast<std::int32_t>(found->front())](GutAnatomy& a) { a.*member = value; });
    return "";
  };
  line.option(key, take, what + text(" (default %d)", GutAnatomy{}.*member)).type_name("COUNT");
}

void add_vector(runtime::CommandLine& line, AnatomyCommand& command, const char* key, const char* what,
                Vec3 GutAnatomy::*member) {
  const auto take = [&command, member](const std::string& text) -> std::string {
    const auto found = numbers(text, 3);
    if (!found) return "expected x,y,z";
    command.changes.emplace_back([member, value = Vec3(found->data())](GutAnatomy& a) { a.*member = value; });
    return "";
  };
  line.option(key, take, what).type_name("X,Y,Z");
}

void add_options(runtime::CommandLine& line, AnatomyCommand& command) {
  line.option("scene", command.scene, "a scene: its first intestine instead of the defaults")
      .type_name("SCENE.toml");
  line.option("-o,--output", command.file, "the axis (with its radius) and the mesentery, legacy VTK")
      .required()
      .type_name("FILE.vtk")
      .writes_file();
  line.option("--picture", command.picture, "also draws it").type_name("FILE.png").writes_file();
  line.option("--from", command.from, "the side that the picture is seen from")
      .type_name("X,Y,Z")
      .show_default();
  add_number(line, command, "--length_m", "of the gut", &GutAnatomy::length_m);
  add_number(line, command, "--tube_radius_m", "of the gut", &GutAnatomy::tube_radius_m);
  add_number(line, command, "--cylinder_radius_m", "on which the folds lie", &GutAnatomy::cylinder_radius_m);
  add_number(line, command, "--vessel_length_m", "on the cylinder's axis", &GutAnatomy::vessel_length_m);
  add_number(line, command, "--mesentery_thickness_m", "of the mesentery",
             &GutAnatomy::mesentery_thickness_m);
  add_number(line, command, "--fold_pitch_m", "from leg to leg along the vessel", &GutAnatomy::fold_pitch_m);
  add_count(line, command, "--legs", "runs around the cylinder", &GutAnatomy::legs);
  add_count(line, command, "--rows", "of masses across the mesentery", &GutAnatomy::rows);
  add_count(line, command, "--columns", "of masses along the gut", &GutAnatomy::columns);
  add_vector(line, command, "--origin", "the vessel's middle, m", &GutAnatomy::origin);
  add_vector(line, command, "--along", "the vessel's direction", &GutAnatomy::along);
  add_vector(line, command, "--up", "from the vessel to the folds", &GutAnatomy::up);
}

GutAnatomy anatomy_of(const AnatomyCommand& command) {
  GutAnatomy anatomy;
  if (!command.scene.empty()) {
    const scene::Scene scene = scene::load_scene(command.scene);
    const auto found =
        std::ranges::find_if(scene.organs, [](const auto& o) { return o.intestine.has_value(); });
    if (found == scene.organs.end())
      throw geometry::InputError(command.scene.string() + ": expected an organ of model \"intestine\"");
    anatomy = found->intestine->anatomy;
  }
  for (const auto& change : command.changes) change(anatomy);
  return anatomy;
}

Vec3 parse_direction(const std::string& from) {
  const auto found = numbers(from, 3);
  if (!found || !(Vec3(found->data()).norm() > 0))
    throw geometry::InputError("--from " + from + ": expected a direction x,y,z that is not 0,0,0");
  return Vec3(found->data()).normalized();
}

// With 4 x 4000 masses every pair takes a quarter of a minute: then the generator's own check is all.
constexpr std::int32_t kMeasuredColumns = 1200;

std::vector<std::string> describe(const GutAnatomy& anatomy, const geometry::GutShape& gut) {
  std::vector<std::string> lines{text("%g m of gut, %g mm across, %d legs; %d x %d masses %.2f mm apart",
                                      anatomy.length_m, 2e3 * anatomy.tube_radius_m, anatomy.legs,
                                      anatomy.rows, anatomy.columns,
                                      1e3 * anatomy.length_m / (anatomy.columns - 1))};
  if (anatomy.columns > kMeasuredColumns) return lines;
  const geometry::GutReach free = geometry::smallest_distances(gut), reach = geometry::reach_of(gut);
  lines.push_back(
      text("nearest parts: axis to axis %.1f mm (they touch at %.1f), axis to mesentery %.1f mm (%.1f)",
           1e3 * free.tube_m, 1e3 * reach.tube_m, 1e3 * free.mesentery_m, 1e3 * reach.mesentery_m));
  return lines;
}

void make(const AnatomyCommand& command) {
  gut_picture::PictureOptions options;
  options.from = parse_direction(command.from);
  const GutAnatomy anatomy = anatomy_of(command);
  const geometry::GutShape gut = geometry::make_gut(anatomy);
  options.lines = describe(anatomy, gut);
  for (const std::string& line : options.lines) std::printf("%s\n", line.c_str());
  if (!command.picture.empty()) {
    const force_map::Canvas canvas = gut_picture::draw_gut(gut, options);
    files::write_png(command.picture, canvas.width(), canvas.height(), canvas.rgba());
  }
  gut_picture::write_gut(command.file, gut);
}

}  // namespace

int main(int argc, char** argv) {
  runtime::CommandLine line(
      "intestine_anatomy",
      "Makes an intestine and its mesentery (Raghupathi 2004, section 3.1) of a scene's "
      "numbers or of those given, and writes and draws it.");
  AnatomyCommand command;
  add_options(line, command);
  return line.run(argc, argv, [&] { make(command); });
}
