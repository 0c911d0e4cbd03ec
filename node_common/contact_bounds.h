// What a contact on the wire can be at most: the same for who moves the organ and for who draws it.
#pragma once

#include "transport/messages.h"

namespace omentum::node {

/// A tool's forces on the tissue may be this many times the largest force on a hand: the tissue carries what
/// the model says, which the hand's limit does not clamp. The stiffest wall that a usual device renders
/// (2,000 N/m) pressed by half a metre is 1,000 N, 100 times the usual limit of 10 N.
inline constexpr double kTissueHeadRoom = 100;

/// Softer no tissue is to a hand, m/N: what hangs by a thread is not told, and not believed.
inline constexpr float kSoftest_m_n = 1;

/// The sum of the lengths of a tool's forces on all nodes, N; not finite when one of them is not. A sum of
/// lengths, so that two that cancel each other count too. Any thread; allocates nothing.
double total_force_n(const msg::Contact& contact) noexcept;

/// Whether that sum can be a press in a scene whose hands may feel `max_force_n`. False for NaN and infinity.
bool within_scene(double total_force_n, double max_force_n) noexcept;

}  // namespace omentum::node
