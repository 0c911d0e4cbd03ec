// Tissue burns through: tetrahedra between the moment in which an edge meets them and that in which they go.
#pragma once

#include "geometry/mesh_editor.h"

#include <span>
#include <vector>

namespace omentum::deform {

/// First met, first gone: each waits the same time, and so many go in a second. One that is met again while
/// it waits keeps its place. Takes its memory when it is made.
class CutQueue {
 public:
  /// `rate_per_s` is above zero.
  CutQueue(std::size_t tetrahedra, double delay_s, double rate_per_s);

  /// An edge meets these now; what is gone already is left out.
  void meet(std::span<const geometry::TetId> met, const geometry::MeshEditor& editor) noexcept;
  /// Those that go within the next `dt_s`, but for what is gone otherwise by now; valid until the next call.
  std::span<const geometry::TetId> burn(double dt_s, const geometry::MeshEditor& editor) noexcept;
  /// Nothing waits any more.
  void clear() noexcept;

 private:
  struct Waiting {
    geometry::TetId t;
    double until_s;
  };

  double delay_s_, rate_per_s_;
  double now_s_ = 0;
  double allowance_ = 0;       // tetrahedra that may go
  std::vector<Waiting> ring_;  // [T], `count_` of them from `first_` on
  std::size_t first_ = 0, count_ = 0;
  std::vector<bool> waits_;  // [T]
  std::vector<geometry::TetId> burnt_;
};

}  // namespace omentum::deform
