// Inputs as files, for engines and for people who look at one.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace omentum::fuzz {

/// Writes each seed as a file of its own, "seed-<number>", into a folder that is made where it is absent.
void write_seeds(const std::filesystem::path& folder);

/// The whole contents of all files of a folder, by name; none where it is absent.
std::vector<std::string> read_inputs(const std::filesystem::path& folder);

}  // namespace omentum::fuzz
