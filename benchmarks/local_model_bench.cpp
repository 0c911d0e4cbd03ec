// The haptic step on local models: two tools of eight points, each pressing its own patch, which a new model
// replaces every 10 ms: of flat sheets, of an intestine and of a precomputed liver as deform_node tells them,
// the latter whole and after 300 removals; and how long an ordinary thread takes to check a model and make a
// body of it. Goal: median of the step below 20 us, and a cut organ's within 1.2 of the whole one's.
#include "benchmarks/bench_json.h"
#include "benchmarks/cut_patches.h"
#include "deform_node/gut_model.h"
#include "haptic_node/haptic_step.h"
#include "haptic_node/local_body.h"
#include "runtime/clock.h"
#include "runtime/realtime.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

namespace {

using namespace omentum;
using geometry::SurfaceId;
using geometry::Vec3;

constexpr int kTicks = 20'000;  // 20 s at 1 kHz
constexpr int kTicksPerModel = 10;
constexpr std::int64_t kTick_ns = 1'000'000;
constexpr double kEdge_m = 6e-3, kDepth_m = 3e-3, kRadius_m = 4e-3, kDrift_m_s = 0.02;
constexpr double kGoal_us = 20;

/// Rows of a flat sheet; compliance falls off by e-folds over two edges, as tissue's does.
haptic::LocalPatch sheet(int rows, int columns, const Vec3& corner) {
  haptic::LocalPatch patch;
  for (int i = 0; i < rows * columns; ++i) {
    patch.nodes.push_back(static_cast<std::uint32_t>(i));
    patch.positions.emplace_back(corner + kEdge_m * Vec3(i % columns, i / columns, 0));
  }
  patch.velocities.assign(patch.positions.size(), Vec3(0, 0, 1e-3));
  patch.forces.assign(patch.positions.size(), Vec3::Zero());
  for (int r = 0; r + 1 < rows; ++r) {
    for (int c = 0; c + 1 < columns; ++c) {
      const SurfaceId a(r * columns + c), b(a + 1), d(a + columns), e(d + 1);
      patch.triangles.push_back({a, b, e});
      patch.triangles.push_back({a, e, d});
    }
  }
  for (std::size_t i = 0; i < 3 * patch.positions.size(); ++i) {
    for (std::size_t j = i; j < 3 * patch.positions.size(); ++j) {
      const double apart_m = (patch.positions[i / 3] - patch.positions[j / 3]).norm();
      patch.compliance.push_back(i % 3 == j % 3 ? static_cast<float>(2e-3 * std::exp(-apart_m / 2 / kEdge_m))
                                                : 0.0f);
    }
  }
  return patch;
}

/// What both tools press, and where.
struct Pressed {
  std::array<haptic::LocalPatch, 2> patches;
  std::array<Vec3, 2> middles;
};

Pressed sheets(int rows, int columns) {
  Pressed pressed;
  for (std::size_t t = 0; t < 2; ++t) {
    const Vec3 corner(t == 0 ? 0.0 : 0.2, 0, 0);
    pressed.patches[t] = sheet(rows, columns, corner);
    pressed.middles[t] = corner + 0.5 * kEdge_m * Vec3(columns - 1, rows - 1, 0);
  }
  return pressed;
}

haptic::LocalPatch as_heard(const deform::LocalPatch& told, bool bends_freely = true) {
  haptic::LocalPatch patch;
  const auto n = static_cast<std::ptrdiff_t>(told.node_count);
  patch.bends_freely = bends_freely;
  patch.nodes.assign(told.nodes.begin(), told.nodes.begin() + n);
  patch.positions.assign(told.positions.begin(), told.positions.begin() + n);
  patch.velocities.assign(told.velocities.begin(), told.velocities.begin() + n);
  patch.forces.assign(told.forces.begin(), told.forces.begin() + n);
  for (std::size_t i = 0; i < told.triangle_count; ++i) {
    const auto [a, b, c] = told.triangles[i];
    patch.triangles.push_back(
        {SurfaceId(std::int32_t{a}), SurfaceId(std::int32_t{b}), SurfaceId(std::int32_t{c})});
  }
  patch.compliance.assign(told.compliance.begin(), told.compliance.begin() + 3 * n * (3 * n + 1) / 2);
  return patch;
}

// Their nodes' mean, from where the bench's ring presses along -z.
Pressed of_liver(const bench::CutPatches::Two& told) {
  Pressed pressed;
  for (std::size_t t = 0; t < 2; ++t) {
    pressed.patches[t] = as_heard(told[t], false);
    pressed.middles[t] = told[t].positions[0];
  }
  return pressed;
}

std::unique_ptr<physics::GutSystem> gut_of(const geometry::GutShape& shape) {
  return std::make_unique<physics::GutSystem>(shape, physics::GutMaterial(), physics::GutCollisionSettings(),
                                              physics::GutStepSettings{.step_s = 0.01});
}

/// The tops of two loops, a hand's breadth apart.
Pressed loops() {
  constexpr double kReach_m = 0.015, kApart_m = 0.1;
  const geometry::GutShape shape = geometry::make_gut({});
  const deform::GutModel model({.system = gut_of(shape), .felt = gut_of(shape)});
  const geometry::GutSkin skin(shape);
  std::vector<Vec3> places(skin.node_count());
  skin.place(shape.positions, places);
  const auto higher = [](const Vec3& p) { return p.z(); };
  Pressed pressed;
  for (std::size_t t = 0; t < 2; ++t) {
    pressed.middles[t] = *std::ranges::max_element(places, {}, higher);
    deform::LocalPatch told(deform::GutModel::kPatchNodes);
    if (!model.local_model({static_cast<std::uint32_t>(t), pressed.middles[t], kReach_m}, told))
      throw std::runtime_error("no local model on top of a loop");
    pressed.patches[t] = as_heard(told);
    std::erase_if(places, [&](const Vec3& p) { return (p - pressed.middles[t]).norm() < kApart_m; });
  }
  return pressed;
}

haptic::ToolModel ring() {
  haptic::ToolModel tool;
  for (int i = 0; i < 8; ++i) {
    const double turn = i * std::numbers::pi / 4;
    tool.points.emplace_back(kRadius_m * std::cos(turn), kRadius_m * std::sin(turn), 0);
  }
  return tool;
}

double median_us(std::vector<std::int64_t>& ns, double share = 0.5) {
  const auto at = ns.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(ns.size() - 1));
  std::nth_element(ns.begin(), at, ns.end());
  return 1e-3 * static_cast<double>(*at);
}

class Session {
 public:
  explicit Session(Pressed pressed) : pressed_(std::move(pressed)) {}

  void run() {
    for (int i = 0; i < kTicks; ++i) {
      state_.now_ns += kTick_ns;
      if (i % kTicksPerModel == 0) post();
      const double way = kDrift_m_s * 1e-3 * i / kRadius_m;
      for (std::size_t t = 0; t < 2; ++t) {
        const Vec3 around = kRadius_m * Vec3(std::sin(way), std::cos(way), 0);
        const double depth_m = kDepth_m * std::min(1.0, i / 200.0 - 0.5);
        inputs_[t].engaged = true;
        inputs_[t].frame.p_WT = pressed_.middles[t] + around - Vec3(0, 0, depth_m);
      }
      const std::int64_t begin = runtime::steady_now_ns();
      const haptic::StepResult result = haptic_step(model_, inputs_, state_, *work_, outputs_);
      const std::int64_t took = runtime::steady_now_ns() - begin;
      if (i < 1000) continue;
      (i % kTicksPerModel == 0 ? taken : stepped).push_back(took);
      contacts = std::max(contacts, result.contacts);
    }
  }

  std::vector<std::int64_t> stepped, taken, made;
  int contacts = 0;

 private:
  void post() {
    for (std::size_t t = 0; t < 2; ++t) {
      haptic::LocalPatch patch = pressed_.patches[t];
      patch.tool = t;
      patch.arrival_ns = state_.now_ns;
      const std::int64_t begin = runtime::steady_now_ns();
      if (const auto why = reason_against(patch, 1)) throw std::runtime_error(*why);
      auto body = make_local_body(patch);
      made.push_back(runtime::steady_now_ns() - begin);
      work_->doors[t].post(std::move(body));
    }
  }

  Pressed pressed_;
  haptic::HapticModel model_{.organs = {}, .tools = {ring(), ring()}, .spare_places = 2};
  haptic::HapticState state_{model_};
  std::unique_ptr<haptic::HapticWorkspace> work_ = std::make_unique<haptic::HapticWorkspace>(model_);
  std::vector<haptic::ToolInput> inputs_{2};
  std::vector<haptic::ToolOutput> outputs_{2};
};

void measure(const std::string& what, Pressed pressed, bench::Results& results) {
  const std::string name = "haptic_step_local/" + what;
  const std::size_t nodes = pressed.patches[0].nodes.size();
  Session session(std::move(pressed));
  session.run();
  const double step_us = median_us(session.stepped), late_us = median_us(session.stepped, 0.99);
  const double taken_us = median_us(session.taken), made_us = median_us(session.made);
  std::printf(
      "%s, %zu nodes: step median %.1f us, p99 %.1f us; with two new models %.1f us; a body is made in %.0f "
      "us; "
      "contacts at most %d\n",
      what.c_str(), nodes, step_us, late_us, taken_us, made_us, session.contacts);
  results.add({.name = name + "/p50", .value = step_us, .unit = "us", .limit = kGoal_us});
  results.add({.name = name + "/p99", .value = late_us, .unit = "us"});
  results.add({.name = name + "/new_models", .value = taken_us, .unit = "us"});
  results.add({.name = name + "/make", .value = made_us, .unit = "us"});
}

// One after the other, several times: what else the machine does meets both alike.
void measure_cut(bench::Results& results) {
  constexpr int kTimes = 5;
  const bench::CutPatches patches(300);
  std::vector<std::int64_t> whole, cut;
  int contacts = 0;
  for (int i = 0; i < kTimes; ++i) {
    for (const bool is_cut : {false, true}) {
      Session session(of_liver(is_cut ? patches.cut : patches.whole));
      session.run();
      std::vector<std::int64_t>& all = is_cut ? cut : whole;
      all.insert(all.end(), session.stepped.begin(), session.stepped.end());
      contacts = std::max(contacts, session.contacts);
    }
  }
  const double whole_us = median_us(whole), cut_us = median_us(cut);
  std::printf(
      "liver, %zu tetrahedra gone: step median %.1f us, %.2f of the whole one's %.1f us; contacts at most "
      "%d\n",
      patches.removed, cut_us, cut_us / whole_us, whole_us, contacts);
  results.add({.name = "haptic_step_local/liver/whole", .value = whole_us, .unit = "us"});
  results.add(
      {.name = "haptic_step_local/liver/cut", .value = cut_us, .unit = "us", .limit = 1.2 * whole_us});
  results.compare("haptic_step_local/liver/cut", "haptic_step_local/liver/whole");
}

}  // namespace

int main(int argc, char** argv) {
  bench::Results results(argc, argv);
  const std::string refused = runtime::request_realtime(runtime::kHandLoopPriority).warning;
  if (!refused.empty()) std::printf("warning: %s\n", refused.c_str());
  measure("24", sheets(4, 6), results);
  measure("96", sheets(8, 12), results);
  measure("gut", loops(), results);
  measure_cut(results);
  results.write();
}
