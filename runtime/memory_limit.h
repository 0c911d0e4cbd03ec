// How much memory there is for a process, on a machine or in a container.
#pragma once

#include <cstdint>
#include <filesystem>

namespace omentum::runtime {

/// What this process and those beside it may take together, bytes: the machine's memory, or less where a
/// control group that holds them limits it (version 2: memory.max, version 1: memory.limit_in_bytes). Any
/// thread; reads files.
std::uint64_t memory_limit_bytes();

/// The same for a machine of `machine_bytes` whose files /proc and /sys lie under `root`.
std::uint64_t memory_limit_bytes(const std::filesystem::path& root, std::uint64_t machine_bytes);

/// Whether so much may be kept in memory for good: half of what there is, so that everybody else has room.
bool may_stay_in_memory(std::uint64_t bytes, std::uint64_t limit_bytes);

}  // namespace omentum::runtime
