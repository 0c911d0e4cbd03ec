#include "physics/force_tensors.h"

#include "physics/blas_threads.h"
#include "physics/column_solver.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <exception>
#include <mutex>
#include <numeric>
#include <thread>

namespace omentum::physics {

namespace {

using geometry::kClusterSize;

// Nodes whose columns are solved together. Wide blocks read the factor less often (15 % faster at 5,600
// nodes), narrow ones need less memory: as wide as the workspaces stay within this part of the tensors,
// between bounds outside which speed was measured to fall or to gain nothing.
constexpr double kWorkspacePart = 0.05;
constexpr int kFewestNodes = 16;
constexpr int kMostNodes = 43;

int choose_block_nodes(std::size_t tile_bytes, std::int32_t dofs, int threads) {
  const double per_node = 3.0 * sizeof(double) * dofs * threads;
  return std::clamp(static_cast<int>(kWorkspacePart * tile_bytes / per_node), kFewestNodes, kMostNodes);
}

using Positions = std::array<std::int32_t, 3>;

// In which order the columns are solved: by their place in the elimination.
struct Plan {
  std::vector<Positions> position;  // [mobile] of a node's components; -1 where held
  std::vector<std::int32_t> order;  // mobile nodes by their first position
  std::vector<std::int32_t> rank;   // [mobile] inverse of `order`
  std::vector<bool> wanted;         // [free]
};

std::int32_t first_position(const Positions& p) {
  std::int32_t first = INT32_MAX;
  for (const std::int32_t position : p) {
    if (position >= 0) first = std::min(first, position);
  }
  return first;
}

Plan plan_columns(const Supernodes& factor, const FreeDofs& free, const geometry::Surface& surface) {
  std::vector<std::int32_t> position_of(factor.size);
  for (std::int32_t p = 0; p < factor.size; ++p) position_of[factor.permutation[p]] = p;

  Plan plan;
  plan.wanted.assign(factor.size, false);
  for (std::int32_t s = 0; s < surface.mobile_count; ++s) {
    Positions p{-1, -1, -1};
    for (int axis = 0; axis < 3; ++axis) {
      const std::int32_t dof = free.of(surface.node[s], axis);
      if (dof < 0) continue;
      p[axis] = position_of[dof];
      plan.wanted[p[axis]] = true;
    }
    plan.position.push_back(p);
  }
  plan.order.resize(surface.mobile_count);
  std::iota(plan.order.begin(), plan.order.end(), 0);
  std::ranges::sort(plan.order, {}, [&](std::int32_t s) { return first_position(plan.position[s]); });
  plan.rank.resize(surface.mobile_count);
  for (std::int32_t r = 0; r < surface.mobile_count; ++r) plan.rank[plan.order[r]] = r;
  return plan;
}

// Solves blocks of columns and writes their rows from the block's first rank on.
template <class Scalar>
class BlockWriter {
 public:
  BlockWriter(const Supernodes& factor, const Plan& plan, const ComplianceTiles<Scalar>& tiles,
              int block_nodes)
      : plan_(plan),
        tiles_(tiles),
        block_nodes_(block_nodes),
        solver_(factor, plan.wanted, 3 * block_nodes),
        zero_(3 * block_nodes, 0.0) {}

  // Returns the nodes whose columns it wrote.
  std::span<const std::int32_t> run(std::int32_t first_rank) {
    const std::int32_t end = std::min<std::int32_t>(first_rank + block_nodes_, tiles_.mobile_count);
    const std::span nodes(plan_.order.data() + first_rank, plan_.order.data() + end);
    choose_columns(nodes);
    solver_.solve(positions_);
    for (std::int32_t c = 0; c < tiles_.cluster_count(); ++c) write_cluster(nodes, first_rank, c);
    return nodes;
  }

 private:
  // The smallest position first, as the solver wants it.
  void choose_columns(std::span<const std::int32_t> nodes) {
    positions_.clear();
    for (const std::int32_t k : nodes) {
      for (const std::int32_t p : plan_.position[k]) {
        if (p >= 0) positions_.push_back(p);
      }
    }
    std::ranges::iter_swap(positions_.begin(), std::ranges::min_element(positions_));
    columns_.assign(nodes.size(), {-1, -1, -1});
    for (std::size_t q = 0; q < nodes.size(); ++q) {
      for (int axis = 0; axis < 3; ++axis) {
        const auto found = std::ranges::find(positions_, plan_.position[nodes[q]][axis]);
        if (found != positions_.end())
          columns_[q][axis] = static_cast<std::int32_t>(found - positions_.begin());
      }
    }
  }

  // Rows of the solution for the three components of a cluster's lanes; zeros where there is none.
  bool find_rows(std::int32_t first_rank, std::int32_t c, const double* (&rows)[3][kClusterSize]) {
    bool any = false;
    for (int lane = 0; lane < kClusterSize; ++lane) {
      const std::int32_t n = c * kClusterSize + lane;
      const bool solved = n < tiles_.mobile_count && plan_.rank[n] >= first_rank;
      any = any || solved;
      for (int i = 0; i < 3; ++i) {
        rows[i][lane] =
            solved && plan_.position[n][i] >= 0 ? solver_.row(plan_.position[n][i]) : zero_.data();
      }
    }
    return any;
  }

  void write_cluster(std::span<const std::int32_t> nodes, std::int32_t first_rank, std::int32_t c) {
    const double* rows[3][kClusterSize];
    const bool any = find_rows(first_rank, c, rows);
    for (std::size_t q = 0; q < nodes.size(); ++q) {
      Scalar* out = tiles_.tile(nodes[q], c);
      if (!any) {
        std::fill_n(out, ComplianceTiles<Scalar>::kTileSize, Scalar{0});
        continue;
      }
      for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j, out += kClusterSize) {
          const std::int32_t column = columns_[q][j];
          for (int lane = 0; lane < kClusterSize; ++lane) {
            out[lane] = column < 0 ? Scalar{0} : static_cast<Scalar>(rows[i][lane][column]);
          }
        }
      }
    }
  }

  const Plan& plan_;
  const ComplianceTiles<Scalar> tiles_;
  const int block_nodes_;
  ColumnSolver solver_;
  std::vector<double> zero_;
  std::vector<std::int32_t> positions_;
  std::vector<Positions> columns_;  // [nodes of the block] columns of their components
};

// Hands out 0, 1, .. count - 1 to the workers, which call work(worker, item). Returns false when it was
// stopped. What a worker throws ends all of them, and is thrown here.
template <class Work>
bool share_out(int threads, std::int32_t count, const std::function<bool()>& stopped, Work work) {
  std::atomic<std::int32_t> next{0};
  std::atomic<bool> whole{true};
  std::exception_ptr failure;
  std::mutex failing;
  const auto run = [&](int w) {
    for (std::int32_t item; whole && (item = next++) < count;) {
      if (stopped && stopped()) {
        whole = false;
        return;
      }
      work(w, item);
    }
  };
  {
    std::vector<std::jthread> workers;
    for (int w = 0; w < threads; ++w) {
      workers.emplace_back([&, w] {
        try {
          run(w);
        } catch (...) {
          const std::lock_guard lock(failing);
          failure = std::current_exception();
          whole = false;
        }
      });
    }
  }
  if (failure) std::rethrow_exception(failure);
  return whole;
}

// Counts finished blocks for whoever wants to know how far it is.
class Progress {
 public:
  Progress(std::int32_t count, const std::function<void(double)>& report) : count_(count), report_(report) {}

  void one_more() {
    if (!report_) return;
    const std::lock_guard lock(reporting_);
    report_(static_cast<double>(++done_) / count_);
  }

 private:
  const std::int32_t count_;
  const std::function<void(double)>& report_;
  std::mutex reporting_;
  std::int32_t done_ = 0;
};

// Tells that whole columns are not needed again soon.
template <class Scalar>
void set_idle(const ComplianceTiles<Scalar>& tiles, std::int32_t first, std::int32_t count,
              const TensorOptions& options) {
  const std::size_t column_bytes = tiles.size() / tiles.mobile_count * sizeof(Scalar);
  if (options.on_idle) options.on_idle(tiles.tile(first, 0), count * column_bytes);
}

// Every pair of nodes once: C_nk for rank[n] >= rank[k], a block of columns at a time.
template <class Scalar>
bool solve_columns(const Supernodes& factor, const Plan& plan, const ComplianceTiles<Scalar>& tiles,
                   const TensorOptions& options) {
  const int threads = std::max(1, options.threads);
  const int block_nodes = choose_block_nodes(tiles.size() * sizeof(Scalar), factor.size, threads);
  const std::int32_t blocks = (tiles.mobile_count + block_nodes - 1) / block_nodes;
  std::vector<BlockWriter<Scalar>> writers;
  writers.reserve(threads);
  for (int w = 0; w < threads; ++w) writers.emplace_back(factor, plan, tiles, block_nodes);
  Progress progress(blocks, options.on_progress);
  return share_out(threads, blocks, options.stopped, [&](int w, std::int32_t block) {
    for (const std::int32_t k : writers[w].run(block * block_nodes)) set_idle(tiles, k, 1, options);
    progress.one_more();
  });
}

// The other half of the pairs. From the last cluster down: it has the most pairs, and its columns are then
// complete.
template <class Scalar>
bool mirror_columns(const Plan& plan, const ComplianceTiles<Scalar>& tiles, const TensorOptions& options) {
  const std::int32_t clusters = tiles.cluster_count();
  return share_out(std::max(1, options.threads), clusters, options.stopped, [&](int, std::int32_t item) {
    const std::int32_t cluster = clusters - 1 - item;
    mirror_cluster<Scalar>(tiles, plan.rank, cluster);
    const std::int32_t first = cluster * kClusterSize;
    set_idle(tiles, first, std::min(kClusterSize, tiles.mobile_count - first), options);
  });
}

template <class Scalar>
bool bound_columns(const geometry::Surface& surface, const ComplianceTiles<Scalar>& tiles,
                   std::span<float> bounds, const TensorOptions& options) {
  const int threads = std::max(1, options.threads);
  const std::int32_t clusters = tiles.cluster_count();
  const ClusterReach reach = cluster_reach(surface);
  std::vector<std::vector<float>> scratch(threads, std::vector<float>(clusters * kClusterSize));
  return share_out(threads, tiles.mobile_count, options.stopped, [&](int w, std::int32_t k) {
    bound_column(tiles, reach, k, bounds.data() + static_cast<std::size_t>(k) * clusters, scratch[w]);
    set_idle(tiles, k, 1, options);
  });
}

}  // namespace

template <class Scalar>
bool compute_force_tensors(const StiffnessFactor& factor, const FreeDofs& free,
                           const geometry::Surface& surface, const ComplianceTiles<Scalar>& tiles,
                           std::span<float> bounds, const TensorOptions& options) {
  const BlasThreads one_per_worker(1);
  const Supernodes supernodes = factor.supernodes();
  const Plan plan = plan_columns(supernodes, free, surface);
  if (!solve_columns(supernodes, plan, tiles, options)) return false;
  if (!mirror_columns(plan, tiles, options)) return false;
  return bound_columns(surface, tiles, bounds, options);
}

template bool compute_force_tensors(const StiffnessFactor&, const FreeDofs&, const geometry::Surface&,
                                    const ComplianceTiles<float>&, std::span<float>, const TensorOptions&);
template bool compute_force_tensors(const StiffnessFactor&, const FreeDofs&, const geometry::Surface&,
                                    const ComplianceTiles<double>&, std::span<float>, const TensorOptions&);

}  // namespace omentum::physics
