#include "haptic_node/cutting_edge.h"

#include "geometry/precondition.h"
#include "node_common/vectors.h"

#include <algorithm>

namespace omentum::haptic {

CuttingEdge::CuttingEdge(std::span<const Vec3> edge) : exists_(!edge.empty()) {
  if (!exists_) return;
  geometry::require(edge.size() == 2, "an edge's begin and end");
  std::ranges::copy(edge, in_tool_.begin());
}

void CuttingEdge::follow(const ToolFrame& frame, bool engaged, bool pressed) noexcept {
  const bool cut_before = cuts_;
  cuts_ = exists_ && engaged && pressed;
  if (!cuts_ && !cut_before) return;
  if (engaged) {
    for (std::size_t i = 0; i < now_.size(); ++i) now_[i] = to_world(frame, in_tool_[i]);
  }
  if (!cut_before) {
    ++count_;
    before_ = now_;
  }
}

void CuttingEdge::fill(msg::Contact& contact) const noexcept {
  const auto edge_of = [](const Ends& ends) {
    return msg::Edge{.begin = node::to_message(ends[0]), .end = node::to_message(ends[1])};
  };
  contact.cutting = cuts_;
  contact.cut_count = count_;
  contact.edge_before = edge_of(cuts_ ? before_ : now_);
  contact.edge = edge_of(now_);
}

void CuttingEdge::told() noexcept {
  before_ = now_;
  told_cuts_ = cuts_;
}

}  // namespace omentum::haptic
