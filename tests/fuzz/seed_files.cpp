#include "tests/fuzz/seed_files.h"

#include "tests/fuzz/harness.h"

#include <algorithm>
#include <fstream>
#include <iterator>

namespace omentum::fuzz {

void write_seeds(const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
  int number = 0;
  for (const std::string& seed : seeds())
    std::ofstream(folder / ("seed-" + std::to_string(number++)), std::ios::binary) << seed;
}

std::vector<std::string> read_inputs(const std::filesystem::path& folder) {
  if (!std::filesystem::exists(folder)) return {};
  std::vector<std::filesystem::path> files(std::filesystem::directory_iterator{folder}, {});
  std::ranges::sort(files);
  std::vector<std::string> inputs;
  for (const auto& file : files) {
    std::ifstream in(file, std::ios::binary);
    inputs.emplace_back(std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>());
  }
  return inputs;
}

}  // namespace omentum::fuzz
