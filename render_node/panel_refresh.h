// When the panel's picture is drawn anew.
#pragma once

#include <cstdint>
#include <limits>

namespace omentum::render {

/// What a panel says changes at every frame, but nobody reads figures that often, and on a processor its text
/// costs as much as a coarse picture of the scene. So what changed by itself waits for kPanelPeriod_s since
/// the panel was drawn last; what follows an act of a person (a key, the mouse over the panel) is drawn at
/// once, and for kAnswer_s longer, in which the other nodes answer. No clock: times are given. One thread.
class PanelRefresh {
 public:
  static constexpr double kPanelPeriod_s = 0.25, kAnswer_s = 0.4;

  /// `content`: a hash of what would be drawn. True: draw it, and that is taken as done.
  bool due(std::uint64_t content, double now_s, bool acted);
  /// What was drawn is lost.
  void forget() { drawn_s_ = -std::numeric_limits<double>::infinity(), known_ = false; }

 private:
  std::uint64_t content_ = 0;
  bool known_ = false;
  double drawn_s_ = -std::numeric_limits<double>::infinity();
  double acted_s_ = -std::numeric_limits<double>::infinity();
};

}  // namespace omentum::render
