// What a cut costs a precomputed organ: from a removal until the corrected compliance of 24 surface nodes is
// there, which a hand waits for.
//   factor/ORGAN/...      the downdated factor, as deform_node has it: removals in a row, each with the patch
//   woodbury/ORGAN/K      the same by Woodbury's identity on the stored compliance, float, after K removals
//   augmented/ORGAN/K     the same on the factor of the uncut organ, K removals not yet folded into it
// Each with its largest error against an exact solve, as a share of the patch's largest entry.
// Organs: the 7,185-tetrahedra liver and, with --large, one of 131,879, both of the data beside the
// repository.
#include "benchmarks/bench_json.h"
#include "benchmarks/bench_mesh.h"
#include "geometry/mesh_editor.h"
#include "geometry/surface.h"
#include "organ_tools/fast_blas.h"
#include "physics/blas_threads.h"
#include "physics/dynamics/element_root.h"
#include "physics/static_factor.h"
#include "physics/unheld_pieces.h"

#include <Eigen/LU>

#include <unistd.h>
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <ctime>
#include <fstream>
#include <string>

namespace {

using namespace omentum;
using namespace omentum::physics;
using geometry::NodeId;
using geometry::TetId;
using Clock = std::chrono::steady_clock;

constexpr double kMillimetre = 1e-3;
constexpr double kSupportDepth_m = 5e-3;  // held at x below its smallest x + 5 mm
constexpr Material kLiver{5000, 0.45, 1050};
constexpr std::size_t kPatch = 24,
                      kTouched = 9;  // nodes: of a hand's patch, and of what a tip's points touch
constexpr int kExactEvery = 50;
constexpr double kPromised = 1e-5;

double ms_since(Clock::time_point start) {
  return 1e3 * std::chrono::duration<double>(Clock::now() - start).count();
}

// Of this thread: where others share the machine, what the work itself takes.
double processor_ms() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

double quantile(std::vector<double> values, double share) {
  const auto at =
      values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::ranges::nth_element(values, at);
  return *at;
}

double resident_mb() {
  std::ifstream statm("/proc/self/statm");
  double size = 0, resident = 0;
  statm >> size >> resident;
  return resident * static_cast<double>(sysconf(_SC_PAGESIZE)) / 1e6;
}

struct Organ {
  geometry::TetraMesh mesh;
  FixedComponents fixed;
  std::vector<TetId> line;  // of a cut, in its order

  Organ(geometry::TetraMesh of, std::size_t removals) : mesh(std::move(of)) {
    double low = mesh.positions[0].x();
    for (const Vec3& p : mesh.positions) low = std::min(low, p.x());
    for (const Vec3& p : mesh.positions) fixed.push_back(p.x() < low + kSupportDepth_m ? kPinned : 0);
    draw_line(removals);
  }

  Vec3 middle(TetId t) const {
    Vec3 sum = Vec3::Zero();
    for (const NodeId n : mesh.tetrahedra[t]) sum += mesh.positions[n] / 4;
    return sum;
  }

  // The nearest ones to a plane across the middle, as a blade meets them from one side.
  void draw_line(std::size_t removals) {
    std::vector<Vec3> middles;
    for (std::size_t t = 0; t < mesh.tetrahedra.size(); ++t) middles.push_back(middle(TetId(t)));
    Vec3 low = middles[0], high = low;
    for (const Vec3& p : middles) low = low.cwiseMin(p), high = high.cwiseMax(p);
    const double plane = (low.x() + high.x()) / 2;
    for (std::size_t t = 0; t < middles.size(); ++t) line.emplace_back(t);
    std::ranges::sort(line, {}, [&](TetId t) { return std::abs(middles[t].x() - plane); });
    line.resize(std::min(2 * removals, line.size()));
    std::ranges::sort(line, {}, [&](TetId t) { return middles[t].y(); });
  }

  // Surface bytes of the stored compliance, float.
  double tensors_mb() const {
    const auto surface = geometry::extract_surface(mesh, pinned_nodes(fixed));
    return 36e-6 * surface.mobile_count * surface.mobile_count;
  }
};

struct Measured {
  std::vector<double> remove_ms, patch_ms, both_ms, processor_ms;
  std::vector<double> touched_ms;  // of the processor, with the compliance of kTouched nodes alone
  double error = 0;
};

// A patch of the surface that the editor has now.
std::vector<NodeId> patch_near(const Organ& organ, const geometry::MeshEditor& editor, const Vec3& place) {
  std::vector<NodeId> nodes;
  for (const NodeId n : editor.surface_nodes())
    if (editor.uses(n) > 0 && organ.fixed[n] == 0) nodes.push_back(n);
  const auto distance = [&](NodeId n) { return (organ.mesh.positions[n] - place).squaredNorm(); };
  const auto last = nodes.begin() + kPatch;
  std::ranges::partial_sort(nodes, last, {}, distance);
  nodes.resize(kPatch);
  return nodes;
}

// Of one column of a block of `nodes`.
double error_of(StaticFactor& factor, std::span<const NodeId> nodes, const Eigen::MatrixXf& block,
                Eigen::Index column) {
  std::vector<double> f(3 * static_cast<std::size_t>(factor.node_count())), u(f.size());
  f[3 * nodes[static_cast<std::size_t>(column / 3)] + column % 3] = 1;
  factor.solve_exactly(f, u);
  double error = 0;
  for (Eigen::Index row = 0; row < static_cast<Eigen::Index>(3 * nodes.size()); ++row)
    error = std::max(
        error, std::abs(block(row, column) - u[3 * nodes[static_cast<std::size_t>(row / 3)] + row % 3]));
  return error / block.cwiseAbs().maxCoeff();
}

std::vector<TetId> all_of(const geometry::Removal& removal) {
  std::vector<TetId> gone(removal.asked.begin(), removal.asked.end());
  gone.insert(gone.end(), removal.repaired.begin(), removal.repaired.end());
  return gone;
}

// Removals one after another along the line, what hangs or floats with them.
class Cut {
 public:
  explicit Cut(const Organ& organ) : organ_(organ), editor_(organ.mesh), unheld_(organ.mesh, organ.fixed) {}

  // Nothing, when the line has ended.
  std::vector<TetId> next() {
    while (at_ < organ_.line.size()) {
      std::vector<TetId> gone = all_of(editor_.remove({&organ_.line[at_++], 1}));
      if (gone.empty()) continue;
      const auto floating = unheld_.find(editor_);
      const std::vector<TetId> more = all_of(editor_.remove(floating));
      gone.insert(gone.end(), more.begin(), more.end());
      return gone;
    }
    return {};
  }
  const geometry::MeshEditor& editor() const { return editor_; }

 private:
  const Organ& organ_;
  geometry::MeshEditor editor_;
  UnheldPieces unheld_;
  std::size_t at_ = 0;
};

double touched_ms(StaticFactor& factor, std::span<const NodeId> nodes) {
  std::vector<float> block(9 * kTouched * kTouched);
  const double began_ms = processor_ms();
  factor.compliance(nodes.first(kTouched), block);
  return processor_ms() - began_ms;
}

Measured by_factor(const Organ& organ, StaticFactor& factor, std::size_t removals) {
  Measured measured;
  Cut cut(organ);
  Eigen::MatrixXf block(3 * kPatch, 3 * kPatch);
  for (std::size_t i = 0; i < removals; ++i) {
    const auto gone = cut.next();
    if (gone.empty()) break;
    const auto nodes = patch_near(organ, cut.editor(), organ.middle(gone.front()));
    const double began_ms = processor_ms();
    const auto start = Clock::now();
    if (!factor.remove(gone)) throw std::runtime_error("not positive definite");
    measured.remove_ms.push_back(ms_since(start));
    const double removed_ms = processor_ms();
    factor.compliance(nodes, {block.data(), static_cast<std::size_t>(block.size())});
    measured.both_ms.push_back(ms_since(start));
    measured.processor_ms.push_back(processor_ms() - began_ms);
    measured.touched_ms.push_back(removed_ms - began_ms + touched_ms(factor, nodes));
    measured.patch_ms.push_back(measured.both_ms.back() - measured.remove_ms.back());
    if (i % kExactEvery == 0)
      measured.error =
          std::max(measured.error, error_of(factor, nodes, block, static_cast<Eigen::Index>(i) % 72));
  }
  return measured;
}

// C_AA + C_AR W (I - W^T C_RR W)^-1 W^T C_RA of a compliance [A, R] of the uncut organ: A the patch, R the
// removed tetrahedra's nodes, W their roots.
Eigen::MatrixXf corrected(const Organ& organ, const Eigen::MatrixXf& C, std::span<const NodeId> nodes,
                          std::span<const TetId> gone) {
  const auto place = [&](NodeId n) { return std::ranges::find(nodes, n) - nodes.begin(); };
  Eigen::MatrixXd W = Eigen::MatrixXd::Zero(C.rows(), static_cast<Eigen::Index>(6 * gone.size()));
  for (std::size_t g = 0; g < gone.size(); ++g) {
    const ElementRoot root = element_root(corners_of(organ.mesh, gone[g]), kLiver);
    for (Eigen::Index j = 0; j < 4; ++j) {
      const NodeId n = organ.mesh.tetrahedra[gone[g]][static_cast<std::size_t>(j)];
      if (organ.fixed[n] == 0)
        W.block<3, 6>(3 * place(n), static_cast<Eigen::Index>(6 * g)) = root.block<3, 6>(3 * j, 0);
    }
  }
  const Eigen::MatrixXd CW = C.cast<double>() * W;
  const Eigen::MatrixXd S = Eigen::MatrixXd::Identity(W.cols(), W.cols()) - W.transpose() * CW;
  const auto CAW = CW.topRows(3 * kPatch);
  const Eigen::MatrixXd more = CAW * S.partialPivLu().solve(CAW.transpose());
  return (C.topLeftCorner(3 * kPatch, 3 * kPatch).cast<double>() + more).cast<float>();
}

void compare_low_rank(const std::string& name, const Organ& organ, std::size_t removals,
                      bench::Results& results) {
  Cut cut(organ);
  std::vector<TetId> gone;
  for (std::size_t i = 0; i < removals; ++i)
    for (const TetId t : cut.next()) gone.push_back(t);
  std::vector<NodeId> nodes = patch_near(organ, cut.editor(), organ.middle(gone.back()));
  for (const TetId t : gone)
    for (const NodeId n : organ.mesh.tetrahedra[t])
      if (organ.fixed[n] == 0 && std::ranges::find(nodes, n) == nodes.end()) nodes.push_back(n);

  StaticFactor uncut(organ.mesh, kLiver, organ.fixed, static_cast<int>(nodes.size()));
  StaticFactor exact(organ.mesh, kLiver, organ.fixed, kPatch);
  if (!exact.remove(gone)) throw std::runtime_error("not positive definite");
  const auto width = static_cast<Eigen::Index>(3 * nodes.size());
  Eigen::MatrixXf C(width, width);
  auto start = Clock::now();
  uncut.compliance(nodes, {C.data(), static_cast<std::size_t>(C.size())});
  const double columns_ms = ms_since(start);
  start = Clock::now();
  const Eigen::MatrixXf block = corrected(organ, C, nodes, gone);
  const double correction_ms = ms_since(start);
  const double error = error_of(exact, std::span(nodes).first(kPatch), block, 0);
  const std::string k = "/" + name + "/" + std::to_string(removals);
  std::printf(
      "%zu removals: Woodbury on stored columns %.2f ms; with those of the uncut factor %.2f ms; error "
      "%.1e\n",
      removals, correction_ms, columns_ms + correction_ms, error);
  results.add({.name = "woodbury" + k, .value = correction_ms, .unit = "ms"});
  results.add({.name = "augmented" + k, .value = columns_ms + correction_ms, .unit = "ms"});
  results.add({.name = "woodbury" + k + "/error", .value = error, .unit = "1", .limit = kPromised});
}

struct Limits {
  double median_ms, p99_ms;
};

void measure(const std::string& name, const Organ& organ, std::size_t removals, const Limits& limits,
             bench::Results& results) {
  StaticFactor factor(organ.mesh, kLiver, organ.fixed, kPatch);
  const double before_mb = resident_mb();
  const Measured measured = by_factor(organ, factor, removals);
  const double grown = (resident_mb() - before_mb) / organ.tensors_mb();
  const double median_ms = quantile(measured.both_ms, 0.5), p99_ms = quantile(measured.both_ms, 0.99);
  std::printf(
      "%s: %zu nodes, %.1f million entries; %zu removals: median %.2f ms (downdate %.2f, patch %.2f), p99 "
      "%.2f "
      "ms (of the processor: median %.2f, p99 %.2f; of nine nodes %.2f, %.2f), error %.1e, memory grew by "
      "%.3f of the tensors\n",
      name.c_str(), organ.mesh.positions.size(), 1e-6 * static_cast<double>(factor.entry_count()),
      measured.both_ms.size(), median_ms, quantile(measured.remove_ms, 0.5), quantile(measured.patch_ms, 0.5),
      p99_ms, quantile(measured.processor_ms, 0.5), quantile(measured.processor_ms, 0.99),
      quantile(measured.touched_ms, 0.5), quantile(measured.touched_ms, 0.99), measured.error, grown);
  results.add(
      {.name = "factor/" + name + "/p50", .value = median_ms, .unit = "ms", .limit = limits.median_ms});
  results.add({.name = "factor/" + name + "/p99", .value = p99_ms, .unit = "ms", .limit = limits.p99_ms});
  results.add(
      {.name = "factor/" + name + "/error", .value = measured.error, .unit = "1", .limit = kPromised});
  results.add(
      {.name = "factor/" + name + "/touched_p50", .value = quantile(measured.touched_ms, 0.5), .unit = "ms"});
  results.add({.name = "factor/" + name + "/memory", .value = grown, .unit = "1", .limit = 0.3});
}

}  // namespace

int main(int argc, char** argv) {
  organ_tools::start_with_fast_blas(argv);  // as the programs do
  const bool is_large = std::find(argv, argv + argc, std::string_view("--large")) != argv + argc;
  bench::Results results(argc, argv);
  const BlasThreads one(1);
  const Organ liver(bench::bench_mesh(), 300);
  measure("liver", liver, 300, {.median_ms = 5, .p99_ms = 15}, results);
  for (const std::size_t removals : {1, 30, 150}) compare_low_rank("liver", liver, removals, results);
  const auto file = test::data_file("tet/openhelp_liver_132k.msh");
  if (is_large && std::filesystem::exists(file)) {
    const Organ large(geometry::check_mesh(geometry::read_mesh(file), kMillimetre).mesh, 1000);
    measure("liver132k", large, 1000, {.median_ms = 30, .p99_ms = 30}, results);
  }
  results.write();
}
