// Precomputation and superposition of the force tensors: seconds, and ratios within one run.
//   organ_build          the program from mesh to organ file; counter peak_of_tensors: its largest resident
//                        memory over the bytes of the tensors it stores
//   factorize            ordering and factorization
//   columns_reference    all columns plainly: CHOLMOD's solve, one thread, blocks of 100 right-hand sides
//   columns/T            all columns by T workers; counter of_reference: time over the plain program's
//   superpose/P          the whole surface under P contact nodes, GB/s of tiles; counter of_stream: part of a
//                        plain stream's bandwidth in this run
// The organ: OMENTUM_BENCH_MESH (millimetres; by default the 7,185-tetrahedra liver beside the repository, or
// a box).
#include "benchmarks/bench_mesh.h"
#include "benchmarks/child_run.h"
#include "benchmarks/json_reporter.h"
#include "organ_tools/fast_blas.h"
#include "physics/blas_threads.h"
#include "physics/direct_solve.h"
#include "physics/force_tensors.h"
#include "physics/surface_compliance.h"
#include "tests/support/meshes.h"
#include "tests/support/process.h"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <iostream>
#include <memory>

namespace {

using namespace omentum;
using namespace omentum::physics;
using Clock = std::chrono::steady_clock;

constexpr double kSupportDepth_m = 5e-3;  // issue 2: held at x below its smallest x + 5 mm
constexpr Material kLiver{3000, 0.45, 1050};
constexpr int kReferenceBlock =
    100;  // right-hand sides; CHOLMOD is slower with fewer and no faster with more

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// Below this x the organ is held.
double support_plane(const geometry::TetraMesh& mesh) {
  double low = mesh.positions[0].x();
  for (const Vec3& p : mesh.positions) low = std::min(low, p.x());
  return low + kSupportDepth_m;
}

struct OrganBuild {
  double seconds = 0;
  double peak_bytes = 0;
  double idle_bytes = 0;  // of these, what the program and its libraries take before they do anything
};

// While this process is small (bench::run_child).
OrganBuild run_organ_build(const geometry::TetraMesh& mesh) {
  const test::ScratchFolder folder;
  const std::string program = OMENTUM_BIN_DIR "/organ_build";
  geometry::write_mesh(mesh, folder / "organ.msh");
  const bench::ChildRun idle = bench::run_child(program, {"--help"});
  const bench::ChildRun build =
      bench::run_child(program, {folder / "organ.msh", "-o", folder / "organ.h5", "--scale", "1", "--young",
                                 std::to_string(kLiver.young_pa), "--poisson", std::to_string(kLiver.poisson),
                                 "--density", std::to_string(kLiver.density_kg_m3), "--fixed",
                                 "plane:x<" + std::to_string(support_plane(mesh))});
  if (build.exit != 0) throw std::runtime_error("organ_build ended with code " + std::to_string(build.exit));
  return {build.seconds, build.peak_bytes, idle.peak_bytes};
}

struct Bench {
  geometry::TetraMesh mesh = bench::bench_mesh();
  OrganBuild built = run_organ_build(mesh);
  FixedComponents fixed;
  geometry::Surface surface;
  Stiffness stiffness = assemble_stiffness(mesh, kLiver);
  FreeDofs free;
  std::unique_ptr<StiffnessFactor> factor;
  std::shared_ptr<float> memory;
  ComplianceTiles<float> tiles;
  std::vector<float> bounds;
  double reference_s = 0;     // set by columns_reference
  double stream_bytes_s = 0;  // set by stream

  Bench() {
    const double plane = support_plane(mesh);
    for (const Vec3& p : mesh.positions) fixed.push_back(p.x() < plane ? kPinned : 0);
    surface = geometry::extract_surface(mesh, pinned_nodes(fixed));
    free = free_dofs(fixed);
    factor = std::make_unique<StiffnessFactor>(stiffness, free);
    tiles.mobile_count = surface.mobile_count;
    memory.reset(static_cast<float*>(std::aligned_alloc(64, tiles.size() * sizeof(float))), std::free);
    tiles.values = memory.get();
    std::fill_n(tiles.values, tiles.size(), 0.0f);
    bounds.resize(static_cast<std::size_t>(tiles.mobile_count) * tiles.cluster_count());
    std::cerr << mesh.positions.size() << " nodes, " << mesh.tetrahedra.size() << " tetrahedra, "
              << 3 * surface.mobile_count << " columns; " << blas_description() << "\n";
  }
};

// Reports the run that was made before anything else was in memory.
void organ_build(benchmark::State& state, Bench& b) {
  for (auto _ : state) state.SetIterationTime(b.built.seconds);
  const auto tensors = static_cast<double>(b.tiles.size() * sizeof(float));
  state.counters["peak_MB"] = 1e-6 * b.built.peak_bytes;
  state.counters["idle_MB"] = 1e-6 * b.built.idle_bytes;
  state.counters["tensors_MB"] = 1e-6 * tensors;
  state.counters["peak_of_tensors"] = b.built.peak_bytes / tensors;
}

void factorize(benchmark::State& state, Bench& b) {
  const BlasThreads one(1);
  for (auto _ : state) benchmark::DoNotOptimize(StiffnessFactor(b.stiffness, b.free));
}

void columns_reference(benchmark::State& state, Bench& b) {
  const BlasThreads one(1);
  std::vector<std::int32_t> dofs;
  for (std::int32_t s = 0; s < b.surface.mobile_count; ++s) {
    for (int axis = 0; axis < 3; ++axis) dofs.push_back(b.free.of(b.surface.node[s], axis));
  }
  for (auto _ : state) {
    const auto start = Clock::now();
    for (std::size_t first = 0; first < dofs.size(); first += kReferenceBlock) {
      const std::size_t count = std::min<std::size_t>(kReferenceBlock, dofs.size() - first);
      Eigen::MatrixXd unit = Eigen::MatrixXd::Zero(b.free.count, static_cast<Eigen::Index>(count));
      for (std::size_t q = 0; q < count; ++q) unit(dofs[first + q], static_cast<Eigen::Index>(q)) = 1;
      benchmark::DoNotOptimize(b.factor->solve(unit).data());
    }
    b.reference_s = seconds_since(start);
  }
}

void columns(benchmark::State& state, Bench& b) {
  TensorOptions options;
  options.threads = static_cast<int>(state.range(0));
  double seconds = 0;
  for (auto _ : state) {
    const auto start = Clock::now();
    if (!compute_force_tensors(*b.factor, b.free, b.surface, b.tiles, b.bounds, options))
      state.SkipWithError("stopped");
    seconds += seconds_since(start);
  }
  state.counters["of_reference"] = seconds / static_cast<double>(state.iterations()) / b.reference_s;
}

// Reads as many bytes as a superposition of 16 columns, as plainly as can be.
void stream(benchmark::State& state, Bench& b) {
  const std::size_t count =
      std::min<std::size_t>(16, b.surface.mobile_count) * b.tiles.size() / b.tiles.mobile_count;
  std::vector<float> copy(count);
  std::size_t from = 0;
  double seconds = 0;
  for (auto _ : state) {
    const auto start = Clock::now();
    std::copy_n(b.tiles.values + from, count, copy.data());
    benchmark::DoNotOptimize(copy.data());
    seconds += seconds_since(start);
    from = (from + count) % (b.tiles.size() - count);
  }
  b.stream_bytes_s =
      static_cast<double>(count * sizeof(float)) * static_cast<double>(state.iterations()) / seconds;
  state.counters["GB_s"] = b.stream_bytes_s * 1e-9;
}

void superpose(benchmark::State& state, Bench& b) {
  const auto count = static_cast<std::size_t>(state.range(0));
  const SurfaceCompliance compliance(b.tiles.mobile_count, b.tiles.values, b.bounds.data(), b.memory);
  std::vector<SurfaceId> nodes(count);
  const std::vector<Vec3> forces(count, Vec3(0.1, -0.2, 0.3));
  std::vector<float> u(48 * static_cast<std::size_t>(compliance.cluster_count()));
  std::int32_t first = 0;
  double seconds = 0;
  for (auto _ : state) {
    for (SurfaceId& n : nodes) n = SurfaceId(first++ % b.tiles.mobile_count);
    const auto start = Clock::now();
    superpose_surface(compliance, nodes, forces, u);
    benchmark::DoNotOptimize(u.data());
    seconds += seconds_since(start);
  }
  const double bytes = static_cast<double>(count * b.tiles.size() / b.tiles.mobile_count * sizeof(float));
  const double bytes_s = bytes * static_cast<double>(state.iterations()) / seconds;
  state.counters["GB_s"] = bytes_s * 1e-9;
  state.counters["of_stream"] = bytes_s / b.stream_bytes_s;
}

void compare(bench::Results& results) {
  results.compare("organ_build/peak_MB", "organ_build/tensors_MB");
  for (const char* name : {"columns/1", "columns/2"}) results.compare(name, "columns_reference");
  for (const char* name : {"superpose/1", "superpose/3", "superpose/16", "superpose/24"})
    results.compare(std::string(name) + "/GB_s", "stream/GB_s");
}

}  // namespace

int main(int argc, char** argv) {
  organ_tools::start_with_fast_blas(argv);  // as the programs do
  bench::Results results(argc, argv);
  benchmark::Initialize(&argc, argv);
  Bench bench;
  const auto add = [&](const char* name, void (*run)(benchmark::State&, Bench&)) {
    return benchmark::RegisterBenchmark(name, [&bench, run](benchmark::State& state) { run(state, bench); });
  };
  add("organ_build", organ_build)->Unit(benchmark::kMillisecond)->Iterations(1)->UseManualTime();
  add("factorize", factorize)->Unit(benchmark::kMillisecond);
  add("columns_reference", columns_reference)->Unit(benchmark::kMillisecond)->Iterations(1);
  add("columns", columns)
      ->Arg(1)
      ->Arg(2)
      ->Unit(benchmark::kMillisecond)
      ->MeasureProcessCPUTime()
      ->UseRealTime();
  add("stream", stream)->Unit(benchmark::kMicrosecond);
  add("superpose", superpose)->Arg(1)->Arg(3)->Arg(16)->Arg(24)->Unit(benchmark::kMicrosecond);
  bench::JsonReporter reporter(results);
  benchmark::RunSpecifiedBenchmarks(&reporter);
  compare(results);
  results.write();
}
