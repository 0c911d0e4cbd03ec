// Is the hand's contact conservative? One tool goes along closed paths (down through the air, press, slide,
// release, back through the air) over organs, depths and directions, through the haptic step alone: no time,
// no wire, no safety. A frictionless contact gives back what was put in, and no more:
//   net_energy/ORGAN/DEPTH_MM/DIRECTION_DEG    energy given to the hand over the path, as a share of the most
//                                              that it had put in on the way; goal: within 1 %
//   force_step_n/ORGAN/DEPTH_MM/DIRECTION_DEG  largest change of the force in one step; goal: 0.02 N in 20 um
#include "benchmarks/bench_json.h"
#include "geometry/rotation.h"
#include "haptic_node/haptic_step.h"
#include "runtime/command_line.h"
#include "tests/support/press_place.h"
#include "tests/support/trial_organs.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace {

using namespace omentum;
using geometry::Vec3;

constexpr double kSlide_m = 0.02, kHover_m = 2e-3;
constexpr int kDirections = 8;
constexpr double kNetLimit = 0.01, kForceStepLimit_n = 0.02;
constexpr std::array<const char*, 4> kLegs = {"press", "slide", "release", "return"};

struct Path {
  test::PressPlace place;
  double depth_m, direction_deg;

  /// Corners of the closed path: five, the last one is the first.
  std::array<Vec3, 5> corners() const {
    const Vec3 up = (place.rise_m + kHover_m) * place.normal, down = -depth_m * place.normal;
    const Vec3 away = place.slide_m * place.direction(direction_deg);
    const Vec3& p = place.point;
    return {p + up, p + down, p + down + away, p + up + away, p + up};
  }
};

struct Figures {
  double net_j = 0;  // given to the hand over the whole path
  double most_put_in_j = 0;
  double largest_step_n = 0, largest_force_n = 0;
  int leg = 0;         // of the largest step ...
  double along_m = 0;  // ... and where in it
  int unsolved = 0;    // ticks

  double ratio() const { return most_put_in_j > 0 ? net_j / most_put_in_j : 0; }
};

// One tool's way along closed paths, each on an organ at rest.
class Walk {
 public:
  Walk(const haptic::HapticModel& model, double step_m, std::FILE* trace)
      : model_(model), step_m_(step_m), trace_(trace) {}

  Figures go(const Path& path) {
    haptic::HapticState state(model_);
    const auto work = std::make_unique<haptic::HapticWorkspace>(model_);
    const auto corners = path.corners();
    input_.engaged = true;
    input_.frame = {corners[0], geometry::rotation_onto(Vec3::UnitZ(), path.place.normal)};
    step(state, *work);
    Figures figures;
    double way_m = 0;
    for (int leg = 0; leg < static_cast<int>(kLegs.size()); ++leg) {
      const Vec3 whole = corners[leg + 1] - corners[leg];
      const int steps = std::max(1, static_cast<int>(std::ceil(whole.norm() / step_m_)));
      for (int i = 1; i <= steps; ++i) {
        const Vec3 force = output_.force, from = input_.frame.p_WT;
        input_.frame.p_WT = corners[leg] + whole * i / steps;
        figures.unsolved += step(state, *work) != physics::ContactStatus::kConverged;
        account(force, from, figures);
        if ((output_.force - force).norm() == figures.largest_step_n)
          figures.leg = leg, figures.along_m = whole.norm() * i / steps;
        record(path, way_m += whole.norm() / steps, figures.net_j);
      }
    }
    return figures;
  }

 private:
  physics::ContactStatus step(haptic::HapticState& state, haptic::HapticWorkspace& work) {
    return haptic::haptic_step(model_, {&input_, 1}, state, work, {&output_, 1}).status;
  }
  // One step from where the tip was and what it felt there.
  void account(const Vec3& force, const Vec3& from, Figures& figures) const {
    figures.net_j += 0.5 * (force + output_.force).dot(input_.frame.p_WT - from);
    figures.most_put_in_j = std::max(figures.most_put_in_j, -figures.net_j);
    figures.largest_force_n = std::max(figures.largest_force_n, output_.force.norm());
    figures.largest_step_n = std::max(figures.largest_step_n, (output_.force - force).norm());
  }
  void record(const Path& path, double way_m, double given_j) const {
    if (trace_ == nullptr) return;
    const Vec3 &p = input_.frame.p_WT, &f = output_.force;
    std::fprintf(trace_, "%.6f,%.6f,%.7f,%.7f,%.7f,%.7f,%.7f,%.7f,%.9e,%.9e,%d\n", way_m,
                 (path.place.point - p).dot(path.place.normal), p.x(), p.y(), p.z(), f.x(), f.y(), f.z(),
                 output_.stored_j, given_j, output_.touching);
  }

  const haptic::HapticModel& model_;
  double step_m_;
  std::FILE* trace_;
  haptic::ToolInput input_;
  haptic::ToolOutput output_;
};

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
  results.add({.name = "net_energy/" + path, .value = figures.ratio(), .unit = "1", .limit = kNetLimit});
  results.add({.name = "force_step_n/" + path,
               .value = figures.largest_step_n,
               .unit = "N",
               .limit = kForceStepLimit_n});
}

void print_head() {
  std::printf("%-26s %5s | %9s %9s %9s | %10s %-22s %8s | %9s %8s\n", "organ", "depth", "net least",
              "net most", "over goal", "force step", "where", "over goal", "put in", "force");
}

void measure_depth(Walk& walk, const std::string& organ, const test::PressPlace& place, double depth_mm,
                   const Options& options, bench::Results& results) {
  double least = 0, most = 0, put_in_j = 0, force_n = 0;
  int over_net = 0, over_step = 0, paths = 0, unsolved = 0;
  Figures worst;
  double worst_direction = 0;
  for (const double direction : options.directions_deg()) {
    const Figures f = walk.go({place, 1e-3 * depth_mm, direction});
    add_figures(results, case_name(organ, depth_mm, direction), f);
    least = std::min(least, f.ratio()), most = std::max(most, f.ratio());
    over_net += std::abs(f.ratio()) > kNetLimit, over_step += f.largest_step_n > kForceStepLimit_n;
    put_in_j = std::max(put_in_j, f.most_put_in_j), force_n = std::max(force_n, f.largest_force_n);
    unsolved += f.unsolved;
    ++paths;
    if (f.largest_step_n >= worst.largest_step_n) worst = f, worst_direction = direction;
  }
  char where[64];
  std::snprintf(where, sizeof where, "%s %.1f mm, %.0f deg", kLegs[worst.leg], 1e3 * worst.along_m,
                worst_direction);
  std::printf("%-26s %2.0f mm | %8.2f%% %8.2f%% %4d of %-2d | %8.4f N %-22s %3d of %-2d | %6.3f mJ %6.3f N",
              organ.c_str(), depth_mm, 100 * least, 100 * most, over_net, paths, worst.largest_step_n, where,
              over_step, paths, 1e3 * put_in_j, force_n);
  std::printf(unsolved > 0 ? ", %d ticks unsolved\n" : "\n", unsolved);
  std::fflush(stdout);
}

void measure_organ(const test::OrganRecipe& recipe, const Options& options, std::FILE* trace,
                   bench::Results& results) {
  const auto organ = test::make_trial_organ(recipe);
  if (!organ) {
    std::printf("%-26s skipped: its mesh is not there\n", recipe.name.c_str());
    return;
  }
  const haptic::HapticModel model = test::trial_model(*organ, {test::scene_tools(false).front()});
  const auto place = test::find_press_place(model, recipe.up, kSlide_m);
  if (!place) throw std::runtime_error(recipe.name + ": no place to press");
  std::printf(
      "%s: %d mobile surface nodes, %.0f kPa; pressed at (%.1f, %.1f, %.1f) mm, normal (%.2f, %.2f, %.2f), "
      "%.0f mm thick; slides of %.0f mm%s, the surface rises by %.1f and falls by %.1f mm\n",
      recipe.name.c_str(), model.surface.mobile_count, 1e-3 * recipe.young_pa, 1e3 * place->point.x(),
      1e3 * place->point.y(), 1e3 * place->point.z(), place->normal.x(), place->normal.y(), place->normal.z(),
      1e3 * place->thickness_m, 1e3 * place->slide_m,
      place->slide_m < kSlide_m ? " (the organ has no room for 20)" : "", 1e3 * place->rise_m,
      1e3 * place->fall_m);
  Walk walk(model, 1e-6 * options.step_um, trace);
  for (const double depth_mm : options.depths_mm())
    measure_depth(walk, recipe.name, *place, depth_mm, options, results);
}

void run(const Options& options, bench::Results& results) {
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> trace(nullptr, std::fclose);
  if (!options.trace.empty()) {
    if (options.organ.empty() || options.depth_mm <= 0 || options.direction_deg < 0)
      throw std::invalid_argument("--trace records one path: say --organ, --depth and --direction too");
    trace.reset(std::fopen(options.trace.c_str(), "w"));
    if (!trace) throw std::runtime_error(options.trace.string() + ": cannot be written");
    std::fprintf(trace.get(), "way_m,depth_m,x_m,y_m,z_m,fx_n,fy_n,fz_n,stored_j,given_j,touching\n");
  }
  const auto all = test::organ_recipes();
  const auto chosen = options.organ.empty() ? all : std::span(&test::organ_recipe(options.organ), 1);
  print_head();
  for (const test::OrganRecipe& recipe : chosen) measure_organ(recipe, options, trace.get(), results);
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
