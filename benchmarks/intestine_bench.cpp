// What a step of an intestine costs, springs and collisions: the median time on a core of the steps after the
// gut has fallen on a plane.
//   step/MASSES            4 rows, collisions with itself, its mesentery and the plane; per mass; real time
//   springs/MASSES         the same step without collisions
//   stochastic/400         the paper's search, against the complete one
//   projective/400         springs alone, per simulated second, at the default step
//   explicit/400           the same at the stable step
//   four_guts/STEP         four of 4 x 1,000 in one cavity that meet each other, as deform_node moves them:
//   on one
//                          thread (time on its core) and on two (by the clock; and by what both worked, as if
//                          each had a core); how many pairs of guts touch; what passed through what
//   calm/STEP              ten seconds after a release: mean speed; overlap, against the tube's radius
//   long_run               ten simulated minutes, only if it is named: real time; growth of the tracked pairs
// Arguments: cases to run, by the first word; all but long_run where there is none.
#include "benchmarks/bench_json.h"
#include "benchmarks/four_guts.h"
#include "geometry/gut_anatomy.h"
#include "physics/intestine/gut_system.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <functional>
#include <map>
#include <memory>

#include <time.h>

namespace {

using namespace omentum;
using namespace omentum::physics;
using geometry::Vec3;

constexpr double kStepLimit_us = 100;  // 400 masses, collisions included
constexpr double kCalmLimit_m_s = 1e-3;
constexpr double kDepthLimit = 0.05;  // of the tube's radius
constexpr double kPlane_m = -0.08;    // below the vessel
constexpr double kSettle_s = 2, kMeasure_s = 2;
constexpr int kTicksPerCount = 5;  // of crossings: an axis that crosses another is not back so soon
const std::array kPlane{GutObstacle{.kind = GutObstacle::Kind::kHalfSpace, .centre = Vec3(0, 0, kPlane_m)}};

/// Of this thread on a core, unless another clock is named: what other programs take of the machine is not in
/// it.
double now_s(clockid_t clock = CLOCK_THREAD_CPUTIME_ID) {
  timespec time{};
  clock_gettime(clock, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

/// Made once: that nothing of it overlaps is proved pair by pair.
const geometry::GutShape& shape_of(int columns) {
  static std::map<int, geometry::GutShape> made;
  const auto found = made.find(columns);
  if (found != made.end()) return found->second;
  geometry::GutAnatomy anatomy;
  anatomy.columns = columns;
  return made.emplace(columns, make_gut(anatomy)).first->second;
}

double mean_speed_m_s(const GutState& state) {
  double sum = 0;
  for (const Vec3& v : state.v) sum += v.norm();
  return sum / static_cast<double>(state.v.size());
}

/// Median of what `steps` calls of `step` take, us.
double median_us(int steps, const std::function<void()>& step, clockid_t clock = CLOCK_THREAD_CPUTIME_ID) {
  std::vector<double> us;
  for (int i = 0; i < steps; ++i) {
    const double begin = now_s(clock);
    step();
    us.push_back(1e6 * (now_s(clock) - begin));
  }
  const auto middle = us.begin() + steps / 2;
  std::nth_element(us.begin(), middle, us.end());
  return *middle;
}

int steps_in(double seconds, double step_s) {
  return static_cast<int>(std::lround(seconds / step_s));
}

class Bench {
 public:
  explicit Bench(bench::Results& results) : results_(results) {}

  void step() {
    for (const int columns : {100, 300, 1000, 4000}) {
      GutSystem gut(shape_of(columns), {}, {}, {});
      measure(gut, "step/" + std::to_string(4 * columns));
    }
    results_.limit("step/400", kStepLimit_us);
  }

  void stochastic() {
    GutSystem gut(shape_of(100), {}, {.method = GutPairMethod::kStochastic}, {});
    add({.name = "stochastic/400", .value = settled_us(gut), .unit = "us"});
    results_.compare(prefix("stochastic/400"), prefix("step/400"));
  }

  void springs() {
    for (const int columns : {100, 1000, 4000}) {
      const GutSprings springs(shape_of(columns), {});
      const GutStepSettings settings;
      const GutBand band(springs, settings.step_s);
      GutProjective step(springs, band, settings.step_s, settings.iterations);
      const double us =
          alone_us(springs, shape_of(columns), [&](auto forces, GutState& s) { step.step(forces, s); });
      add({.name = "springs/" + std::to_string(4 * columns), .value = us, .unit = "us"});
      if (columns == 100)
        add({.name = "projective/400", .value = us * 1e-3 / settings.step_s, .unit = "ms/s"});
    }
  }

  void explicit_step() {
    const GutSprings springs(shape_of(100), {});
    const double step_s = stable_step_s(springs);
    GutExplicit step(springs, step_s);
    const double us =
        alone_us(springs, shape_of(100), [&](auto forces, GutState& s) { step.step(forces, s); });
    add({.name = "explicit/400/stable_step", .value = 1e6 * step_s, .unit = "us"});
    add({.name = "explicit/400", .value = us * 1e-3 / step_s, .unit = "ms/s"});
    results_.compare(prefix("explicit/400"), prefix("projective/400"));
  }

  void four_guts() {
    four_guts("four_guts/5ms", {});
    four_guts("four_guts/10ms", {.step_s = 10e-3});
  }

  void four_guts(const std::string& name, const GutStepSettings& step) {
    bench::FourGuts alone(shape_of(1000), step, 1), both(shape_of(1000), step, 2);
    const auto real_time = [](bench::FourGuts& guts, clockid_t clock, double threads) {
      const int ticks = steps_in(kMeasure_s / 2, bench::FourGuts::kTick_s);
      return threads * 1e6 * bench::FourGuts::kTick_s /
             median_us(
                 ticks, [&] { guts.tick(); }, clock);
    };
    const int settle = steps_in(kSettle_s, bench::FourGuts::kTick_s);
    for (int i = 0; i < settle; ++i) alone.tick();
    add({.name = name + "/one_thread/real_time",
         .value = real_time(alone, CLOCK_THREAD_CPUTIME_ID, 1),
         .unit = "1"});
    fall(name, both, settle);
    add({.name = name + "/two_threads/real_time",
         .value = real_time(both, CLOCK_MONOTONIC, 1),
         .unit = "1",
         .limit = 1});
    add({.name = name + "/two_cores/real_time",
         .value = real_time(both, CLOCK_PROCESS_CPUTIME_ID, 2),
         .unit = "1",
         .limit = 1});
    results_.compare(prefix(name + "/two_threads/real_time"), prefix(name + "/one_thread/real_time"));
  }

  /// Counts what passed through what, and pairs that touch in the end.
  void fall(const std::string& name, bench::FourGuts& guts, int ticks) {
    std::int64_t crossings = 0;
    auto from = guts.places();
    for (int i = 1; i <= ticks; ++i) {
      guts.tick();
      if (i % kTicksPerCount != 0) continue;
      const auto to = guts.places();
      crossings += guts.crossings(from, to);
      from = to;
    }
    add({.name = name + "/touching", .value = static_cast<double>(guts.touching()), .unit = "1"});
    add({.name = name + "/crossings", .value = static_cast<double>(crossings), .unit = "1", .limit = 0});
  }

  void calm() {
    calm("calm/5ms", {});
    calm("calm/2.5ms", {.step_s = 2.5e-3, .iterations = 5});
  }

  void calm(const std::string& name, const GutStepSettings& settings) {
    GutSystem gut(shape_of(100), {}, {}, settings);
    const double step_s = gut.settings().step_s;
    double speed = 0, deepest_m = 0;
    const int all = steps_in(10, step_s), last = steps_in(1, step_s);
    for (int i = 0; i < all; ++i) {
      gut.step({.obstacles = kPlane});
      if (i < all - last) continue;
      speed += mean_speed_m_s(gut.state()) / last;
      deepest_m = std::max(deepest_m, gut.report().collisions.deepest_m);
    }
    add({.name = name + "/mean_speed", .value = speed, .unit = "m/s", .limit = kCalmLimit_m_s});
    add({.name = name + "/deepest",
         .value = deepest_m / gut.shape().tube_radius_m,
         .unit = "1",
         .limit = kDepthLimit});
  }

  void long_run() {
    GutSystem gut(shape_of(100), {}, {}, {});
    const double step_s = gut.settings().step_s, begin = now_s();
    std::int64_t early = 0, most = 0;
    for (int minute = 0; minute < 10; ++minute) {
      for (int i = 0; i < steps_in(60, step_s); ++i) {
        const double turn = 0.5 * i * step_s;  // a probe that stirs
        const Vec3 at(0.12 * std::cos(turn), 0.12 * std::sin(turn), 0.05 + 0.08 * std::sin(0.3 * turn));
        const std::array probe{MovingSphere{.before = probe_at_, .after = at, .radius_m = 0.01}};
        gut.step({.obstacles = kPlane, .spheres = probe});
        probe_at_ = gut.outcomes()[0].reached;
        most = std::max(most, gut.report().collisions.pairs_tracked);
      }
      if (minute == 0) early = most;
    }
    const bool whole = !gut.report().diverged;
    add({.name = "long_run/real_time",
         .value = whole ? 600 / (now_s() - begin) : 0,
         .unit = "1",
         .limit = 1});
    add({.name = "long_run/most_pairs",
         .value = static_cast<double>(most),
         .unit = "1",
         .reference = static_cast<double>(early),
         .ratio = static_cast<double>(most) / static_cast<double>(early)});
  }

 private:
  static std::string prefix(const std::string& name) { return "intestine/" + name; }

  void add(bench::Entry entry) {
    entry.name = prefix(entry.name);
    std::printf("%-34s %10.4g %s\n", entry.name.c_str(), entry.value, entry.unit.c_str());
    std::fflush(stdout);
    results_.add(std::move(entry));
  }

  double settled_us(GutSystem& gut) {
    const double step_s = gut.settings().step_s;
    const auto step = [&] { gut.step({.obstacles = kPlane}); };
    for (int i = 0; i < steps_in(kSettle_s, step_s); ++i) step();
    return median_us(steps_in(kMeasure_s, step_s), step);
  }

  void measure(GutSystem& gut, const std::string& name) {
    const double us = settled_us(gut), masses = static_cast<double>(gut.state().x.size());
    add({.name = name, .value = us, .unit = "us"});
    add({.name = name + "/per_mass", .value = 1e3 * us / masses, .unit = "ns"});
    add({.name = name + "/real_time", .value = 1e6 * gut.settings().step_s / us, .unit = "1", .limit = 1});
    results_.compare(prefix(name + "/per_mass"), prefix("step/400/per_mass"));
  }

  template <class Step>
  double alone_us(const GutSprings& springs, const geometry::GutShape& shape, const Step& step) {
    GutState state{shape.positions, std::vector<Vec3>(shape.positions.size(), Vec3::Zero())};
    std::vector<Vec3> weight;
    for (const double m : springs.mass()) weight.push_back(m * Vec3(0, 0, -9.81));
    return median_us(2000, [&] { step(weight, state); });
  }

  bench::Results& results_;
  Vec3 probe_at_ = Vec3(0.12, 0, 0.3);
};

}  // namespace

int main(int argc, char** argv) {
  bench::Results results(argc, argv);
  Bench bench(results);
  const std::vector<std::pair<std::string, void (Bench::*)()>> cases{
      {"step", &Bench::step},           {"stochastic", &Bench::stochastic},
      {"springs", &Bench::springs},     {"explicit", &Bench::explicit_step},
      {"four_guts", &Bench::four_guts}, {"calm", &Bench::calm},
      {"long_run", &Bench::long_run}};
  const std::vector<std::string> named(argv + 1, argv + argc);
  for (const auto& [word, run] : cases) {
    const bool asked = std::ranges::find(named, word) != named.end();
    if (asked || (named.empty() && word != "long_run")) (bench.*run)();
  }
  results.write();
}
