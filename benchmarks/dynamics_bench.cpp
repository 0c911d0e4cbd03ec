// What moving an organ costs: the force of a tensor-mass model, cutting it, and steps of the explicit
// schemes.
//   force/MESH/KERNEL      one evaluation; counters: the median call, and that per edge
//   force/MESH/double      the same in double throughout
//   energy/MESH            in double
//   remove/MESH            one tetrahedron's ten tensors taken out, or put back
//   step/MESH/SCHEME       one step at 0.9 of the stable one, damped as forward Euler needs it; counter
//   real_time: simulated over elapsed time
// Meshes: the 7,185-tetrahedra liver beside the repository (OMENTUM_BENCH_MESH takes another, in
// millimetres), or a box of about its size; a box of 9,936 nodes.
#include "benchmarks/bench_mesh.h"
#include "benchmarks/json_reporter.h"
#include "physics/dynamics/explicit_step.h"
#include "physics/dynamics/stable_step.h"
#include "physics/dynamics/tensor_mass.h"
#include "tests/support/meshes.h"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <iostream>
#include <memory>
#include <random>

namespace {

using namespace omentum;
using namespace omentum::physics;
using Arithmetic = TensorMass::Arithmetic;
using Clock = std::chrono::steady_clock;

constexpr double kSupportDepth_m = 5e-3;  // held at x below its smallest x + 5 mm
constexpr Material kLiver{5000, 0.45, 1050};
constexpr double kPerEdgeLimit_ns = 1.6;
constexpr double kRemovalLimit_us = 10;  // repair and surface included
// Heavy enough for forward Euler to have a stable step: the share of critical damping of the highest mode.
constexpr double kHighestDamping = 0.14;

struct Organ {
  std::string name;
  geometry::TetraMesh mesh;
  Inertia inertia;
  std::vector<double> u, f;
  HighestFrequency highest;

  Organ(std::string called, geometry::TetraMesh of)
      : name(std::move(called)), mesh(std::move(of)), inertia{lumped_masses(mesh, kLiver), {}} {
    double low = mesh.positions[0].x();
    for (const Vec3& p : mesh.positions) low = std::min(low, p.x());
    for (const Vec3& p : mesh.positions) inertia.fixed.push_back(p.x() < low + kSupportDepth_m ? kPinned : 0);
    std::mt19937 generator(1);
    std::normal_distribution<double> normal(0, 1e-3);
    u.resize(3 * mesh.positions.size());
    f.resize(u.size());
    std::ranges::generate(u, [&] { return normal(generator); });
    TensorMass law(mesh, kLiver);
    highest = highest_frequency(law, inertia);
    std::cerr << name << ": " << mesh.positions.size() << " nodes, " << mesh.tetrahedra.size()
              << " tetrahedra, " << law.books().edges().size() << " edges, fastest mode " << highest.rad_s
              << " rad/s after " << highest.evaluations << " evaluations\n";
  }
};

// The time of a typical call: the median is what other programs on the machine disturb least.
class CallTimes {
 public:
  template <class Call>
  void measure(benchmark::State& state, Call&& call) {
    const auto start = Clock::now();
    call();
    seconds_.push_back(std::chrono::duration<double>(Clock::now() - start).count());
    state.SetIterationTime(seconds_.back());
  }
  double median_s() {
    const auto middle = seconds_.begin() + static_cast<std::ptrdiff_t>(seconds_.size() / 2);
    std::ranges::nth_element(seconds_, middle);
    return *middle;
  }

 private:
  std::vector<double> seconds_;
};

void force(benchmark::State& state, Organ& organ, TensorMass& law) {
  CallTimes times;
  for (auto _ : state) times.measure(state, [&] { law.forces(organ.u, organ.f); });
  const double median = times.median_s();
  state.counters["median_us"] = 1e6 * median;
  state.counters["per_edge_ns"] = 1e9 * median / static_cast<double>(law.books().edges().size());
}

void energy(benchmark::State& state, Organ& organ, const TensorMass& law) {
  CallTimes times;
  for (auto _ : state) times.measure(state, [&] { benchmark::DoNotOptimize(law.energy(organ.u)); });
  state.counters["median_us"] = 1e6 * times.median_s();
}

void removal(benchmark::State& state, Organ& organ) {
  TensorMass law(organ.mesh, kLiver);
  std::vector<geometry::TetId> order;
  for (std::size_t t = 0; t < organ.mesh.tetrahedra.size(); ++t) order.emplace_back(t);
  std::ranges::shuffle(order, std::mt19937(2));
  std::size_t next = 0;
  bool gone = false;
  CallTimes times;
  for (auto _ : state) {
    times.measure(state, [&] { gone ? law.add(order[next]) : law.remove(order[next]); });
    if (++next < order.size()) continue;
    next = 0;
    gone = !gone;
  }
  state.counters["median_us"] = 1e6 * times.median_s();
}

void step(benchmark::State& state, Organ& organ, ExplicitScheme scheme) {
  TensorMass law(organ.mesh, kLiver);
  Inertia inertia = organ.inertia;
  inertia.stiffness_damping_s = 2 * kHighestDamping / organ.highest.rad_s;
  const double dt = 0.9 * stable_step_s(scheme, inertia, organ.highest.rad_s);
  ExplicitStep stepper(scheme, inertia);
  BodyState body = state_at_rest(organ.mesh.positions.size());
  const std::vector<double> pull(body.u.size(), 1e-6);
  CallTimes times;
  for (auto _ : state)
    times.measure(state, [&] { benchmark::DoNotOptimize(stepper.step(law, pull, dt, body)); });
  const double median = times.median_s();
  state.counters["median_us"] = 1e6 * median;
  state.counters["dt_us"] = 1e6 * dt;
  state.counters["real_time"] = dt / median;
}

void add_all(Organ& organ) {
  const auto named = [&](const std::string& what) { return what + "/" + organ.name; };
  for (const kernels::EdgeKernel& kernel : kernels::edge_kernels()) {
    const auto law = std::make_shared<TensorMass>(organ.mesh, kLiver, Arithmetic::kFloat, kernel);
    benchmark::RegisterBenchmark((named("force") + "/" + kernel.name).c_str(),
                                 [&organ, law](benchmark::State& state) { force(state, organ, *law); })
        ->Unit(benchmark::kMicrosecond)
        ->UseManualTime();
  }
  const auto exact = std::make_shared<TensorMass>(organ.mesh, kLiver, Arithmetic::kDouble);
  benchmark::RegisterBenchmark((named("force") + "/double").c_str(),
                               [&organ, exact](benchmark::State& state) { force(state, organ, *exact); })
      ->Unit(benchmark::kMicrosecond)
      ->UseManualTime();
  benchmark::RegisterBenchmark(named("energy").c_str(),
                               [&organ, exact](benchmark::State& state) { energy(state, organ, *exact); })
      ->Unit(benchmark::kMicrosecond)
      ->UseManualTime();
  benchmark::RegisterBenchmark(named("remove").c_str(),
                               [&organ](benchmark::State& state) { removal(state, organ); })
      ->Unit(benchmark::kMicrosecond)
      ->UseManualTime();
  for (const ExplicitScheme scheme : kExplicitSchemes) {
    benchmark::RegisterBenchmark((named("step") + "/" + name_of(scheme)).c_str(),
                                 [&organ, scheme](benchmark::State& state) { step(state, organ, scheme); })
        ->Unit(benchmark::kMicrosecond)
        ->UseManualTime();
  }
}

void set_limits(bench::Results& results, const Organ& organ) {
  const std::string force = "force/" + organ.name + "/", removal = "remove/" + organ.name;
  const std::string best = force + kernels::edge_kernels().front().name;
  results.limit(best + "/per_edge_ns", kPerEdgeLimit_ns);
  results.limit(removal + "/median_us", kRemovalLimit_us);
  for (const kernels::EdgeKernel& kernel : kernels::edge_kernels())
    results.compare(force + kernel.name + "/median_us", force + "double/median_us");
}

}  // namespace

int main(int argc, char** argv) {
  bench::Results results(argc, argv);
  benchmark::Initialize(&argc, argv);
  std::array<Organ, 2> organs{Organ{"liver_7k", bench::bench_mesh()},
                              Organ{"box_10k", test::make_box_mesh(22, 23, 17, {0.2, 0.2, 0.15})}};
  for (Organ& organ : organs) add_all(organ);
  bench::JsonReporter reporter(results);
  benchmark::RunSpecifiedBenchmarks(&reporter);
  for (const Organ& organ : organs) set_limits(results, organ);
  results.write();
}
