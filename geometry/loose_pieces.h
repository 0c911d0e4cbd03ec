// The parts that what is left of a mesh falls into.
#pragma once

#include "geometry/remaining_tetrahedra.h"

#include <cstdint>
#include <span>
#include <vector>

namespace omentum::geometry {

/// Parts that no face connects, kept removal by removal. What was next to removed tetrahedra is searched from
/// all of these sides by turns, until the searches have met or have been through their parts, but for one of
/// each former piece: usually a few tetrahedra, and at most about as many as the smaller parts have, times
/// the number of searches. Takes its memory when it is made. `left` outlives it.
class LoosePieces {
 public:
  /// `volume`: [T], m^3.
  LoosePieces(const RemainingTetrahedra& left, std::vector<double> volume);

  /// Searches the whole of what is left. O(T).
  void count_anew() noexcept;

  /// One was removed; find_pieces() after all of them.
  void note_removed(TetId t) noexcept;

  /// Which pieces there are after these were removed since they were last known.
  void find_pieces(std::span<const TetId> removed) noexcept;

  /// All of a piece of less than this volume, m^3, that lies where find_pieces() looked last; empty: none.
  /// Valid until the next call.
  std::span<const TetId> smaller_than(double volume_m3) noexcept;

  std::int32_t count() const noexcept { return count_; }
  std::int32_t piece_of(TetId t) const noexcept { return piece_[static_cast<std::size_t>(t)]; }

 private:
  // A piece's books.
  struct Piece {
    std::int32_t tetrahedra = 0;
    double volume_m3 = 0;
    std::int32_t searches = 0;  // that have not met another of this piece, nor come to an end
  };
  // A list of tetrahedra, linked by next_; empty: both invalid.
  struct Chain {
    TetId first{}, last{};
  };
  // One search: what it has been through, then what it has reached.
  struct Search {
    Chain done, reached;
    std::int32_t piece;
    std::int32_t merged_into;  // itself, or another
    bool is_whole = false;     // it has been through a piece
  };

  void begin_searches(std::span<const TetId> removed) noexcept;
  void begin_search(TetId t) noexcept;
  void run_searches() noexcept;
  bool is_running(std::int32_t s) const noexcept;
  void advance(std::int32_t s) noexcept;
  void meet(std::int32_t s, std::int32_t other) noexcept;
  void part(Search& search) noexcept;
  void end_searches() noexcept;
  std::int32_t root(std::int32_t s) noexcept;
  std::int32_t new_piece() noexcept;
  void append(Chain& chain, TetId t) noexcept;
  void join(Chain& chain, const Chain& other) noexcept;
  void collect(TetId from) noexcept;
  template <class Visit>
  void for_each_in(const Chain& chain, Visit&& visit) const;

  const RemainingTetrahedra& left_;
  std::vector<double> volume_m3_;    // [T]
  std::vector<std::int32_t> piece_;  // [T], of those left
  std::vector<Piece> pieces_;        // [T]
  std::vector<std::int32_t> free_;   // numbers of no piece
  std::int32_t count_ = 0;
  std::vector<TetId> next_;               // [T], in the chain that holds it
  std::vector<std::int32_t> reached_by_;  // [T], a search; none between calls
  std::vector<Search> searches_;
  std::vector<std::int32_t> running_;  // of searches_
  std::vector<TetId> seeds_;           // where the last searches began
  std::vector<TetId> collected_;
  std::vector<bool> is_collected_;  // [T]; none between calls
};

}  // namespace omentum::geometry
