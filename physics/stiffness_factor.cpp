#include "physics/stiffness_factor.h"

#include <cholmod.h>

#include <algorithm>
#include <stdexcept>

namespace omentum::physics {

namespace {

// CHOLMOD's settings and workspace: one per thread that calls it.
class Cholmod {
 public:
  Cholmod() {
    cholmod_start(&common_);
    common_.print = 0;
    common_.supernodal = CHOLMOD_SUPERNODAL;
    common_.final_ll = true;
  }
  ~Cholmod() { cholmod_finish(&common_); }
  Cholmod(const Cholmod&) = delete;
  Cholmod& operator=(const Cholmod&) = delete;

  cholmod_common* get() { return &common_; }
  int status() const { return common_.status; }

 private:
  cholmod_common common_{};
};

void require(bool ok, const char* what) {
  if (!ok) throw std::runtime_error(std::string("CHOLMOD could not ") + what + ": probably out of memory");
}

// A sparse matrix in CHOLMOD's form over memory that vectors own.
struct Compressed {
  std::vector<int> start{0};
  std::vector<int> row;
  std::vector<double> value;  // empty: a pattern only

  void end_column() { start.push_back(static_cast<int>(row.size())); }

  cholmod_sparse view(int stype) {
    cholmod_sparse matrix{};
    matrix.nrow = matrix.ncol = start.size() - 1;
    matrix.nzmax = row.size();
    matrix.p = start.data();
    matrix.i = row.data();
    matrix.x = value.empty() ? nullptr : value.data();
    matrix.stype = stype;
    matrix.itype = CHOLMOD_INT;
    matrix.xtype = value.empty() ? CHOLMOD_PATTERN : CHOLMOD_REAL;
    matrix.dtype = CHOLMOD_DOUBLE;
    matrix.sorted = matrix.packed = true;
    return matrix;
  }
};

constexpr int kLowerTriangle = -1;

// The nodes' graph, lower triangle. Ordering it instead of the degrees of freedom is nine times less work,
// and keeps a node's components together.
Compressed node_graph(const Stiffness& stiffness) {
  Compressed graph;
  for (std::int32_t n = 0; n < stiffness.node_count(); ++n) {
    for (std::int32_t b = stiffness.start[n]; b < stiffness.start[n + 1]; ++b) {
      if (stiffness.neighbour[b] >= n) graph.row.push_back(stiffness.neighbour[b]);
    }
    graph.end_column();
  }
  return graph;
}

// The order in which nodes are eliminated.
std::vector<int> order_nodes(const Stiffness& stiffness, Cholmod& cholmod) {
  Compressed graph = node_graph(stiffness);
  cholmod_sparse matrix = graph.view(kLowerTriangle);
  std::vector<int> order(matrix.ncol);
  // METIS needs two nodes at least.
  const bool ok = matrix.ncol > 1 ? cholmod_metis(&matrix, nullptr, 0, 1, order.data(), cholmod.get())
                                  : cholmod_amd(&matrix, nullptr, 0, order.data(), cholmod.get());
  require(ok, "order the nodes");
  return order;
}

std::vector<int> order_dofs(const Stiffness& stiffness, const FreeDofs& free, Cholmod& cholmod) {
  std::vector<int> order;
  order.reserve(free.count);
  for (const int n : order_nodes(stiffness, cholmod)) {
    for (int axis = 0; axis < 3; ++axis) {
      const std::int32_t dof = free.of(NodeId(n), axis);
      if (dof >= 0) order.push_back(dof);
    }
  }
  return order;
}

// K over the free degrees of freedom, lower triangle by columns.
Compressed free_part(const Stiffness& stiffness, const FreeDofs& free) {
  Compressed K;
  K.start.reserve(free.count + 1);
  K.row.reserve(stiffness.block.size() * 5);
  K.value.reserve(stiffness.block.size() * 5);
  for (std::int32_t n = 0; n < stiffness.node_count(); ++n) {
    for (int j = 0; j < 3; ++j) {
      const std::int32_t column = free.of(NodeId(n), j);
      if (column < 0) continue;
      for (std::int32_t b = stiffness.start[n]; b < stiffness.start[n + 1]; ++b) {
        for (int i = 0; i < 3; ++i) {
          const std::int32_t row = free.of(stiffness.neighbour[b], i);
          if (row < column) continue;
          K.row.push_back(row);
          K.value.push_back(stiffness.block[b](j, i));
        }
      }
      K.end_column();
    }
  }
  return K;
}

}  // namespace

struct StiffnessFactor::Impl {
  mutable Cholmod cholmod;
  cholmod_factor* factor = nullptr;

  ~Impl() { cholmod_free_factor(&factor, cholmod.get()); }
};

StiffnessFactor::StiffnessFactor(const Stiffness& stiffness, const FreeDofs& free)
    : impl_(std::make_unique<Impl>()) {
  Cholmod& cholmod = impl_->cholmod;
  std::vector<int> order = order_dofs(stiffness, free, cholmod);
  Compressed K = free_part(stiffness, free);
  cholmod_sparse matrix = K.view(kLowerTriangle);

  cholmod.get()->nmethods = 1;
  cholmod.get()->method[0].ordering = CHOLMOD_GIVEN;
  impl_->factor = cholmod_analyze_p(&matrix, order.data(), nullptr, 0, cholmod.get());
  require(impl_->factor != nullptr, "analyze the stiffness");

  const bool ok = cholmod_factorize(&matrix, impl_->factor, cholmod.get());
  if (cholmod.status() == CHOLMOD_NOT_POSDEF) {
    throw FloatingError("the supports leave the organ floating: its stiffness is not positive definite");
  }
  require(ok && cholmod.status() == CHOLMOD_OK, "factorize the stiffness");
}

StiffnessFactor::~StiffnessFactor() = default;
StiffnessFactor::StiffnessFactor(StiffnessFactor&&) noexcept = default;
StiffnessFactor& StiffnessFactor::operator=(StiffnessFactor&&) noexcept = default;

Eigen::MatrixXd StiffnessFactor::solve(const Eigen::MatrixXd& forces) const {
  Cholmod cholmod;
  cholmod_dense right{};
  right.nrow = right.d = forces.rows();
  right.ncol = forces.cols();
  right.nzmax = forces.size();
  right.x = const_cast<double*>(forces.data());  // CHOLMOD only reads it
  right.xtype = CHOLMOD_REAL;
  right.dtype = CHOLMOD_DOUBLE;
  cholmod_dense* left = cholmod_solve(CHOLMOD_A, impl_->factor, &right, cholmod.get());
  require(left != nullptr, "solve");
  Eigen::MatrixXd solution =
      Eigen::Map<const Eigen::MatrixXd>(static_cast<const double*>(left->x), forces.rows(), forces.cols());
  cholmod_free_dense(&left, cholmod.get());
  return solution;
}

Supernodes StiffnessFactor::supernodes() const {
  const cholmod_factor& L = *impl_->factor;
  Supernodes view;
  view.size = static_cast<std::int32_t>(L.n);
  view.count = static_cast<std::int32_t>(L.nsuper);
  view.first_column = static_cast<const int*>(L.super);
  view.row_start = static_cast<const int*>(L.pi);
  view.value_start = static_cast<const int*>(L.px);
  view.rows = static_cast<const int*>(L.s);
  view.values = static_cast<const double*>(L.x);
  view.permutation = static_cast<const int*>(L.Perm);
  return view;
}

}  // namespace omentum::physics
