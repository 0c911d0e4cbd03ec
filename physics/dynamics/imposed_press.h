// Tools that press a body as far as a hand says, not as hard.
#pragma once

#include "physics/dynamics/body_state.h"
#include "physics/dynamics/yielding.h"

#include <vector>

namespace omentum::physics {

/// What a tool's hand found with the body's last local model: where its nodes are and what that costs. Equal
/// lengths.
struct Press {
  static constexpr double kMostStrength = 2;

  std::span<const geometry::NodeId> nodes;
  std::span<const geometry::Vec3> displacements;  // from rest, in W, m
  std::span<const geometry::Vec3> forces;         // on the body, in W, N
  // the dent that it already makes in places with a wall of their own is not in the displacements
  double own_yield_j = 0;  // work of these forces on what the places give way beside the body's nodes
  double most_strength = kMostStrength;  // less where the hand fell silent, or its forces would not fade
  double least_strength = 0;             // less for a pattern that may pull
  double already = 0;                    // how strong it was in the step that is ended
};

/// Ends an implicit step that was made without the tools so that each press is as deep as its hand says: one
/// constraint per tool, along the pattern F of its forces,
///
///     sum_i F_i . u_i = sum_i F_i . u*_i,   answered by s F, 0 <= s <= most_strength.
///
/// Places with a wall of their own, which no node of the body follows, are deeper by s times its yield.
///
/// A hand at 1 kHz answers a body that it knows from milliseconds ago. Its forces, applied as they come, are
/// a loop with a delay, which light bodies make unstable; its positions are not, and both end in the same
/// rest, with s = 1 (docs/design.md, "Local models"). No press pulls more than its own pattern
/// does, and none is more than kMostStrength times as strong as the hand that made it.
///
/// All memory is taken at construction; one thread at a time.
class ImposedPress {
 public:
  ImposedPress(std::size_t node_count, std::size_t most_presses);

  /// `u` and `v` are those of a step of `body` with all other forces, [3N], and the presses as strong as they
  /// already were. The strengths s, [presses]; they are valid until the next call. Precondition: at most
  /// `most_presses`.
  std::span<const double> impose(Yielding& body, std::span<const Press> presses, std::span<double> u,
                                 std::span<double> v) noexcept;
  std::span<const double> impose(Yielding& body, std::span<const Press> presses, BodyState& state) noexcept {
    return impose(body, presses, state.u, state.v);
  }

 private:
  void solve(std::span<const Press> presses) noexcept;

  std::vector<std::vector<double>>
      yields_;                    // [presses][3N], of the body to each pattern, m; guesses of the next
  std::vector<double> pattern_;   // [3N]
  std::vector<double> coupling_;  // [presses][presses], work of one's pattern on another's yield, J
  std::vector<double> lacking_, strength_;  // [presses]
  std::size_t count_ = 0;
};

}  // namespace omentum::physics
