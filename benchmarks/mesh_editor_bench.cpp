// The books of a mesh that is cut: microseconds of one removal with all that follows from it (repair,
// boundary, surface nodes, pieces).
//   make              an editor of the whole mesh
//   remove_at_random  single tetrahedra anywhere, half of the mesh
//   remove_along_cut  single tetrahedra from one end of a plane to the other, through the whole organ
//   set_removed       the whole half at once, as a process that joins late takes it up
//   follow_along_cut  the sets after each call of remove_along_cut, as another process hears them
// Counters: median_us and p99_us, of one call; repaired_of_asked, how many more went for each that was asked
// for. The mesh is that of bench_mesh.h.
#include "benchmarks/bench_mesh.h"
#include "benchmarks/json_reporter.h"
#include "geometry/mesh_editor.h"
#include "tests/support/meshes.h"

#include <benchmark/benchmark.h>

#include <chrono>
#include <iostream>
#include <numeric>
#include <random>

namespace {

using namespace omentum;
using geometry::TetId;
using geometry::Vec3;
using Clock = std::chrono::steady_clock;

constexpr double kLimit_us = 10;  // one tetrahedron of a 7k mesh, the tensors' share included

std::vector<TetId> half_at_random(const geometry::TetraMesh& mesh) {
  std::vector<TetId> order;
  for (std::size_t t = 0; t < mesh.tetrahedra.size(); ++t) order.emplace_back(t);
  std::shuffle(order.begin(), order.end(), std::mt19937(1));
  order.resize(order.size() / 2);
  return order;
}

// What a plane across the middle of x meets, along y.
std::vector<TetId> along_cut(const geometry::TetraMesh& mesh) {
  const auto at = [&](geometry::NodeId n) -> const Vec3& {
    return mesh.positions[static_cast<std::size_t>(n)];
  };
  double low = at(geometry::NodeId(0)).x(), high = low;
  for (const Vec3& p : mesh.positions) low = std::min(low, p.x()), high = std::max(high, p.x());
  const double middle = (low + high) / 2;
  std::vector<std::pair<double, TetId>> met;
  for (std::size_t t = 0; t < mesh.tetrahedra.size(); ++t) {
    int below = 0;
    double y = 0;
    for (const geometry::NodeId n : mesh.tetrahedra[t]) below += at(n).x() < middle, y += at(n).y();
    if (below > 0 && below < 4) met.emplace_back(y, TetId(t));
  }
  std::sort(met.begin(), met.end());
  std::vector<TetId> order;
  for (const auto& [y, t] : met) order.push_back(t);
  return order;
}

void make(benchmark::State& state, const geometry::TetraMesh& mesh) {
  for (auto _ : state) benchmark::DoNotOptimize(geometry::MeshEditor(mesh).removed_count());
}

double microseconds(Clock::duration time) {
  return std::chrono::duration<double, std::micro>(time).count();
}

// Times calls, and counts their median and 99th percentile.
class Calls {
 public:
  template <class Call>
  void time(Call&& call) {
    const auto start = Clock::now();
    call();
    each_us_.push_back(microseconds(Clock::now() - start));
  }
  std::size_t count() const { return each_us_.size(); }
  double total_us() const { return std::accumulate(each_us_.begin(), each_us_.end(), 0.0); }
  void report(benchmark::State& state) {
    std::ranges::sort(each_us_);
    state.counters["median_us"] = each_us_[each_us_.size() / 2];
    state.counters["p99_us"] = each_us_[each_us_.size() * 99 / 100];
  }

 private:
  std::vector<double> each_us_;
};

// One whole sequence an iteration, each from the uncut mesh on.
void remove_one_by_one(benchmark::State& state, const geometry::TetraMesh& mesh,
                       const std::vector<TetId>& order) {
  geometry::MeshEditor editor(mesh);
  Calls calls;
  std::size_t repaired = 0;
  for (auto _ : state) {
    const double before_us = calls.total_us();
    for (const TetId t : order) {
      if (!editor.is_removed(t)) calls.time([&] { repaired += editor.remove({&t, 1}).repaired.size(); });
    }
    state.SetIterationTime(1e-6 * (calls.total_us() - before_us));
    editor.restore();
  }
  state.counters["repaired_of_asked"] = static_cast<double>(repaired) / static_cast<double>(calls.count());
  calls.report(state);
}

void follow(benchmark::State& state, const geometry::TetraMesh& mesh, const std::vector<TetId>& order) {
  geometry::MeshEditor cut(mesh), editor(mesh);
  std::vector<std::vector<std::uint8_t>> sets;
  for (const TetId t : order) {
    if (cut.is_removed(t)) continue;
    cut.remove({&t, 1});
    sets.emplace_back(cut.removed_bits().begin(), cut.removed_bits().end());
  }
  Calls calls;
  for (auto _ : state) {
    const double before_us = calls.total_us();
    for (const auto& set : sets) calls.time([&] { editor.set_removed(set); });
    state.SetIterationTime(1e-6 * (calls.total_us() - before_us));
    editor.restore();
  }
  calls.report(state);
}

void set_removed(benchmark::State& state, const geometry::TetraMesh& mesh, const std::vector<TetId>& order) {
  geometry::MeshEditor cut(mesh), editor(mesh);
  cut.remove(order);
  for (auto _ : state) {
    const auto start = Clock::now();
    editor.set_removed(cut.removed_bits());
    state.SetIterationTime(1e-6 * microseconds(Clock::now() - start));
    editor.restore();
  }
}

}  // namespace

int main(int argc, char** argv) {
  omentum::bench::Results results(argc, argv);
  benchmark::Initialize(&argc, argv);
  const geometry::TetraMesh mesh = bench::bench_mesh();
  const std::vector<TetId> half = half_at_random(mesh), cut = along_cut(mesh);
  std::cerr << mesh.positions.size() << " nodes, " << mesh.tetrahedra.size() << " tetrahedra, " << cut.size()
            << " of them along the cut\n";
  const auto add = [](const char* name, auto&& run) {
    return benchmark::RegisterBenchmark(name, run)->Unit(benchmark::kMicrosecond);
  };
  add("mesh_editor/make", [&](benchmark::State& state) { make(state, mesh); });
  add("mesh_editor/remove_at_random", [&](benchmark::State& state) {
    remove_one_by_one(state, mesh, half);
  })->UseManualTime();
  add("mesh_editor/remove_along_cut", [&](benchmark::State& state) {
    remove_one_by_one(state, mesh, cut);
  })->UseManualTime();
  add("mesh_editor/follow_along_cut", [&](benchmark::State& state) {
    follow(state, mesh, cut);
  })->UseManualTime();
  add("mesh_editor/set_removed", [&](benchmark::State& state) {
    set_removed(state, mesh, half);
  })->UseManualTime();
  omentum::bench::JsonReporter reporter(results);
  benchmark::RunSpecifiedBenchmarks(&reporter);
  for (const char* name :
       {"mesh_editor/remove_at_random/median_us", "mesh_editor/remove_along_cut/median_us"})
    results.limit(name, kLimit_us);
  results.write();
}
