#include "tests/fuzz/input_file.h"

#include <sys/mman.h>
#include <unistd.h>

namespace omentum::fuzz {

InputFile::InputFile(std::string_view contents) : descriptor_(memfd_create("input", MFD_CLOEXEC)) {
  if (descriptor_ < 0) broken("no file in memory can be made");
  while (!contents.empty()) {
    const ssize_t written = write(descriptor_, contents.data(), contents.size());
    if (written < 0) broken("the input cannot be written");
    contents.remove_prefix(static_cast<std::size_t>(written));
  }
}

InputFile::~InputFile() {
  close(descriptor_);
}

void check_refusal(std::string_view why, const std::filesystem::path& file) {
  if (why.find(file.string()) == std::string_view::npos) broken("a refusal does not name its file");
  if (why.find('\n') != std::string_view::npos) broken("a refusal is of more than one line");
}

}  // namespace omentum::fuzz
