// What identifies an organ: everything that its tensors depend on.
#pragma once

#include "organ/organ.h"

namespace omentum::organ {

/// The organ file's layout and the numerics behind its tensors. A file of another version is built again.
inline constexpr int kFormatVersion = 3;

/// SHA-256, hexadecimal, over format version, storage, mesh (with the file's own numbers), surface order,
/// material, supports and, of a hybrid organ, its parts, whose columns its tensors are, and where parts touch
/// that share no nodes.
std::string organ_hash(const Organ& organ);

}  // namespace omentum::organ
