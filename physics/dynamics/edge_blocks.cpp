#include "physics/dynamics/edge_blocks.h"

#include <algorithm>
#include <numeric>

namespace omentum::physics {

namespace {

using kernels::kEdgeBlocks;
using kernels::kEdgeLanes;
using kernels::kNodeFloats;
using kernels::kNodeStride;
using kernels::kPlane;

using Rows = std::vector<std::vector<std::int32_t>>;

// [N]: the edges that each node answers for: of two nodes the one that has fewer so far.
Rows shared_out(const TensorBooks& books) {
  Rows rows(books.node_count());
  for (std::size_t e = 0; e < books.edges().size(); ++e) {
    const auto [a, b] = books.edges()[e];
    rows[rows[b].size() < rows[a].size() ? b : a].push_back(static_cast<std::int32_t>(e));
  }
  return rows;
}

std::vector<std::int32_t> longest_first(const Rows& rows) {
  std::vector<std::int32_t> order(rows.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(order, std::ranges::greater{}, [&](std::int32_t n) { return rows[n].size(); });
  return order;
}

}  // namespace

AlignedFloats::AlignedFloats(std::size_t size)
    : values_(static_cast<float*>(::operator new[](size * sizeof(float), kAligned))), size_(size) {
  std::fill_n(values_.get(), size, 0.f);
}

EdgeBlocks::EdgeBlocks(const TensorBooks& books)
    : node_count_(static_cast<std::int32_t>(books.node_count())), places_(books.edges().size()), blocks_(0) {
  place_rows(books, shared_out(books));
  blocks_ = AlignedFloats(steps() * kEdgeBlocks);
}

void EdgeBlocks::place_rows(const TensorBooks& books, const Rows& rows) {
  const std::vector<std::int32_t> order = longest_first(rows);
  start_.push_back(0);
  for (std::size_t first = 0; first < order.size(); first += kEdgeLanes) {
    const std::int32_t begin = start_.back();
    const auto length = static_cast<std::int32_t>(rows[order[first]].size());
    start_.push_back(begin + length);
    neighbours_.resize(static_cast<std::size_t>(start_.back()) * kEdgeLanes);
    for (int lane = 0; lane < kEdgeLanes; ++lane) {
      const bool filled = first + lane < order.size();
      const std::int32_t n = filled ? order[first + lane] : order.back();
      rows_.push_back(n * kNodeStride);
      for (std::int32_t i = 0; i < length; ++i) {
        const std::int32_t step = begin + i;
        // where there is no edge the node is its own neighbour
        NodeId k(n);
        if (filled && i < static_cast<std::int32_t>(rows[n].size())) {
          const std::int32_t e = rows[n][i];
          const auto [a, b] = books.edges()[e];
          k = a == n ? b : a;
          places_[e] = {step * kEdgeBlocks + lane * kNodeFloats, b == n};
        }
        neighbours_[static_cast<std::size_t>(step) * kEdgeLanes + lane] = k * kNodeStride;
      }
    }
  }
}

void EdgeBlocks::refresh(const TensorBooks& books, std::int32_t e) noexcept {
  const Place& place = places_[e];
  const Eigen::Matrix3d& K_ab = books.edge(e);
  for (int diagonal = 0; diagonal < 3; ++diagonal) {
    float* plane = blocks_.data() + place.first_float + diagonal * kPlane;
    for (int i = 0; i < 3; ++i) {
      const int j = (i + diagonal) % 3;
      plane[i] = static_cast<float>(place.turned ? K_ab(j, i) : K_ab(i, j));
    }
  }
}

kernels::EdgeSlices EdgeBlocks::slices() const noexcept {
  return {start_.data(),
          rows_.data(),
          neighbours_.data(),
          blocks_.data(),
          static_cast<std::int32_t>(start_.size()) - 1,
          node_count_};
}

}  // namespace omentum::physics
