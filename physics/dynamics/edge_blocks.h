// The edge tensors of a mesh in float, in the order in which a vector unit takes them.
#pragma once

#include "physics/dynamics/edge_kernels.h"
#include "physics/dynamics/tensor_books.h"

#include <memory>
#include <new>

namespace omentum::physics {

/// Floats on cache lines.
class AlignedFloats {
 public:
  explicit AlignedFloats(std::size_t size);
  float* data() { return values_.get(); }
  const float* data() const { return values_.get(); }
  std::size_t size() const { return size_; }

 private:
  static constexpr std::align_val_t kAligned{64};
  struct Free {
    void operator()(float* values) const { ::operator delete[](values, kAligned); }
  };
  std::unique_ptr<float[], Free> values_;
  std::size_t size_;
};

/// Each edge is of one of its nodes, so that all have about as many; rows are sorted by length and taken
/// kEdgeLanes at a time, the short ones filled up with edges that hold nothing (kernels::EdgeSlices).
class EdgeBlocks {
 public:
  /// Allocates; all blocks are zero until they are set.
  explicit EdgeBlocks(const TensorBooks& books);

  /// Takes the tensor of edge `e` over from the books, rounded to float. Does not allocate.
  void refresh(const TensorBooks& books, std::int32_t e) noexcept;

  kernels::EdgeSlices slices() const noexcept;

  /// Steps of kEdgeLanes edges, the empty ones included.
  std::size_t steps() const { return neighbours_.size() / kernels::kEdgeLanes; }

 private:
  struct Place {
    std::int32_t first_float;  // of the edge's lane in plane 0
    bool turned;               // the row is the edge's b: its block is K_ba
  };
  void place_rows(const TensorBooks& books, const std::vector<std::vector<std::int32_t>>& rows);

  std::int32_t node_count_;
  std::vector<std::int32_t> start_, rows_, neighbours_;
  std::vector<Place> places_;  // [E]
  AlignedFloats blocks_;
};

}  // namespace omentum::physics
