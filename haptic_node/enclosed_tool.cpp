#include "haptic_node/enclosed_tool.h"

namespace omentum::haptic {

void expect_tissue_back(std::int64_t now_ns, HapticState& state) noexcept {
  state.tissue_back_until_ns = now_ns + static_cast<std::int64_t>(1e9 * kTissueBack_s);
}

}  // namespace omentum::haptic
