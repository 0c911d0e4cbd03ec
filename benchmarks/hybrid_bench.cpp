// What a hybrid organ's step costs, beside that of the same organ with masses everywhere (physics/hybrid).
//   step             one implicit step, nothing presses
//   step/pressed     the same with a tool imposed on the precomputed part (physics/dynamics/imposed_press.h)
//   step/cut         after 100 removals
//   whole, whole/pressed  all tetrahedra with masses
//   remove           one dynamic tetrahedron
//   hold             the condensed stiffness of the connection times a vector (physics/symmetric_tiles.h)
//   hold/plain       the same by Eigen
//   patch            the compliance of 24 nodes across the border, anew
//   anywhere...      the same of an organ that is cut in either part (physics/hybrid/hybrid_cut_step.h)
//   static/remove    as anywhere/remove, of an organ without masses (physics/static_factor.h)
// Mesh: benchmarks/bench_mesh.h; 18 % of the tetrahedra are dynamic, as in Cotin 1998, section 6.3. Counters:
// connection nodes, dynamic nodes.
#include "benchmarks/bench_mesh.h"
#include "benchmarks/json_reporter.h"
#include "organ/build_organ.h"
#include "organ_tools/fast_blas.h"
#include "physics/blas_threads.h"
#include "physics/dynamics/implicit_step.h"
#include "physics/dynamics/imposed_press.h"
#include "physics/hybrid/hybrid_cut_step.h"
#include "physics/static_factor.h"
#include "physics/symmetric_tiles.h"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <functional>
#include <memory>
#include <random>

#include <unistd.h>

namespace {

using namespace omentum;
using namespace omentum::physics;
using geometry::NodeId;
using geometry::TetId;

constexpr Material kLiver{6000, 0.45, 1060};
constexpr double kStep_s = 0.01;
constexpr double kDynamicShare = 0.18;
constexpr double kSupport_m = 8e-3;  // held within so much of the end that lies opposite to the dynamic part
constexpr double kTarget_us = 300;
constexpr int kPatchNodes = 24;
constexpr int kRemoved = 100;

// A file that is gone when the program ends.
struct Scratch {
  std::filesystem::path file =
      std::filesystem::temp_directory_path() / ("hybrid_bench-" + std::to_string(getpid()) + ".h5");
  ~Scratch() { std::filesystem::remove(file); }
};

// The outermost tetrahedra along x.
std::vector<std::uint8_t> outermost(const geometry::TetraMesh& mesh) {
  std::vector<std::pair<double, std::size_t>> along;
  for (std::size_t t = 0; t < mesh.tetrahedra.size(); ++t) {
    double x = 0;
    for (const NodeId n : mesh.tetrahedra[t]) x += mesh.positions[n].x() / 4;
    along.emplace_back(-x, t);
  }
  std::ranges::sort(along);
  std::vector<std::uint8_t> dynamic(along.size(), 0);
  const auto count = static_cast<std::size_t>(kDynamicShare * static_cast<double>(along.size()));
  for (std::size_t i = 0; i < count; ++i) dynamic[along[i].second] = 1;
  organ::take_what_would_hang(mesh, dynamic);
  return dynamic;
}

organ::Organ make_hybrid(const Scratch& scratch) {
  geometry::TetraMesh mesh = bench::bench_mesh();
  const double low = std::ranges::min(mesh.positions, {}, [](const Vec3& p) { return p.x(); }).x();
  FixedComponents fixed;
  for (const Vec3& p : mesh.positions) fixed.push_back(p.x() < low + kSupport_m ? kPinned : 0);
  std::vector<std::uint8_t> dynamic = outermost(mesh);
  organ::build_organ(organ::make_organ("liver", std::move(mesh), kLiver, std::move(fixed),
                                       organ::Storage::kFloat, std::move(dynamic)),
                     scratch.file, {});
  return organ::load_organ(scratch.file, organ::Load::kWithPart);
}

struct Body {
  Scratch scratch;
  organ::Organ organ = make_hybrid(scratch);
  const organ::OrganSplit& split = *organ.split;
  Inertia inertia{lumped_masses(organ.mesh, kLiver), organ.fixed, 2.0, 0.01};
  std::vector<double> weights = std::vector<double>(3 * organ.mesh.positions.size());
  std::vector<TetId> order = split.parts.dynamic.tetrahedron;

  std::vector<TetId> anywhere;  // of both parts
  std::vector<std::uint8_t> precomputed = split.precomputed();

  Body() {
    for (std::size_t t = 0; t < precomputed.size(); ++t) anywhere.emplace_back(t);
    for (auto* mixed : {&order, &anywhere}) std::ranges::shuffle(*mixed, std::mt19937(1));
  }

  // Nodes of the whole surface, the nearest to a place first.
  std::vector<NodeId> nearest(const Vec3& place, std::size_t count) const {
    std::vector<NodeId> nodes = organ.surface.node;
    std::ranges::sort(nodes, {}, [&](NodeId n) { return (organ.mesh.positions[n] - place).norm(); });
    nodes.resize(count);
    return nodes;
  }
  Vec3 on_border(std::size_t i) const {
    return organ.mesh.positions[split.parts.connection[i % split.parts.connection.size()]];
  }
};

void require(benchmark::State& state, bool ok) {
  if (!ok) state.SkipWithError("not finite or not positive definite");
}

void steps(benchmark::State& state, const Body& body, LargeStep& stepper, bool pressed) {
  BodyState moved = state_at_rest(body.organ.mesh.positions.size());
  ImposedPress imposed(body.organ.mesh.positions.size(), 1);
  const std::vector<NodeId> nodes = body.nearest(Vec3::Zero(), 4);
  const std::vector<Vec3> places(nodes.size(), Vec3(0, 0, -2e-3)), forces(nodes.size(), Vec3(0, 0, -0.1));
  const std::array presses{Press{nodes, places, forces}};
  for (auto _ : state) {
    require(state, stepper.step(moved, body.weights));
    if (pressed) imposed.impose(stepper, presses, moved);
  }
}

void removals(benchmark::State& state, const Body& body, LargeStep& stepper) {
  stepper.restore();
  std::size_t next = 0;
  for (auto _ : state) require(state, stepper.remove({&body.order[next++], 1}));
  stepper.restore();
}

void holds(benchmark::State& state, const Eigen::MatrixXd& S) {
  SymmetricTiles tiles(S);
  std::vector<double> u(tiles.size(), 1e-3), f(u.size());
  for (auto _ : state) {
    tiles.product(u, f);
    benchmark::ClobberMemory();
  }
}

void holds_plainly(benchmark::State& state, const Eigen::MatrixXd& S) {
  const Eigen::VectorXd u = Eigen::VectorXd::Constant(S.rows(), 1e-3);
  Eigen::VectorXd f(S.rows());
  for (auto _ : state) {
    f.noalias() = S * u;
    benchmark::ClobberMemory();
  }
}

// Of both parts alike, and of an organ that is in equilibrium throughout (quasi-static-cut).
template <class Cut>
void removals_anywhere(benchmark::State& state, const Body& body, Cut& cut) {
  cut.restore();
  std::size_t next = 0;
  for (auto _ : state) require(state, cut.remove({&body.anywhere[next++], 1}));
  cut.restore();
}

void patches(benchmark::State& state, const Body& body, LargeStep& stepper) {
  std::vector<std::vector<NodeId>> all;
  for (std::size_t i = 0; i < 20; ++i) all.push_back(body.nearest(body.on_border(i), kPatchNodes));
  std::vector<float> block(9 * kPatchNodes * kPatchNodes);
  std::size_t next = 0;
  for (auto _ : state) stepper.compliance(all[next++ % all.size()], block);
}

void run(const Body& body) {
  const auto hybrid = std::make_shared<HybridStep>(
      HybridBody{body.split.parts, body.split.surface, *body.split.compliance, body.organ.material,
                 body.split.fixed, body.inertia, body.weights},
      kStep_s, kPatchNodes);
  const auto whole = std::make_shared<ImplicitStep>(body.organ.mesh, kLiver, body.inertia,
                                                    ImplicitOptions{.step_s = kStep_s});
  const auto cut = std::make_shared<HybridCutStep>(
      HybridTissue{body.organ.mesh, body.organ.material, body.inertia, body.precomputed}, kStep_s,
      kPatchNodes);
  const Eigen::MatrixXd S = PrecomputedPart(*body.split.compliance, body.split.connection, {}).stiffness();
  const auto still = std::make_shared<StaticFactor>(body.organ.mesh, body.organ.material, body.organ.fixed);
  const auto add = [&](const char* name, int count, std::function<void(benchmark::State&)> what) {
    benchmark::RegisterBenchmark(
        name,
        [=, &body](benchmark::State& state) {
          what(state);
          state.counters["connection"] = static_cast<double>(body.split.parts.connection.size());
          state.counters["dynamic"] = static_cast<double>(body.split.parts.dynamic.node.size());
        })
        ->Unit(benchmark::kMicrosecond)
        ->Iterations(count);
  };
  add("step", 500, [=, &body](auto& s) { steps(s, body, *hybrid, false); });
  add("step/pressed", 500, [=, &body](auto& s) { steps(s, body, *hybrid, true); });
  add("whole", 500, [=, &body](auto& s) { steps(s, body, *whole, false); });
  add("whole/pressed", 500, [=, &body](auto& s) { steps(s, body, *whole, true); });
  add("remove", kRemoved, [=, &body](auto& s) { removals(s, body, *hybrid); });
  add("whole/remove", kRemoved, [=, &body](auto& s) { removals(s, body, *whole); });
  add("step/cut", 500, [=, &body](auto& s) {
    require(s, hybrid->remove(std::span(body.order).first(kRemoved)));
    steps(s, body, *hybrid, false);
    hybrid->restore();
  });
  add("anywhere", 500, [=, &body](auto& s) { steps(s, body, *cut, false); });
  add("anywhere/pressed", 500, [=, &body](auto& s) { steps(s, body, *cut, true); });
  add("anywhere/remove", kRemoved, [=, &body](auto& s) { removals_anywhere(s, body, *cut); });
  add("anywhere/patch", 100, [=, &body](auto& s) { patches(s, body, *cut); });
  add("static/remove", kRemoved, [=, &body](auto& s) { removals_anywhere(s, body, *still); });
  add("hold", 2000, [=](auto& s) { holds(s, S); });
  add("hold/plain", 2000, [=](auto& s) { holds_plainly(s, S); });
  add("patch", 100, [=, &body](auto& s) { patches(s, body, *hybrid); });
  add("whole/patch", 100, [=, &body](auto& s) { patches(s, body, *whole); });
}

}  // namespace

int main(int argc, char** argv) {
  organ_tools::start_with_fast_blas(argv);  // as the programs do
  bench::Results results(argc, argv);
  benchmark::Initialize(&argc, argv);
  const BlasThreads one(1);
  const Body body;
  run(body);
  bench::JsonReporter reporter(results);
  benchmark::RunSpecifiedBenchmarks(&reporter);
  for (const char* what : {"step", "step/cut"}) results.limit(what, kTarget_us);
  results.compare("step", "whole");
  results.compare("step/pressed", "whole/pressed");
  results.compare("step/cut", "whole");
  results.compare("hold", "hold/plain");
  results.compare("remove", "whole/remove");
  results.compare("patch", "whole/patch");
  results.compare("anywhere", "step");
  results.compare("anywhere/pressed", "step/pressed");
  results.compare("anywhere/remove", "static/remove");
  results.compare("anywhere/patch", "patch");
  results.write();
}
