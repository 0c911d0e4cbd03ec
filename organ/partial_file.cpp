#include "organ/partial_file.h"

#include "files/whole_file.h"
#include "geometry/tetra_mesh.h"

#include <cerrno>
#include <chrono>
#include <cstring>
#include <thread>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace omentum::organ {

namespace {

// A name that nobody else's files have: what carries it and no lock may be removed.
constexpr const char* kSuffix = ".omentum-partial";

// Who only removes what is abandoned holds its lock for microseconds, who writes for longer than this.
constexpr int kAttempts = 10;
constexpr std::chrono::milliseconds kPause{10};

[[noreturn]] void fail(const std::filesystem::path& file, const std::string& what, int error) {
  throw geometry::InputError(file.string() + ": " + what + ": " + std::strerror(error));
}

// A lock of the open file description: HDF5's own lock and its closing of other descriptors do not touch it.
bool lock(int descriptor) {
  struct flock whole {};
  whole.l_type = F_WRLCK;
  whole.l_whence = SEEK_SET;
  return fcntl(descriptor, F_OFD_SETLK, &whole) == 0;
}

// Whether the file still has its name: its writer may have moved it away between our open and our lock.
bool is_at(int descriptor, const std::filesystem::path& file) {
  struct stat mine {
  }, there{};
  return fstat(descriptor, &mine) == 0 && stat(file.c_str(), &there) == 0 && mine.st_ino == there.st_ino &&
         mine.st_dev == there.st_dev;
}

int open_locked(const std::filesystem::path& partial) {
  for (int attempt = 1;; ++attempt) {
    const int descriptor = open(partial.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0666);
    if (descriptor < 0) fail(partial, "cannot be written", errno);
    if (!lock(descriptor)) {
      const int error = errno;
      close(descriptor);
      if (attempt == kAttempts) fail(partial, "is being written by another process", error);
      std::this_thread::sleep_for(kPause);
      continue;
    }
    if (is_at(descriptor, partial)) return descriptor;
    close(descriptor);
  }
}

std::filesystem::path folder_of(const std::filesystem::path& file) {
  return file.has_parent_path() ? file.parent_path() : ".";
}

// The end of the links that `file` is; refuses folders, devices, pipes and sockets.
std::filesystem::path target_of(const std::filesystem::path& file) {
  try {
    return files::replaceable(file);
  } catch (const std::runtime_error& refused) {
    throw geometry::InputError(refused.what());
  }
}

bool remove_if_abandoned(const std::filesystem::path& partial) {
  const int descriptor = open(partial.c_str(), O_RDWR | O_CLOEXEC | O_NOFOLLOW);
  if (descriptor < 0) return false;
  const bool removed = lock(descriptor) && is_at(descriptor, partial) && unlink(partial.c_str()) == 0;
  close(descriptor);
  return removed;
}

}  // namespace

PartialFile::PartialFile(const std::filesystem::path& file)
    : file_(target_of(file)), partial_(file_.string() + kSuffix) {
  remove_abandoned(folder_of(file_));
  lock_ = open_locked(partial_);
  if (ftruncate(lock_, 0) != 0) {
    const int error = errno;
    unlink(partial_.c_str());
    close(lock_);
    fail(partial_, "cannot be written", error);
  }
}

PartialFile::~PartialFile() {
  if (lock_ < 0) return;
  unlink(partial_.c_str());
  close(lock_);
}

void PartialFile::sync() const {
  if (fsync(lock_) != 0) fail(partial_, "cannot be written", errno);
}

void PartialFile::move_to_its_place() {
  if (rename(partial_.c_str(), file_.c_str()) != 0) fail(file_, "cannot be replaced", errno);
  close(lock_);
  lock_ = -1;
  // the new name itself to the disk; a folder that cannot be opened for this has it there soon enough
  const int descriptor = open(folder_of(file_).c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor >= 0) {
    fsync(descriptor);
    close(descriptor);
  }
}

int remove_abandoned(const std::filesystem::path& folder) noexcept {
  int removed = 0;
  try {
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
      if (entry.path().native().ends_with(kSuffix)) removed += remove_if_abandoned(entry.path());
    }
  } catch (const std::exception&) {
    return removed;  // a folder that cannot be listed keeps what it has
  }
  return removed;
}

}  // namespace omentum::organ
