// What lies between the columns of a gut's parts, in guts so fine that parts span several columns.
#pragma once

#include "physics/intestine/gut_parts.h"

#include <cstdint>
#include <span>

namespace omentum::physics {

/// Of the tube's radius: how far a mass between may be from the chord of its part. A tube that is bent as
/// tightly as it can be is within 0.03 of it.
inline constexpr double kOffChord = 0.2;

/// Masses between get the gaps of the columns around them, all of them less the room that two neighbours need
/// to be off their chords: chords that are farther apart than that stay so, and what is between them does not
/// meet. [masses], m. Nothing where each column is the parts' own.
void spread_gaps(const GutParts& parts, std::span<double> gap_m) noexcept;

/// Brings masses between back to kOffChord of their chord; their velocities go along. Sets `held` to 1 for
/// each of them. All [masses].
void keep_near_chords(const GutParts& parts, double step_s, std::span<geometry::Vec3> x,
                      std::span<geometry::Vec3> v, std::span<std::uint8_t> held) noexcept;

}  // namespace omentum::physics
