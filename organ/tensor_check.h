// Whether the tensors of an organ file are those that were computed: a quick look, and a whole one.
#pragma once

#include "organ/stored_tensors.h"

#include <functional>
#include <string>

namespace omentum::organ {

/// Throws geometry::InputError, naming the column, unless every bound is finite and not negative, and every
/// diagonal block C_kk is finite, symmetric, zero in held components, positive in free ones and within its
/// bound. Reads 1/144 of the tensors and a page a column: a file of 3 GB is looked at within milliseconds
/// once it is in memory. Damage elsewhere is found by require_whole.
void require_sound(const StoredTensors& tensors, const Organ& organ, const std::filesystem::path& file);

/// Throws geometry::InputError unless the tensors have the checksum that organ_build noted. Reads all of
/// them: damage is found, a forged file is not (anybody can compute it).
void require_whole(const StoredTensors& tensors, const std::filesystem::path& file);

/// XXH3 (64 bits, hexadecimal) over the bounds, then the tiles. `on_read`, which may be empty, is told of
/// each part that will not be needed again.
template <class Scalar>
std::string tensor_checksum(const physics::ComplianceTiles<Scalar>& tiles, std::span<const float> bounds,
                            const std::function<void(const void* begin, std::size_t bytes)>& on_read = {});

}  // namespace omentum::organ
