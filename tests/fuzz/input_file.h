// An input as a file, for what reads files by name.
#pragma once

#include "tests/fuzz/harness.h"

#include <filesystem>

namespace omentum::fuzz {

/// A temporary file, there while this lives. It has a name: HDF5 opens none that was unlinked or never had
/// one.
class InputFile {
 public:
  explicit InputFile(std::string_view contents);
  ~InputFile();
  InputFile(const InputFile&) = delete;
  InputFile& operator=(const InputFile&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// A refusal names the file and is one line.
void check_refusal(std::string_view why, const std::filesystem::path& file);

}  // namespace omentum::fuzz
