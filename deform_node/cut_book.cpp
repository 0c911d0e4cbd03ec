#include "deform_node/cut_book.h"

#include "node_common/vectors.h"

#include <algorithm>

namespace omentum::deform {

namespace {

constexpr auto kSilence_ns = static_cast<std::int64_t>(1e9 * kCutSilence_s);

std::array<Vec3, 2> ends_of(const msg::Edge& edge) {
  return {node::to_vector(edge.begin), node::to_vector(edge.end)};
}

}  // namespace

void CutBook::take(const msg::Contact& contact, std::int64_t now_ns) noexcept {
  Line& line = lines_[contact.tool];
  const bool silent = line.heard_ns == 0 || now_ns - line.heard_ns > kSilence_ns;
  if (!silent && contact.seq <= line.seq) return;
  line.cuts &= !silent;
  sweep(contact, line, now_ns);
  line.heard_ns = now_ns;
  line.seq = contact.seq;
  line.cut = contact.cut_count;
  levels_[contact.tool].post({line.cuts, line.cut, line.edge, now_ns});
}

// From the newest edge that is known of this cut to the sample's own way, and on. What finds no room leaves
// the edge where it is known, so that the next sample sweeps all of it.
void CutBook::sweep(const msg::Contact& contact, Line& line, std::int64_t now_ns) noexcept {
  const bool goes_on = line.cuts && line.cut == contact.cut_count;
  line.cuts = contact.cutting;
  if (!contact.cutting && !goes_on) return;
  if (!goes_on) line.edge = ends_of(contact.edge_before);
  for (const Edge& to : {ends_of(contact.edge_before), ends_of(contact.edge)}) {
    if (to == line.edge) continue;
    if (!push({contact.tool, contact.cut_count, line.edge, to}, now_ns)) return;
    line.edge = to;
  }
}

bool CutBook::push(const CutStroke& stroke, std::int64_t now_ns) noexcept {
  const std::uint64_t at = written_.load(std::memory_order_relaxed);
  if (at - read_.load(std::memory_order_acquire) >= ring_.size()) return false;
  ring_[at % ring_.size()] = {stroke, now_ns};
  written_.store(at + 1, std::memory_order_release);
  return true;
}

void CutBook::advance(std::int64_t now_ns) noexcept {
  count_ = 0;
  take_waiting();
  add_resting(now_ns);
}

void CutBook::take_waiting() noexcept {
  const std::uint64_t end = written_.load(std::memory_order_acquire);
  std::uint64_t at = read_.load(std::memory_order_relaxed);
  for (; at != end; ++at) {
    const Waiting& waiting = ring_[at % ring_.size()];
    if (waiting.received_ns > forget_until_ns_) strokes_[count_++] = waiting.stroke;
  }
  read_.store(at, std::memory_order_release);
}

void CutBook::add_resting(std::int64_t now_ns) noexcept {
  const std::size_t moved = count_;
  for (std::uint32_t tool = 0; tool < msg::MAX_TOOLS; ++tool) {
    levels_[tool].fetch();
    const Level& level = levels_[tool].value();
    const auto is_swept = [&](const CutStroke& stroke) { return stroke.tool == tool; };
    if (!level.cuts || level.received_ns <= forget_until_ns_ || now_ns - level.received_ns > kSilence_ns ||
        std::any_of(strokes_.begin(), strokes_.begin() + static_cast<std::ptrdiff_t>(moved), is_swept))
      continue;
    strokes_[count_++] = {tool, level.cut, level.edge, level.edge};
  }
}

}  // namespace omentum::deform
