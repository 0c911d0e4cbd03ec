// An input as a file, for what reads files by name.
#pragma once

#include "tests/fuzz/harness.h"

#include <filesystem>

namespace omentum::fuzz {

/// A file in memory, there while this lives.
class InputFile {
 public:
  explicit InputFile(std::string_view contents);
  ~InputFile();
  InputFile(const InputFile&) = delete;
  InputFile& operator=(const InputFile&) = delete;

  std::filesystem::path path() const { return "/proc/self/fd/" + std::to_string(descriptor_); }

 private:
  int descriptor_;
};

/// A refusal names the file and is one line.
void check_refusal(std::string_view why, const std::filesystem::path& file);

}  // namespace omentum::fuzz
