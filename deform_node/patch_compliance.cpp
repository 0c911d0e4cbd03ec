#include "deform_node/patch_compliance.h"

#include "node_common/contact_bounds.h"

#include <algorithm>
#include <cmath>

namespace omentum::deform {

namespace {

// What is held does not yield, and a hand's matrix has to be definite.
void stiffen_supports(std::span<float> compliance, std::size_t rows) noexcept {
  float most = 0;
  for (std::size_t r = 0; r < rows; ++r) most = std::max(most, compliance[r * rows + r]);
  const float held = most > 0 ? 1e-6F * most : 1e-7F;
  for (std::size_t r = 0; r < rows; ++r) compliance[r * rows + r] = std::max(compliance[r * rows + r], held);
}

}  // namespace

bool tell_compliance(std::span<float> block, LocalPatch& patch) noexcept {
  const std::size_t rows = 3 * patch.node_count;
  stiffen_supports(block, rows);
  // written so that a NaN is none either
  if (!std::ranges::all_of(block, [](float c) { return std::abs(c) <= node::kSoftest_m_n; })) return false;
  float* upper = patch.compliance.data();
  for (std::size_t r = 0; r < rows; ++r)
    upper = std::copy(block.begin() + static_cast<std::ptrdiff_t>(r * rows + r),
                      block.begin() + static_cast<std::ptrdiff_t>((r + 1) * rows), upper);
  return true;
}

}  // namespace omentum::deform
