#include "geometry/loose_pieces.h"

#include "geometry/at_id.h"

#include <algorithm>
#include <utility>

namespace omentum::geometry {

LoosePieces::LoosePieces(const RemainingTetrahedra& left, std::vector<double> volume)
    : left_(left),
      volume_m3_(std::move(volume)),
      piece_(volume_m3_.size(), kNone),
      pieces_(volume_m3_.size()),
      next_(volume_m3_.size()),
      reached_by_(volume_m3_.size(), kNone),
      is_collected_(volume_m3_.size(), false) {
  free_.reserve(volume_m3_.size());
  searches_.reserve(volume_m3_.size());
  running_.reserve(volume_m3_.size());
  seeds_.reserve(volume_m3_.size());
  collected_.reserve(volume_m3_.size());
  count_anew();
}

void LoosePieces::count_anew() noexcept {
  std::ranges::fill(piece_, kNone);
  std::ranges::fill(pieces_, Piece{});
  free_.clear();
  for (std::size_t p = pieces_.size(); p > 0; --p) free_.push_back(static_cast<std::int32_t>(p) - 1);
  count_ = 0;
  for (std::size_t t = 0; t < piece_.size(); ++t) {
    if (piece_[t] != kNone || !left_.has(TetId(t))) continue;
    const std::int32_t number = new_piece();
    collect(TetId(t));
    for (const TetId member : collected_) {
      at(piece_, member) = number;
      at(pieces_, number).volume_m3 += at(volume_m3_, member);
    }
    at(pieces_, number).tetrahedra = static_cast<std::int32_t>(collected_.size());
  }
}

std::int32_t LoosePieces::new_piece() noexcept {
  const std::int32_t number = free_.back();
  free_.pop_back();
  ++count_;
  at(pieces_, number) = {};
  return number;
}

void LoosePieces::note_removed(TetId t) noexcept {
  const std::int32_t number = std::exchange(at(piece_, t), kNone);
  Piece& piece = at(pieces_, number);
  piece.volume_m3 -= at(volume_m3_, t);
  if (--piece.tetrahedra > 0) return;
  free_.push_back(number);
  --count_;
}

void LoosePieces::find_pieces(std::span<const TetId> removed) noexcept {
  begin_searches(removed);
  run_searches();
  end_searches();
}

void LoosePieces::begin_searches(std::span<const TetId> removed) noexcept {
  seeds_.clear();
  searches_.clear();
  running_.clear();
  for (const TetId t : removed) {
    for (const TetId neighbour : left_.links().across(t)) {
      if (left_.has_neighbour(neighbour) && at(reached_by_, neighbour) == kNone) begin_search(neighbour);
    }
  }
}

void LoosePieces::begin_search(TetId t) noexcept {
  const std::int32_t s = static_cast<std::int32_t>(searches_.size());
  seeds_.push_back(t);
  running_.push_back(s);
  searches_.push_back({{}, {}, at(piece_, t), s});
  append(searches_.back().reached, t);
  at(reached_by_, t) = s;
  ++at(pieces_, at(piece_, t)).searches;
}

void LoosePieces::run_searches() noexcept {
  while (!running_.empty()) {
    for (const std::int32_t s : running_) {
      if (is_running(s)) advance(s);
    }
    std::erase_if(running_, [this](std::int32_t s) { return !is_running(s); });
  }
}

// The last search of a piece need not go on: what it would find is what the others left.
bool LoosePieces::is_running(std::int32_t s) const noexcept {
  const Search& search = searches_[static_cast<std::size_t>(s)];
  return search.merged_into == s && !search.is_whole &&
         pieces_[static_cast<std::size_t>(search.piece)].searches > 1;
}

void LoosePieces::advance(std::int32_t s) noexcept {
  Search& search = at(searches_, s);
  const TetId t = search.reached.first;
  if (!t.valid()) return part(search);
  search.reached.first = at(next_, t);
  if (!search.reached.first.valid()) search.reached.last = {};
  append(search.done, t);
  for (const TetId neighbour : left_.links().across(t)) {
    if (!left_.has_neighbour(neighbour)) continue;
    if (at(reached_by_, neighbour) == kNone) {
      at(reached_by_, neighbour) = s;
      append(search.reached, neighbour);
    } else if (const std::int32_t other = root(at(reached_by_, neighbour)); other != s) {
      meet(s, other);
    }
  }
}

void LoosePieces::meet(std::int32_t s, std::int32_t other) noexcept {
  Search& search = at(searches_, s);
  join(search.done, at(searches_, other).done);
  join(search.reached, at(searches_, other).reached);
  at(searches_, other).merged_into = s;
  --at(pieces_, search.piece).searches;
}

// What the search has been through is no longer of the piece that it was of.
void LoosePieces::part(Search& search) noexcept {
  search.is_whole = true;
  Piece& rest = at(pieces_, search.piece);
  --rest.searches;
  const std::int32_t number = new_piece();
  Piece& own = at(pieces_, number);
  for_each_in(search.done, [&](TetId t) {
    at(piece_, t) = number;
    ++own.tetrahedra;
    own.volume_m3 += at(volume_m3_, t);
  });
  rest.tetrahedra -= own.tetrahedra;
  rest.volume_m3 -= own.volume_m3;
}

void LoosePieces::end_searches() noexcept {
  for (std::size_t s = 0; s < searches_.size(); ++s) {
    const Search& search = searches_[s];
    at(pieces_, search.piece).searches = 0;
    if (search.merged_into != static_cast<std::int32_t>(s)) continue;
    for (const Chain& chain : {search.done, search.reached})
      for_each_in(chain, [this](TetId t) { at(reached_by_, t) = kNone; });
  }
}

std::int32_t LoosePieces::root(std::int32_t s) noexcept {
  while (at(searches_, s).merged_into != s) {
    std::int32_t& parent = at(searches_, s).merged_into;
    s = parent = at(searches_, parent).merged_into;
  }
  return s;
}

void LoosePieces::append(Chain& chain, TetId t) noexcept {
  at(next_, t) = {};
  join(chain, {t, t});
}

void LoosePieces::join(Chain& chain, const Chain& other) noexcept {
  if (!other.first.valid()) return;
  if (chain.last.valid()) {
    at(next_, chain.last) = other.first;
  } else {
    chain.first = other.first;
  }
  chain.last = other.last;
}

template <class Visit>
void LoosePieces::for_each_in(const Chain& chain, Visit&& visit) const {
  for (TetId t = chain.first; t.valid(); t = next_[static_cast<std::size_t>(t)]) visit(t);
}

std::span<const TetId> LoosePieces::smaller_than(double volume_m3) noexcept {
  if (volume_m3 <= 0) return {};
  for (const TetId seed : seeds_) {
    if (!left_.has(seed) || at(pieces_, at(piece_, seed)).volume_m3 >= volume_m3) continue;
    collect(seed);
    return collected_;
  }
  return {};
}

void LoosePieces::collect(TetId from) noexcept {
  collected_.assign(1, from);
  is_collected_[static_cast<std::size_t>(from)] = true;
  for (std::size_t i = 0; i < collected_.size(); ++i) {
    for (const TetId neighbour : left_.links().across(collected_[i])) {
      if (!left_.has_neighbour(neighbour) || is_collected_[static_cast<std::size_t>(neighbour)]) continue;
      is_collected_[static_cast<std::size_t>(neighbour)] = true;
      collected_.push_back(neighbour);
    }
  }
  for (const TetId t : collected_) is_collected_[static_cast<std::size_t>(t)] = false;
}

}  // namespace omentum::geometry
