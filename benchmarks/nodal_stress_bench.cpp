// What strain and stress at an organ's surface cost, while somebody reads them.
//   nodal_stress/copied    what the loop does for it: a body's displacements and surface, copied
//   nodal_stress/linear    tensor-mass: measured beside the loop, on the publishing thread
//   nodal_stress/turned    co-rotational, likewise
//   nodal_stress/forces    for comparison: one evaluation of the co-rotational law's forces
// The mesh is that of bench_mesh.h; displacements are random, a millimetre.
#include "benchmarks/bench_mesh.h"
#include "benchmarks/json_reporter.h"
#include "geometry/surface.h"
#include "physics/dynamics/corotational.h"
#include "physics/nodal_stress.h"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <iostream>
#include <random>

namespace {

using namespace omentum;
using namespace omentum::physics;

constexpr Material kLiver{5000, 0.45, 1050};
constexpr double kCopyLimit_us = 100;  // a hundredth of a tick of deform_node

struct Body {
  geometry::TetraMesh mesh = bench::bench_mesh();
  geometry::Surface surface = geometry::extract_surface(mesh, {});
  std::vector<double> u = std::vector<double>(3 * mesh.positions.size());

  Body() {
    std::mt19937 generator(1);
    std::normal_distribution<double> normal(0, 1e-3);
    std::ranges::generate(u, [&] { return normal(generator); });
    std::cerr << mesh.tetrahedra.size() << " tetrahedra, " << surface.node.size() << " of "
              << mesh.positions.size() << " nodes on the surface\n";
  }
};

void copy(benchmark::State& state, const Body& body) {
  std::vector<double> u = body.u;
  std::vector<geometry::NodeId> surface = body.surface.node;
  for (auto _ : state) {
    std::ranges::copy(body.u, u.begin());
    std::ranges::copy(body.surface.node, surface.begin());
    benchmark::DoNotOptimize(u.data());
    benchmark::DoNotOptimize(surface.data());
  }
}

void measure(benchmark::State& state, const Body& body, StressLaw law) {
  NodalStress nodal(body.mesh, kLiver, law);
  std::vector<float> strain(body.surface.node.size()), stress_pa(strain.size());
  for (auto _ : state) {
    nodal.measure({body.u, {}, body.surface.node}, strain, stress_pa);
    benchmark::DoNotOptimize(strain.data());
  }
}

void evaluate_forces(benchmark::State& state, const Body& body) {
  Corotational law(body.mesh, kLiver);
  std::vector<double> f(body.u.size());
  for (auto _ : state) {
    law.forces(body.u, f);
    benchmark::DoNotOptimize(f.data());
  }
}

}  // namespace

int main(int argc, char** argv) {
  omentum::bench::Results results(argc, argv);
  benchmark::Initialize(&argc, argv);
  const Body body;
  const auto add = [](const char* name, auto&& run) {
    return benchmark::RegisterBenchmark(name, run)->Unit(benchmark::kMicrosecond);
  };
  add("nodal_stress/copied", [&](benchmark::State& state) { copy(state, body); });
  add("nodal_stress/linear", [&](benchmark::State& state) { measure(state, body, StressLaw::kLinear); });
  add("nodal_stress/turned", [&](benchmark::State& state) { measure(state, body, StressLaw::kTurned); });
  add("nodal_stress/forces", [&](benchmark::State& state) { evaluate_forces(state, body); });
  omentum::bench::JsonReporter reporter(results);
  benchmark::RunSpecifiedBenchmarks(&reporter);
  results.limit("nodal_stress/copied", kCopyLimit_us);
  results.compare("nodal_stress/turned", "nodal_stress/forces");
  results.write();
}
