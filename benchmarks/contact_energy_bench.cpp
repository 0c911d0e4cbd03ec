// Is the hand's contact conservative? One tool goes along closed paths (down through the air, press, slide,
// release, back through the air) over organs, depths and directions, through the haptic step alone: no time,
// no wire, no safety. A frictionless contact gives back what was put in, and no more:
//   net_energy/ORGAN/DEPTH_MM/DIRECTION_DEG    energy given to the hand over the path, as a share of the most
//                                              that it had put in on the way; goal: within 1 %
//   force_step_n/ORGAN/DEPTH_MM/DIRECTION_DEG  largest change of the force in one step; goal: 0.02 N in 20 um
#include "benchmarks/bench_json.h"
#include "runtime/command_line.h"
#include "tests/support/closed_path.h"
#include "tests/support/trial_organs.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace {

using namespace omentum;
using geometry::Vec3;
using Figures = test::ClosedPathFigures;

constexpr double kSlide_m = 0.02;
constexpr int kDirections = 8;
constexpr double kNetLimit = 0.01, kForceStepLimit_n = 0.02;

struct Options {
  std::string organ;
  double depth_mm = 0, direction_deg = -1, step_um = 20;
  std::filesystem::path trace;

  std::vector<double> depths_mm() const {
    return depth_mm > 0 ? std::vector{depth_mm} : std::vector{1.0, 4.0, 8.0};
  }
  std::vector<double> directions_deg() const {
    if (direction_deg >= 0) return {direction_deg};
    std::vector<double> all;
    for (int d = 0; d < kDirections; ++d) all.push_back(360.0 * d / kDirections);
    return all;
  }
};

// ORGAN/DEPTH_MM/DIRECTION_DEG
std::string case_name(const std::string& organ, double depth_mm, double direction_deg) {
  std::array<char, 64> numbers;
  std::snprintf(numbers.data(), numbers.size(), "/%g/%g", depth_mm, direction_deg);
  return organ + numbers.data();
}

void add_figures(bench::Results& results, const std::string& path, const Figures& figures) {
  results.add({.name = "net_energy/" + path, .value = figures.net_share(), .unit = "1", .limit = kNetLimit});
  results.add({.name = "force_step_n/" + path,
               .value = figures.largest_step_n,
               .unit = "N",
               .limit = kForceStepLimit_n});
}

struct Measured {
  double direction_deg;
  Figures figures;
};

void print_head() {
  std::printf("%-26s %5s | %9s %9s %9s | %10s %-22s %9s | %9s %7s\n", "organ", "depth", "net least",
              "net most", "over goal", "force step", "where", "over goal", "put in", "force");
}

// One line for all directions.
void print_depth(const std::string& organ, double depth_mm, std::span<const Measured> all) {
  double least = 0, most = 0, put_in_j = 0, force_n = 0;
  int over_net = 0, over_step = 0, unsolved = 0;
  const Measured* roughest = &all.front();
  for (const Measured& one : all) {
    const Figures& f = one.figures;
    least = std::min(least, f.net_share()), most = std::max(most, f.net_share());
    over_net += std::abs(f.net_share()) > kNetLimit, over_step += f.largest_step_n > kForceStepLimit_n;
    put_in_j = std::max(put_in_j, f.most_put_in_j), force_n = std::max(force_n, f.largest_force_n);
    unsolved += f.unsolved;
    if (f.largest_step_n > roughest->figures.largest_step_n) roughest = &one;
  }
  const Figures& worst = roughest->figures;
  std::array<char, 64> where;
  std::snprintf(where.data(), where.size(), "%s %.1f mm, %.0f deg", test::ClosedPath::kLegs[worst.leg],
                1e3 * worst.along_m, roughest->direction_deg);
  std::printf("%-26s %2.0f mm | %8.2f%% %8.2f%% %4d of %-2zu | %8.4f N %-22s %4d of %-2zu | %6.3f mJ %5.3f N",
              organ.c_str(), depth_mm, 100 * least, 100 * most, over_net, all.size(), worst.largest_step_n,
              where.data(), over_step, all.size(), 1e3 * put_in_j, force_n);
  std::printf(unsolved > 0 ? ", %d ticks unsolved\n" : "\n", unsolved);
  std::fflush(stdout);
}

void print_place(const test::OrganRecipe& recipe, const haptic::ElasticSurface& surface,
                 const test::PressPlace& place) {
  const Vec3 p = 1e3 * place.point, &n = place.normal;
  std::printf(
      "%s: %d mobile surface nodes, %.0f kPa; pressed at (%.1f, %.1f, %.1f) mm, normal (%.2f, %.2f, %.2f), "
      "%.0f mm thick; slides of %.0f mm%s, the surface rises by %.1f and falls by %.1f mm\n",
      recipe.name.c_str(), surface.surface.mobile_count, 1e-3 * recipe.young_pa, p.x(), p.y(), p.z(), n.x(),
      n.y(), n.z(), 1e3 * place.thickness_m, 1e3 * place.slide_m,
      place.slide_m < kSlide_m ? " (the organ has no room for 20)" : "", 1e3 * place.rise_m,
      1e3 * place.fall_m);
}

using Watch = std::function<void(const test::PathPoint&)>;

void measure_organ(const test::OrganRecipe& recipe, const Options& options, const Watch& watch,
                   bench::Results& results) {
  const auto organ = test::make_trial_organ(recipe);
  if (!organ) {
    std::printf("%-26s skipped: its mesh is not there\n", recipe.name.c_str());
    return;
  }
  const haptic::HapticModel model = test::trial_model(*organ, {test::scene_tools(false).front()});
  const auto place = test::find_press_place(model.organs.front(), recipe.up, kSlide_m);
  if (!place) throw std::runtime_error(recipe.name + ": no place to press");
  print_place(recipe, model.organs.front(), *place);
  for (const double depth_mm : options.depths_mm()) {
    std::vector<Measured> all;
    for (const double direction : options.directions_deg()) {
      const test::ClosedPath path{*place, 1e-3 * depth_mm, direction};
      all.push_back({direction, test::walk(model, path, 1e-6 * options.step_um, watch)});
      add_figures(results, case_name(recipe.name, depth_mm, direction), all.back().figures);
    }
    print_depth(recipe.name, depth_mm, all);
  }
}

// Writes every step of a path as a line of CSV.
Watch make_trace(const Options& options, std::FILE* file) {
  if (options.organ.empty() || options.depth_mm <= 0 || options.direction_deg < 0)
    throw std::invalid_argument("--trace records one path: say --organ, --depth and --direction too");
  if (!file) throw std::runtime_error(options.trace.string() + ": cannot be written");
  std::fprintf(file, "way_m,depth_m,x_m,y_m,z_m,fx_n,fy_n,fz_n,stored_j,given_j,touching\n");
  return [file](const test::PathPoint& at) {
    const Vec3 &p = at.tip, &f = at.output.force;
    std::fprintf(file, "%.6f,%.6f,%.7f,%.7f,%.7f,%.7f,%.7f,%.7f,%.9e,%.9e,%d\n", at.way_m, at.depth_m, p.x(),
                 p.y(), p.z(), f.x(), f.y(), f.z(), at.output.stored_j, at.given_j, at.output.touching);
  };
}

void run(const Options& options, bench::Results& results) {
  const auto all = test::organ_recipes();
  const auto chosen = options.organ.empty() ? all : std::span(&test::organ_recipe(options.organ), 1);
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(nullptr, std::fclose);
  Watch watch;
  if (!options.trace.empty()) {
    file.reset(std::fopen(options.trace.c_str(), "w"));
    watch = make_trace(options, file.get());
  }
  print_head();
  for (const test::OrganRecipe& recipe : chosen) measure_organ(recipe, options, watch, results);
}

}  // namespace

int main(int argc, char** argv) {
  bench::Results results(argc, argv);
  Options options;
  runtime::CommandLine line(
      "contact_energy_bench",
      "Net energy and force steps of closed paths in contact; --json FILE writes them.");
  line.option("--organ", options.organ, "only this one: phantom, openhelp_liver_7k, ...");
  line.option("--depth", options.depth_mm, "only this one, mm").between(0.01, 50.0);
  line.option("--direction", options.direction_deg, "only this one, degrees").between(0.0, 360.0);
  line.option("--step-um", options.step_um, "length of a step").between(0.1, 1000.0).show_default();
  line.option("--trace", options.trace, "writes one path as CSV").type_name("FILE");
  return line.run(argc, argv, [&] {
    run(options, results);
    results.write();
  });
}
