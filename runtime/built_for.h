// The instruction sets that kernels of this build use without asking (cmake/OmentumOptions.cmake,
// omentum_native).
#pragma once

#include <span>

namespace omentum::runtime {

/// Their names, as __builtin_cpu_supports takes them, each a literal. Empty where OMENTUM_NATIVE is off. Data
/// alone: that it is read needs none of them.
std::span<const char* const> built_for() noexcept;

}  // namespace omentum::runtime
