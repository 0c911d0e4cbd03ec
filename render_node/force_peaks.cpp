#include "render_node/force_peaks.h"

#include "node_common/vectors.h"
#include "render_node/plausible.h"

namespace omentum::render {

void ForcePeaks::take(const msg::ToolForce& force) noexcept {
  if (force.tool >= peaks_n_.size() || !is_plausible(force, most_n_.load(std::memory_order_relaxed))) return;
  const double force_n = node::to_vector(force.force).norm();
  if (force_n > peak_n(force.tool)) peaks_n_[force.tool].store(force_n, std::memory_order_relaxed);
}

}  // namespace omentum::render
