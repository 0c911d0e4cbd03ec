#include "tests/fuzz/input_file.h"

#include <cstdlib>

#include <unistd.h>

namespace omentum::fuzz {

InputFile::InputFile(std::string_view contents) {
  std::string name = std::filesystem::temp_directory_path() / "omentum-fuzz-XXXXXX";
  const int descriptor = mkstemp(name.data());
  if (descriptor < 0) broken("no temporary file can be made");
  path_ = name;
  while (!contents.empty()) {
    const ssize_t written = write(descriptor, contents.data(), contents.size());
    if (written < 0) broken("the input cannot be written");
    contents.remove_prefix(static_cast<std::size_t>(written));
  }
  close(descriptor);
}

InputFile::~InputFile() {
  unlink(path_.c_str());
}

void check_refusal(std::string_view why, const std::filesystem::path& file) {
  if (why.find(file.string()) == std::string_view::npos) broken("a refusal does not name its file");
  if (why.find('\n') != std::string_view::npos) broken("a refusal is of more than one line");
}

}  // namespace omentum::fuzz
