#include "render_node/panel_refresh.h"

namespace omentum::render {

bool PanelRefresh::due(std::uint64_t content, double now_s, bool acted) {
  if (acted) acted_s_ = now_s;
  if (known_ && content == content_) return false;
  if (known_ && now_s - drawn_s_ < kPanelPeriod_s && now_s - acted_s_ > kAnswer_s) return false;
  content_ = content;
  known_ = true;
  drawn_s_ = now_s;
  return true;
}

}  // namespace omentum::render
