// What a step on a kept factor costs, and what a cut costs it.
//   factorize/MESH         ordering and factorization anew, which others do in every step
//   cholmod/MESH           CHOLMOD's solve, in double
//   step/MESH/REMOVED      one implicit step after so many removals
//   downdate/MESH          one tetrahedron taken off the factor, 300 in turn; counter median_us
//   cut_step/MESH          the same and a step; counter median_us
//   compliance/MESH        the block of 24 neighbouring nodes
// Meshes: the 7,185-tetrahedra liver beside the repository (OMENTUM_BENCH_MESH takes another, in
// millimetres), or a box of about its size; a box of 9,936 nodes; a box of 4,807 nodes and 23,760 tetrahedra.
#include "benchmarks/bench_mesh.h"
#include "benchmarks/json_reporter.h"
#include "organ_tools/fast_blas.h"
#include "physics/blas_threads.h"
#include "physics/dynamics/implicit_step.h"
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
using Clock = std::chrono::steady_clock;

constexpr double kSupportDepth_m = 5e-3;  // held at x below its smallest x + 5 mm
constexpr Material kLiver{5000, 0.45, 1050};
constexpr double kStep_s = 5e-3;
constexpr double kDrag_per_s = 1;
constexpr std::size_t kRemovals = 300;
constexpr std::size_t kComplianceNodes = 24;

struct Organ {
  std::string name;
  geometry::TetraMesh mesh;
  Inertia inertia;
  std::vector<double> weight;
  std::vector<geometry::TetId> order;  // in which tetrahedra are removed
  std::unique_ptr<ImplicitStep> stepper;
  BodyState state;

  Organ(std::string called, geometry::TetraMesh of)
      : name(std::move(called)), mesh(std::move(of)), inertia{lumped_masses(mesh, kLiver), {}, kDrag_per_s} {
    double low = mesh.positions[0].x();
    for (const Vec3& p : mesh.positions) low = std::min(low, p.x());
    for (const Vec3& p : mesh.positions) inertia.fixed.push_back(p.x() < low + kSupportDepth_m ? kPinned : 0);
    for (const double mass : inertia.mass) weight.insert(weight.end(), {0.0, -9.81 * mass, 0.0});
    for (std::size_t t = 0; t < mesh.tetrahedra.size(); ++t) order.emplace_back(t);
    std::ranges::shuffle(order, std::mt19937(1));
    stepper = std::make_unique<ImplicitStep>(mesh, kLiver, inertia, ImplicitOptions{.step_s = kStep_s});
    state = state_at_rest(mesh.positions.size());
    std::cerr << name << ": " << mesh.positions.size() << " nodes, " << mesh.tetrahedra.size()
              << " tetrahedra, " << 1e-6 * static_cast<double>(stepper->factor().entry_count())
              << " million entries\n";
  }
};

Stiffness system_of(const Organ& organ) {
  Stiffness A = assemble_stiffness(organ.mesh, kLiver);
  for (std::int32_t n = 0; n < A.node_count(); ++n) {
    for (std::int32_t b = A.start[n]; b < A.start[n + 1]; ++b) {
      A.block[b] *= kStep_s * kStep_s;
      if (A.neighbour[b] == n)
        A.block[b].diagonal().array() += (1 + kStep_s * kDrag_per_s) * organ.inertia.mass[n];
    }
  }
  return A;
}

void factorize(benchmark::State& state, Organ& organ) {
  const Stiffness A = system_of(organ);
  const FreeDofs free = free_dofs(organ.inertia.fixed);
  for (auto _ : state) benchmark::DoNotOptimize(StiffnessFactor(A, free));
}

void cholmod(benchmark::State& state, Organ& organ) {
  const FreeDofs free = free_dofs(organ.inertia.fixed);
  const StiffnessFactor factor(system_of(organ), free);
  const Eigen::MatrixXd f = Eigen::MatrixXd::Ones(free.count, 1);
  for (auto _ : state) benchmark::DoNotOptimize(factor.solve(f).data());
}

void require(benchmark::State& state, bool ok) {
  if (!ok) state.SkipWithError("not finite or not positive definite");
}

void step(benchmark::State& state, Organ& organ) {
  organ.stepper->restore();
  organ.state = state_at_rest(organ.mesh.positions.size());
  require(state, organ.stepper->remove({organ.order.data(), static_cast<std::size_t>(state.range(0))}));
  for (auto _ : state) require(state, organ.stepper->step(organ.state, organ.weight));
}

// One removal an iteration, from the uncut organ again after kRemovals, with what `more` does after each.
template <class More>
void remove_in_turn(benchmark::State& state, Organ& organ, More more) {
  organ.state = state_at_rest(organ.mesh.positions.size());
  std::vector<double> times;
  std::size_t next = kRemovals;
  for (auto _ : state) {
    if (next == kRemovals) {
      organ.stepper->restore();
      next = 0;
    }
    const auto start = Clock::now();
    require(state, organ.stepper->remove({&organ.order[next++], 1}));
    more();
    times.push_back(std::chrono::duration<double>(Clock::now() - start).count());
    state.SetIterationTime(times.back());
  }
  std::ranges::nth_element(times, times.begin() + static_cast<std::ptrdiff_t>(times.size() / 2));
  state.counters["median_us"] = 1e6 * times[times.size() / 2];
}

void downdate(benchmark::State& state, Organ& organ) {
  remove_in_turn(state, organ, [] {});
}

void cut_step(benchmark::State& state, Organ& organ) {
  remove_in_turn(state, organ, [&] { require(state, organ.stepper->step(organ.state, organ.weight)); });
}

void compliance(benchmark::State& state, Organ& organ) {
  const Vec3 centre = organ.mesh.positions[organ.mesh.tetrahedra[organ.order[0]][0]];
  std::vector<geometry::NodeId> nodes;
  for (std::size_t n = 0; n < organ.mesh.positions.size(); ++n) nodes.emplace_back(n);
  std::ranges::sort(nodes, {}, [&](geometry::NodeId n) { return (organ.mesh.positions[n] - centre).norm(); });
  nodes.resize(kComplianceNodes);
  std::vector<float> block(9 * kComplianceNodes * kComplianceNodes);
  for (auto _ : state) organ.stepper->compliance(nodes, block);
}

void compare(bench::Results& results, const std::string& mesh) {
  for (const char* what : {"step/", "downdate/", "cut_step/"}) {
    const std::string name = what + mesh;
    results.compare(what == std::string("step/") ? name + "/300" : name, "factorize/" + mesh);
  }
}

void set_limits(bench::Results& results) {
  for (const char* removed : {"0", "1", "300"}) {
    results.limit(std::string("step/liver/") + removed, 250);
    results.limit(std::string("step/box10k/") + removed, 6000);
  }
  results.limit("downdate/liver/median_us", 350);
  results.limit("downdate/box10k/median_us", 6000);
  results.limit("cut_step/box5k/median_us", 3000);
}

}  // namespace

int main(int argc, char** argv) {
  organ_tools::start_with_fast_blas(argv);  // as the programs do
  bench::Results results(argc, argv);
  benchmark::Initialize(&argc, argv);
  const BlasThreads one(1);
  Organ organs[] = {{"liver", bench::bench_mesh()},
                    {"box5k", test::make_box_mesh(18, 10, 22, {0.2, 0.11, 0.24})},
                    {"box10k", test::make_box_mesh(22, 17, 23, {0.2, 0.15, 0.2})}};
  for (Organ& organ : organs) {
    const auto add = [&](const char* name, void (*run)(benchmark::State&, Organ&)) {
      return benchmark::RegisterBenchmark((std::string(name) + "/" + organ.name).c_str(),
                                          [&organ, run](benchmark::State& state) { run(state, organ); })
          ->Unit(benchmark::kMicrosecond);
    };
    add("factorize", factorize);
    add("cholmod", cholmod);
    add("step", step)->Arg(0)->Arg(1)->Arg(kRemovals);
    add("downdate", downdate)->UseManualTime();
    add("cut_step", cut_step)->UseManualTime();
    add("compliance", compliance);
  }
  bench::JsonReporter reporter(results);
  benchmark::RunSpecifiedBenchmarks(&reporter);
  for (const Organ& organ : organs) compare(results, organ.name);
  set_limits(results);
  results.write();
}
