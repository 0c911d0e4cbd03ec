// What a cut costs whoever draws the organ, from its first tetrahedron to its last: single tetrahedra from
// one end of a plane to the other, through the whole organ, each a topology and a state of its own.
//   cut      the topology, the state that comes with it, and what is sent of it
//   state    a state alone, which every picture has: what a cut is to be small against
// Counters: median_us and p99_us, and for `cut` last_us, the mean of its last tenth, when most lies bare;
// sent_KB of triangles for each call, and whole_KB that a surface that is sent anew would have. The mesh is
// that of bench_mesh.h.
#include "benchmarks/bench_mesh.h"
#include "benchmarks/json_reporter.h"
#include "render_node/scene_view.h"
#include "tests/render_node/recording_renderer.h"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <iostream>
#include <numeric>

namespace {

using namespace omentum;
using geometry::TetId;
using render::Vec3;

constexpr double kTriangle_KB = sizeof(render::MeshTriangle) * 1e-3;

render::OrganShape shape_of(geometry::TetraMesh mesh) {
  render::OrganShape shape;
  shape.surface = geometry::extract_surface(mesh, {});
  shape.rest = geometry::surface_positions(mesh, shape.surface);
  shape.surface_of_file_node.resize(static_cast<std::size_t>(mesh.file_node_count));
  for (std::size_t n = 0; n < mesh.file_node.size(); ++n)
    shape.surface_of_file_node[static_cast<std::size_t>(mesh.file_node[n])] = shape.surface.of_node[n];
  shape.mesh = std::make_shared<const geometry::TetraMesh>(std::move(mesh));
  return shape;
}

struct Step {
  render::RemovedSet removed;
  std::vector<float> values;  // of its state: at rest
};

// What a plane across the middle of x meets, along y.
std::vector<Step> steps_along(const render::OrganShape& shape) {
  const geometry::TetraMesh& mesh = *shape.mesh;
  double low = mesh.positions.front().x(), high = low;
  for (const Vec3& p : mesh.positions) low = std::min(low, p.x()), high = std::max(high, p.x());
  std::vector<std::pair<double, TetId>> met;
  for (std::size_t t = 0; t < mesh.tetrahedra.size(); ++t) {
    int below = 0;
    double y = 0;
    for (const geometry::NodeId n : mesh.tetrahedra[t]) {
      const Vec3& p = mesh.positions[static_cast<std::size_t>(n)];
      below += p.x() < (low + high) / 2, y += p.y();
    }
    if (below > 0 && below < 4) met.emplace_back(y, TetId(t));
  }
  std::ranges::sort(met);
  geometry::MeshEditor editor(mesh, {.uncut_surface = shape.surface.node});
  std::vector<Step> steps;
  for (const auto& [y, t] : met) {
    if (editor.is_removed(t)) continue;
    editor.remove({&t, 1});
    Step& step = steps.emplace_back();
    step.removed.bits.assign(editor.removed_bits().begin(), editor.removed_bits().end());
    step.values.assign(3 * editor.surface_nodes().size(), 0.0f);
  }
  return steps;
}

double microseconds_of(auto&& call) {
  const auto start = std::chrono::steady_clock::now();
  call();
  return std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - start).count();
}

void report(std::vector<double> each_us, benchmark::State& state) {
  const auto tenth = static_cast<std::ptrdiff_t>(std::max<std::size_t>(1, each_us.size() / 10));
  state.counters["last_us"] =
      std::accumulate(each_us.end() - tenth, each_us.end(), 0.0) / static_cast<double>(tenth);
  std::ranges::sort(each_us);
  state.counters["median_us"] = each_us[each_us.size() / 2];
  state.counters["p99_us"] = each_us[each_us.size() * 99 / 100];
}

// `again`: each state comes once more, and only that is timed.
void follow(benchmark::State& state, const render::OrganShape& shape, const std::vector<Step>& steps,
            bool again) {
  std::vector<double> each_us;
  std::size_t sent = 0, whole = 0;
  for (auto _ : state) {
    render::RecordingRenderer renderer;
    render::SceneView view({}, std::vector{shape}, renderer);
    each_us.clear();
    for (const Step& step : steps) {
      const auto show = [&] { benchmark::DoNotOptimize(view.show(0, step.removed, step.values)); };
      const double first_us = microseconds_of(show);
      each_us.push_back(again ? microseconds_of(show) : first_us);
    }
    sent = renderer.triangles_sent;
    whole = renderer.meshes.front().triangles.size();
    state.SetIterationTime(1e-6 * std::accumulate(each_us.begin(), each_us.end(), 0.0));
  }
  report(each_us, state);
  if (again) return;
  state.counters["sent_KB"] = kTriangle_KB * static_cast<double>(sent) / static_cast<double>(steps.size());
  state.counters["whole_KB"] = kTriangle_KB * static_cast<double>(whole);
}

}  // namespace

int main(int argc, char** argv) {
  omentum::bench::Results results(argc, argv);
  benchmark::Initialize(&argc, argv);
  const render::OrganShape shape = shape_of(bench::bench_mesh());
  const std::vector<Step> steps = steps_along(shape);
  std::cerr << shape.mesh->tetrahedra.size() << " tetrahedra, " << shape.surface.triangles.size()
            << " triangles of their surface, " << steps.size() << " cuts\n";
  const auto add = [](const char* name, auto&& run) {
    benchmark::RegisterBenchmark(name, run)->Unit(benchmark::kMillisecond)->UseManualTime();
  };
  add("cut_view/cut", [&](benchmark::State& state) { follow(state, shape, steps, false); });
  add("cut_view/state", [&](benchmark::State& state) { follow(state, shape, steps, true); });
  omentum::bench::JsonReporter reporter(results);
  benchmark::RunSpecifiedBenchmarks(&reporter);
  results.write();
}
