#include "render_node/touch_link.h"

#include "render_node/plausible.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace omentum::render {
namespace {

constexpr float kLargestPart_m = 1;  // no part of an organ is larger

bool is_plausible(const msg::TouchingPair& pair, std::size_t organ_count) {
  const std::array places{pair.one_x, pair.one_y, pair.one_z, pair.other_x, pair.other_y, pair.other_z};
  const auto in_room = [](float x) { return std::abs(x) <= static_cast<float>(kRoom_m); };
  const auto is_size = [](float radius_m) { return radius_m > 0 && radius_m <= kLargestPart_m; };
  return pair.organ_one < organ_count && pair.organ_other < organ_count &&
         std::ranges::all_of(places, in_room) && is_size(pair.radius_one) && is_size(pair.radius_other) &&
         pair.push >= 0 && std::isfinite(pair.push);
}

}  // namespace

bool is_plausible(const msg::TouchingPairs& block, std::size_t organ_count) {
  return block.block < block.block_count && block.block_count <= msg::MAX_TOUCHING_PAIRS &&
         std::ranges::all_of(block.pairs, [&](const auto& pair) { return is_plausible(pair, organ_count); });
}

void TouchLink::read(bool on) {
  if (on == (reader_ != nullptr)) return;
  reader_.reset();  // no callback runs any more
  newest_.fetch();
  coming_ = {};
  missing_.clear();
  if (on) reader_ = bus_.reader<msg::TouchingPairs>([this](const msg::TouchingPairs& block) { take(block); });
}

void TouchLink::take(const msg::TouchingPairs& block) {
  if (!is_plausible(block, organ_count_))
    return faults_.raise("touching pairs that no organ of the scene can have");
  if (block.seq != coming_.seq || block.block_count != missing_.size()) {
    if (!coming_.pairs.empty()) post();
    coming_ = {.seq = block.seq, .touching = block.touching, .arrived_ns = 0, .pairs = {}};
    missing_.assign(block.block_count, true);
  }
  if (!missing_[block.block]) return;
  missing_[block.block] = false;
  coming_.pairs.insert(coming_.pairs.end(), block.pairs.begin(), block.pairs.end());
  if (std::ranges::count(missing_, true) == 0) post();
}

// What comes of this moment after that is nothing new.
void TouchLink::post() {
  coming_.arrived_ns = clock_.now_ns();
  newest_.post(coming_);
  coming_.pairs.clear();
}

const TouchesHeard* TouchLink::fetch() {
  return newest_.fetch() ? &newest_.value() : nullptr;
}

}  // namespace omentum::render
