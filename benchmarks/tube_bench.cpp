// What the processor does for the picture of a tube (Raghupathi 2004, section 5), of 100 and of 1,000 axis
// masses.
//   tube_frames/N      spline, split, frames and the light from all around: all that skinning on the card
//   leaves tube_split/N       of it, what another eps costs: the axis stays tube_sweep/N       the same state
//   as a mesh of the processor's (render_node/tube_skin)
// Counters: frames, sections and vertices that are drawn or sent. The tube moves from step to step, folded to
// and fro (tube_compare/tube_trial), as it is drawn without a person's choice. Time of the thread, not of the
// clock.
#include "benchmarks/json_reporter.h"
#include "render_node/tube_compare/tube_trial.h"
#include "render_node/tube_cylinder.h"
#include "render_node/tube_skin.h"

#include <benchmark/benchmark.h>

#include <cmath>

#include <time.h>

namespace {

using namespace omentum;
using namespace omentum::render;

constexpr double kLimit_us = 100;  // of 100 masses: issue 12
constexpr std::size_t kStates = 32;
constexpr double kMostFolded = 0.45;  // folds of 65 degrees at a mass, as gut that lies in loops has

double cpu_s() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

class States {
 public:
  explicit States(std::size_t masses) {
    for (std::size_t s = 0; s < kStates; ++s) {
      const double phase = static_cast<double>(s) / kStates;
      states_.push_back(trial::folding_axis(masses, kMostFolded * std::abs(2 * phase - 1)));
    }
  }
  const std::vector<geometry::Vec3>& next() { return states_[++now_ % kStates]; }

 private:
  std::vector<std::vector<geometry::Vec3>> states_;
  std::size_t now_ = 0;
};

template <class Step>
void time_thread(benchmark::State& state, Step&& step) {
  for (auto _ : state) {
    const double begin_s = cpu_s();
    step();
    state.SetIterationTime(cpu_s() - begin_s);
  }
}

void frames(benchmark::State& state) {
  States states(static_cast<std::size_t>(state.range(0)));
  TubeFrames tube(states.next(), trial::kRadius_m);
  time_thread(state, [&] { tube.deform(states.next()); });
  state.counters["frames"] = static_cast<double>(tube.frames().size());
  state.counters["vertices"] =
      static_cast<double>(tube_cost(tube.frames().size(), TubeResolution{}.n).vertices);
}

void split(benchmark::State& state) {
  States states(static_cast<std::size_t>(state.range(0)));
  TubeFrames tube(states.next(), trial::kRadius_m);
  bool is_fine = false;
  time_thread(state, [&] { tube.set_eps((is_fine = !is_fine) ? kFinestTubeEps : kCoarsestTubeEps); });
}

void sweep(benchmark::State& state) {
  States states(static_cast<std::size_t>(state.range(0)));
  TubeSkin tube(states.next(), trial::kRadius_m);
  time_thread(state, [&] { tube.deform(states.next()); });
  state.counters["vertices"] = static_cast<double>(tube.mesh().vertices.size());
}

}  // namespace

int main(int argc, char** argv) {
  omentum::bench::Results results(argc, argv);
  benchmark::Initialize(&argc, argv);
  const auto add = [](const char* name, void (*run)(benchmark::State&)) {
    benchmark::RegisterBenchmark(name, run)->Arg(100)->Arg(1000)->UseManualTime()->Unit(
        benchmark::kMicrosecond);
  };
  add("tube_frames", frames);
  add("tube_split", split);
  add("tube_sweep", sweep);
  omentum::bench::JsonReporter reporter(results);
  benchmark::RunSpecifiedBenchmarks(&reporter);
  results.limit("tube_frames/100", kLimit_us);
  for (const char* masses : {"/100", "/1000"})
    results.compare(std::string("tube_frames") + masses, std::string("tube_sweep") + masses);
  results.write();
}
