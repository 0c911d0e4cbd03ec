// What the tools' contacts did in a tick, in joules.
#pragma once

#include "haptic_node/haptic_model.h"

#include <span>

namespace omentum::haptic {

/// `free_gaps`, `gaps`: [contacts] p - X without and with the tissue's displacement, m, after the solve whose
/// forces the contacts carry; `before`: [contacts] their forces of the last tick, N. `works`: [tools],
/// overwritten. No allocation.
void measure_work(const HapticModel& model, const HapticState& state, std::span<const Vec3> before,
                  std::span<const Vec3> free_gaps, std::span<const Vec3> gaps,
                  std::span<ContactWork> works) noexcept;

/// What tissue that moves by itself takes from a hand is lent to it, and held for the hand as a dent is; what
/// it gives beyond that is given as by another tool; what changes of a model give counts only as far as they
/// took (ModelChanges). After measure_work.
void settle_own_motion(HapticState& state, std::span<ContactWork> works) noexcept;

/// What passed between the tools through the tissue, by Betti's theorem: with f before and f' after,
///     exchanged_t = 1/2 sum_{i of t, j not of t} (f'_i . W_ij f_j - f_i . W_ij f'_j),
/// antisymmetric in the tools, so that a hand at rest feels another's press as energy given and not as its
/// own gain; for each pair times the share of the one that gives: what one hand's account loses is what the
/// other's gains. `problem`: the one that was solved.
void measure_exchange(const physics::ContactProblem& problem, const HapticState& state,
                      std::span<const Vec3> before, std::span<ContactWork> works) noexcept;

}  // namespace omentum::haptic
