// Ways to spoil an input, for an engine that sees nothing of what it tries.
#pragma once

#include <random>
#include <span>
#include <string>

namespace omentum::fuzz {

/// One to eight changes: bits, whole numbers at their limits (either byte order, or as text), pieces that are
/// left out, doubled, or come from another of `inputs`, and an early end. The same generator gives the same.
std::string spoilt(std::string input, std::span<const std::string> inputs, std::mt19937_64& random);

}  // namespace omentum::fuzz
