// force_map: how hard an organ feels, everywhere on its surface; and how much harder than another one.
#include "files/png_file.h"
#include "files/whole_file.h"
#include "organ/csv.h"
#include "organ/stored_tensors.h"
#include "organ/tensor_check.h"
#include "organ_tools/force_map/map_file.h"
#include "organ_tools/force_map/map_picture.h"
#include "runtime/command_line.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iterator>

namespace {

using namespace omentum;
using force_map::Vec3;

constexpr double kShownShare = 0.98;  // of places: single ones in notches would take all colours
constexpr double kFelt = 1.001;       // a ratio below is the rounding of float tensors, or nothing to a hand
constexpr int kFewNodes = 3;          // below, the mesh is felt rather than the organ

struct MapCommand {
  std::filesystem::path organ, compared;
  std::string prefix, from = "0,0,1";
  force_map::Indenter indenter;
  bool outline = false;
};

void add_options(runtime::CommandLine& line, MapCommand& command) {
  line.option("organ", command.organ, "organ file").required().type_name("ORGAN.h5");
  line.option("-o,--output", command.prefix, "writes PREFIX.vtu (point data, N) and PREFIX.png")
      .required()
      .type_name("PREFIX");
  line.option(
          "--compare", command.compared,
          "an organ of the same mesh, such as the one without a nodule: the picture is of the forces' ratio, "
          "since where an organ is thin it is stiff as well (a soft place is found the other way round)")
      .type_name("OTHER.h5");
  line.option("--radius", command.indenter.radius_m, "of the round indenter, m")
      .between(1e-4, 1.0)
      .type_name("METRES")
      .show_default();
  line.option("--depth", command.indenter.depth_m, "how far it is pressed in along the normal, m")
      .between(1e-6, 1.0)
      .type_name("METRES")
      .show_default();
  line.option("--from", command.from, "the side that the picture is seen from")
      .type_name("X,Y,Z")
      .show_default();
  line.flag("--outline", command.outline, "draws where the organ's regions lie, as a dashed line");
}

Vec3 parse_direction(const std::string& text) {
  const auto numbers = organ::parse_numbers(text);
  if (!numbers || numbers->size() != 3 || !(Vec3(numbers->data()).norm() > 0))
    throw geometry::InputError("--from " + text + ": expected a direction x,y,z that is not 0,0,0");
  return Vec3(numbers->data()).normalized();
}

// There is the time to read all of the tensors.
organ::Organ load(const std::filesystem::path& file) {
  organ::Organ organ = organ::load_organ(file, organ::Load::kWithTensors);
  organ::require_whole(organ::map_tensors(file, organ), file);
  return organ;
}

template <class... Values>
std::string text(const char* format, Values... values) {
  char line[300];
  std::snprintf(line, sizeof line, format, values...);
  return line;
}

std::vector<double> numbers_in(const std::vector<double>& values) {
  std::vector<double> found;
  std::ranges::copy_if(values, std::back_inserter(found), [](double v) { return std::isfinite(v); });
  std::ranges::sort(found);
  return found;
}

std::string place_text(const organ::Organ& organ, const force_map::Peak& peak) {
  const geometry::NodeId n = organ.surface.node[peak.node];
  const Vec3 mm = 1e3 * organ.mesh.positions[n];
  return text(
      "node %lld (%.1f, %.1f, %.1f mm)",
      static_cast<long long>(organ.mesh.node_numbers[static_cast<std::size_t>(organ.mesh.file_node[n])]),
      mm.x(), mm.y(), mm.z());
}

void warn_of_a_coarse_mesh(const force_map::PressMap& map) {
  std::vector<std::int32_t> touching;
  std::ranges::copy_if(map.touching, std::back_inserter(touching), [](std::int32_t n) { return n > 0; });
  std::ranges::sort(touching);
  const std::int32_t median = touching[touching.size() / 2];
  if (median >= kFewNodes) return;
  std::fprintf(
      stderr,
      "force_map: warning: %d nodes bear the indenter at the median place: it feels the mesh as much as the "
      "organ (a larger --radius or a finer mesh helps)\n",
      median);
}

struct Drawn {
  std::vector<double> values;
  force_map::PictureOptions options;
};

Drawn force_drawing(const organ::Organ& organ, const force_map::PressMap& map) {
  const std::vector<double> forces = numbers_in(map.force_n);
  Drawn drawn{map.force_n, {}};
  drawn.options.low = 0;
  drawn.options.high = forces[static_cast<std::size_t>(kShownShare * static_cast<double>(forces.size() - 1))];
  drawn.options.unit = "N";
  drawn.options.peak = force_map::peak_of(organ, map.force_n, 0);
  drawn.options.lines.push_back(text("%zu of %d nodes pressed: %.3g to %.3g N, median %.3g N; highest at ",
                                     forces.size(), organ.surface.node_count(), forces.front(), forces.back(),
                                     forces[forces.size() / 2]) +
                                place_text(organ, *drawn.options.peak));
  drawn.options.lines.push_back(
      text("colours end at %.3g N: %.0f %% of the places lie below", drawn.options.high, 100 * kShownShare));
  return drawn;
}

Drawn ratio_drawing(const organ::Organ& organ, const std::vector<double>& ratio, const std::string& other) {
  const std::vector<double> numbers = numbers_in(ratio);
  const auto peak = force_map::peak_of(organ, ratio, 1);
  if (!peak) throw geometry::InputError(organ.name + ": no place can be pressed here and in " + other);
  Drawn drawn{ratio, {}};
  drawn.options.low = std::min(1.0, numbers.front());
  drawn.options.high = std::max(1.0, numbers.back());
  drawn.options.unit = "ratio";
  drawn.options.lines.push_back(
      text("ratio to %s: %.3f to %.3f", other.c_str(), numbers.front(), numbers.back()));
  if (peak->value < kFelt) {
    drawn.options.lines.back() += ": nowhere harder";
    return drawn;
  }
  drawn.options.peak = peak;
  drawn.options.contour = (1 + peak->value) / 2;
  drawn.options.lines.back() += "; highest at " + place_text(organ, *peak);
  drawn.options.lines.push_back(
      text("white line: half of the excess there, around %.0f mm^2, as a disk of %.1f mm has",
           1e6 * peak->area_m2, 1e3 * peak->diameter_m()));
  return drawn;
}

void write(const MapCommand& command, const organ::Organ& organ,
           const std::vector<force_map::MapArray>& arrays, Drawn drawn) {
  force_map::PictureOptions& options = drawn.options;
  options.from = parse_direction(command.from);
  options.outline_regions = command.outline;
  for (const std::string& line : options.lines) std::printf("%s: %s\n", organ.name.c_str(), line.c_str());
  options.lines.insert(
      options.lines.begin(),
      text("%s: force of a ball of %.3g mm radius pressed %.3g mm deep, seen from (%s)", organ.name.c_str(),
           1e3 * command.indenter.radius_m, 1e3 * command.indenter.depth_m, command.from.c_str()));
  if (command.outline && !organ.material.regions.empty())
    options.lines.emplace_back("dashed line: what lies inside and is of another material");
  const force_map::Canvas canvas = force_map::draw_map(organ, drawn.values, options);
  force_map::write_map(command.prefix + ".vtu", organ, arrays);
  files::write_png(command.prefix + ".png", canvas.width(), canvas.height(), canvas.rgba());
}

void draw(const MapCommand& command) {
  parse_direction(command.from);
  if (command.indenter.depth_m > command.indenter.radius_m)
    throw geometry::InputError(text("--depth %g: expected at most the --radius, %g m",
                                    command.indenter.depth_m, command.indenter.radius_m));
  for (const char* ending : {".vtu", ".png"}) files::require_writable(command.prefix + ending);
  const organ::Organ organ = load(command.organ);
  const force_map::PressMap map = force_map::press_everywhere(organ, command.indenter);
  if (numbers_in(map.force_n).empty()) {
    throw geometry::InputError(
        command.organ.string() +
        ": nowhere can such an indenter be pressed without moving what is held; expected a "
        "smaller --radius or --depth");
  }
  warn_of_a_coarse_mesh(map);
  if (command.compared.empty())
    return write(command, organ, {{"force_n", map.force_n}}, force_drawing(organ, map));
  const organ::Organ other = load(command.compared);
  const force_map::PressMap other_map = force_map::press_everywhere(other, command.indenter);
  const std::vector<double> ratio = force_map::ratio_of(organ, map, other, other_map);
  write(command, organ, {{"force_n", map.force_n}, {"compared_force_n", other_map.force_n}, {"ratio", ratio}},
        ratio_drawing(organ, ratio, other.name));
}

}  // namespace

int main(int argc, char** argv) {
  runtime::CommandLine line(
      "force_map",
      "Presses a round indenter all over an organ's surface and draws the forces that it takes.");
  MapCommand command;
  add_options(line, command);
  return line.run(argc, argv, [&] { draw(command); });
}
