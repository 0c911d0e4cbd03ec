#include "files/whole_file.h"

#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <string>
#include <system_error>

#include <fcntl.h>
#include <unistd.h>

namespace omentum::files {
namespace {

constexpr int kMostLinks = 40;  // the system's own bound

[[noreturn]] void refuse(const std::filesystem::path& file, const std::string& reason) {
  throw std::runtime_error(file.string() + ": cannot be written: " + reason);
}

const char* kind_of(std::filesystem::file_type type) {
  switch (type) {
    case std::filesystem::file_type::directory:
      return "a folder";
    case std::filesystem::file_type::character:
    case std::filesystem::file_type::block:
      return "a device";
    case std::filesystem::file_type::fifo:
      return "a pipe";
    case std::filesystem::file_type::socket:
      return "a socket";
    default:
      return "no file";
  }
}

// All of it, or the reason why not; a full disk may speak up only when the file is closed.
int write_all(const std::filesystem::path& file, std::string_view text) {
  const int descriptor = open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (descriptor < 0) return errno;
  int error = 0;
  while (!text.empty() && error == 0) {
    const ssize_t written = write(descriptor, text.data(), text.size());
    if (written >= 0) {
      text.remove_prefix(static_cast<std::size_t>(written));
    } else if (errno != EINTR) {
      error = errno;
    }
  }
  if (close(descriptor) != 0 && error == 0) error = errno;
  return error;
}

}  // namespace

std::filesystem::path replaceable(const std::filesystem::path& file) {
  std::filesystem::path target = file;
  std::error_code error;
  for (int links = 0; std::filesystem::is_symlink(target, error); ++links) {
    if (links == kMostLinks) refuse(file, "its links lead nowhere");
    const std::filesystem::path next = std::filesystem::read_symlink(target, error);
    if (error) refuse(file, error.message());
    target = target.parent_path() / next;
  }
  const auto type = std::filesystem::status(target, error).type();
  if (type == std::filesystem::file_type::not_found || type == std::filesystem::file_type::regular)
    return target;
  if (type == std::filesystem::file_type::none) refuse(file, error.message());
  refuse(file, std::string("it is ") + kind_of(type) + ", expected a file or a new name");
}

void require_writable(const std::filesystem::path& file) {
  const WholeFile whole(file);
  const int descriptor = open(whole.draft().c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0666);
  if (descriptor < 0) refuse(file, std::strerror(errno));
  close(descriptor);
}

WholeFile::WholeFile(const std::filesystem::path& file)
    : file_(file), target_(replaceable(file)), draft_(target_) {
  // the process id keeps two writers of one file from sharing a draft
  draft_ += ".part" + std::to_string(getpid());
}

WholeFile::~WholeFile() {
  std::error_code ignored;
  if (!moved_) std::filesystem::remove(draft_, ignored);
}

void WholeFile::move_to_its_place() {
  std::error_code error;
  std::filesystem::rename(draft_, target_, error);
  if (error) refuse(file_, error.message());
  moved_ = true;
}

void write_whole(const std::filesystem::path& file, std::string_view text) {
  WholeFile whole(file);
  if (const int error = write_all(whole.draft(), text); error != 0) refuse(file, std::strerror(error));
  whole.move_to_its_place();
}

}  // namespace omentum::files
