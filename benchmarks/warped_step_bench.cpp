// What a tick of a co-rotational organ costs under two tools (physics/dynamics/warped_step.h).
//   step             one step that no tool presses, in free swing
//   linear_tick      step, presses and the look ahead of linear tissue, which needs no iterations
//   tick/hold        the same of co-rotational tissue, tools at rest
//   tick/slide       tools that slide at 10 mm/s
//   tick/cut         tools that slide, one tetrahedron removed in each tick
// Mesh: benchmarks/bench_mesh.h. Counter iterations: of the step alone, mean.
#include "benchmarks/bench_mesh.h"
#include "benchmarks/json_reporter.h"
#include "organ_tools/fast_blas.h"
#include "physics/blas_threads.h"
#include "physics/dynamics/implicit_step.h"
#include "physics/dynamics/imposed_press.h"
#include "physics/dynamics/warped_step.h"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <functional>
#include <memory>
#include <random>

namespace {

using namespace omentum;
using namespace omentum::physics;
using geometry::NodeId;

constexpr Material kLiver{6000, 0.45, 1060};
constexpr double kStep_s = 0.01;
constexpr double kSupportDepth_m = 5e-3;  // held at z below its smallest z + 5 mm
constexpr double kDepth_m = 5e-3;
constexpr double kSlide_m_s = 0.01, kWay_m = 0.02;  // to and fro
constexpr double kReach_m = 0.015;                  // of what one tool presses, at rest
constexpr int kSettling = 100;                      // ticks before the first that counts

struct Body {
  geometry::TetraMesh mesh = bench::bench_mesh();
  Inertia inertia{lumped_masses(mesh, kLiver), {}, 4.0, 0.01};
  std::vector<geometry::TetId> order;  // in which tetrahedra are removed

  Body() {
    const auto low = std::ranges::min(mesh.positions, {}, [](const Vec3& p) { return p.z(); }).z();
    for (const Vec3& p : mesh.positions) inertia.fixed.push_back(p.z() < low + kSupportDepth_m ? kPinned : 0);
    for (std::size_t t = 0; t < mesh.tetrahedra.size(); ++t) order.emplace_back(t);
    std::ranges::shuffle(order, std::mt19937(1));
  }
};

// A tool that presses down on the nodes around a place, as strongly as its last press turned out to be.
class Tool {
 public:
  Tool(const Body& body, double share_of_x) : body_(body) {
    const auto [low, high] =
        std::ranges::minmax(body.mesh.positions, {}, [](const Vec3& p) { return p.x(); });
    const double x = low.x() + share_of_x * (high.x() - low.x());
    const auto height = [&](const Vec3& p) { return std::abs(p.x() - x) < kReach_m ? p.z() : -1; };
    from_ = std::ranges::max(body.mesh.positions, {}, height);
  }

  Press at(double slid_m) {
    nodes_.clear(), places_.clear(), forces_.clear();
    const Vec3 centre = from_ - Vec3(slid_m, 0, 0);
    for (std::size_t n = 0; n < body_.mesh.positions.size(); ++n) {
      const double far = (body_.mesh.positions[n] - centre).norm() / kReach_m;
      if (far >= 1) continue;
      nodes_.emplace_back(n);
      places_.emplace_back(0, 0, -kDepth_m);
      forces_.emplace_back(0, 0, -strength_n_ * (1 - far) * (1 - far));
    }
    return {nodes_, places_, forces_};
  }
  void answer(double strength) { strength_n_ = std::max(1e-3, strength_n_ * strength); }

 private:
  const Body& body_;
  Vec3 from_;
  double strength_n_ = 0.1;
  std::vector<NodeId> nodes_;
  std::vector<Vec3> places_, forces_;
};

// A body under two tools, tick by tick.
class Session {
 public:
  Session(const Body& body, LargeStep& stepper)
      : tools_{Tool(body, 0.3), Tool(body, 0.6)},
        stepper_(stepper),
        imposed_(body.mesh.positions.size(), 2),
        state_(state_at_rest(body.mesh.positions.size())),
        none_(state_.u.size()),
        external_(state_.u.size()),
        ahead_(state_.u.size()) {}

  bool tick(bool slides) {
    if (slides) time_s_ += kStep_s;
    const double way = std::fmod(kSlide_m_s * time_s_, 2 * kWay_m);
    const std::array presses{tools_[0].at(std::min(way, 2 * kWay_m - way)),
                             tools_[1].at(std::min(way, 2 * kWay_m - way))};
    if (!stepper_.step(state_, none_)) return false;
    const auto strengths = imposed_.impose(stepper_, presses, state_);
    std::ranges::fill(external_, 0.0);
    for (std::size_t p = 0; p < presses.size(); ++p) {
      for (std::size_t i = 0; i < presses[p].nodes.size(); ++i)
        Vec3::Map(&external_[3 * presses[p].nodes[i]]) += strengths[p] * presses[p].forces[i];
      tools_[p].answer(strengths[p]);
    }
    stepper_.foresee(state_, external_, ahead_);
    return true;
  }
  BodyState& state() { return state_; }
  std::span<const double> none() const { return none_; }

 private:
  std::array<Tool, 2> tools_;
  LargeStep& stepper_;
  ImposedPress imposed_;
  BodyState state_;
  std::vector<double> none_, external_, ahead_;
  double time_s_ = 0;
};

void require(benchmark::State& state, bool ok) {
  if (!ok) state.SkipWithError("not finite or not positive definite");
}

void ticks(benchmark::State& state, const Body& body, LargeStep& stepper, bool slides, bool cuts) {
  stepper.restore();
  Session session(body, stepper);
  for (int i = 0; i < kSettling; ++i) require(state, session.tick(slides));
  std::size_t next = 0;
  for (auto _ : state) {
    if (cuts) {
      state.PauseTiming();
      require(state, stepper.remove({&body.order[next++], 1}));
      state.ResumeTiming();
    }
    require(state, session.tick(slides));
  }
}

void swing(benchmark::State& state, const Body& body, WarpedStep& stepper) {
  stepper.restore();
  Session session(body, stepper);
  for (int i = 0; i < kSettling; ++i) require(state, session.tick(false));
  double iterations = 0;
  for (auto _ : state) {
    require(state, stepper.step(session.state(), session.none()));
    iterations += stepper.iterations();
  }
  state.counters["iterations"] = iterations / static_cast<double>(state.iterations());
}

void run(const Body& body) {
  const auto linear =
      std::make_shared<ImplicitStep>(body.mesh, kLiver, body.inertia, ImplicitOptions{.step_s = kStep_s});
  const auto warped = std::make_shared<WarpedStep>(
      body.mesh, kLiver, body.inertia, Corotational(body.mesh, kLiver), WarpedOptions{.step_s = kStep_s});
  const auto add = [](const char* name, std::function<void(benchmark::State&)> what) {
    benchmark::RegisterBenchmark(name, std::move(what))->Unit(benchmark::kMicrosecond)->Iterations(300);
  };
  add("step", [=, &body](auto& s) { swing(s, body, *warped); });
  add("linear_tick", [=, &body](auto& s) { ticks(s, body, *linear, true, false); });
  add("tick/hold", [=, &body](auto& s) { ticks(s, body, *warped, false, false); });
  add("tick/slide", [=, &body](auto& s) { ticks(s, body, *warped, true, false); });
  add("tick/cut", [=, &body](auto& s) { ticks(s, body, *warped, true, true); });
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
  for (const char* what : {"tick/hold", "tick/slide", "tick/cut"}) results.compare(what, "linear_tick");
  results.write();
}
