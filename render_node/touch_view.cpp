#include "render_node/touch_view.h"

#include <algorithm>

namespace omentum::render {

void TouchView::draw(bool on, Frame& frame) {
  link_.read(on);
  if (!on) row_ = {};
  if (!on) return;
  row_.on = true;
  if (const TouchesHeard* heard = link_.fetch()) {
    marks_.show(heard->pairs);
    arrived_ns_ = heard->arrived_ns;
    row_.count = heard->touching;
    row_.known = true;
    row_.hardest_n = 0;
    for (const msg::TouchingPair& pair : heard->pairs)
      row_.hardest_n = std::max(row_.hardest_n, static_cast<double>(pair.push));
  }
  row_.known = row_.known && clock_.now_ns() - arrived_ns_ <= kGone_ns;
  if (row_.known) marks_.draw(frame.items);
}

}  // namespace omentum::render
