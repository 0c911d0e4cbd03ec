// What touches what, from the wire to the picture and the panel.
#pragma once

#include "render_node/panel_view.h"
#include "render_node/touch_link.h"
#include "render_node/touch_marks.h"

namespace omentum::render {

/// Reads and draws while it is on. One thread, the renderer's.
class TouchView {
 public:
  /// Marks that nobody told anew for so long are of another state than what is drawn.
  static constexpr std::int64_t kGone_ns = 1'000'000'000;

  /// All outlive this.
  TouchView(transport::Bus& bus, std::size_t organ_count, Renderer& renderer, const runtime::Clock& clock,
            runtime::FaultList& faults)
      : link_(bus, organ_count, clock, faults), marks_(renderer), clock_(clock) {}

  /// Adds the newest marks where the view is `on`.
  void draw(bool on, Frame& frame);
  /// Of what was drawn last.
  TouchRow row() const { return row_; }

 private:
  TouchLink link_;
  TouchMarks marks_;
  const runtime::Clock& clock_;
  std::int64_t arrived_ns_ = 0;
  TouchRow row_;
};

}  // namespace omentum::render
