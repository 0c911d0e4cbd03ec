// Samples of a real-time loop as lines of a file.
#pragma once

#include "files/whole_file.h"
#include "runtime/background.h"

#include <atomic>
#include <cerrno>
#include <chrono>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace omentum::runtime {

/// A ring between a loop, which never waits, and a thread that writes a line for each sample four times a
/// second. Samples that find the ring full (a disk that stood still for more than half a minute) are dropped
/// and counted in a last line "# dropped N". T is copied by assignment and must not allocate in it.
template <class T>
class SampleLog {
 public:
  using WriteLine = std::function<void(std::ostream&, std::uint64_t index, const T&)>;

  /// `capacity`: samples that wait. Throws std::runtime_error when `file` cannot be written, or is something
  /// else than a file.
  SampleLog(const std::filesystem::path& file, const std::string& header, WriteLine write_line,
            std::uint64_t capacity = kCapacity)
      : file_(file), out_(files::replaceable(file)), write_line_(std::move(write_line)), ring_(capacity) {
    if (!out_) throw std::runtime_error(file.string() + ": cannot be written: " + std::strerror(errno));
    out_ << header << '\n';
    background_ = std::make_unique<Background>(kDrainPause, [this] { drain(); });
  }
  /// Writes what is left.
  ~SampleLog() { end(); }
  /// Writes what is left and closes the file; after the last push(). Throws std::runtime_error with the
  /// system's reason when lines were lost.
  void finish() {
    end();
    if (error_ != 0)
      throw std::runtime_error(file_.string() + ": not all lines could be written: " + std::strerror(error_));
  }
  SampleLog(const SampleLog&) = delete;
  SampleLog& operator=(const SampleLog&) = delete;

  /// One thread at a time. Neither waits nor allocates.
  void push(const T& sample) noexcept {
    const std::uint64_t index = written_.load(std::memory_order_relaxed);
    if (index - drained_.load(std::memory_order_acquire) >= ring_.size()) {
      dropped_.fetch_add(1, std::memory_order_relaxed);
      return;
    }
    ring_[index % ring_.size()] = sample;
    written_.store(index + 1, std::memory_order_release);
  }

 private:
  static constexpr std::uint64_t kCapacity = 1 << 16;           // 65 s at 1 kHz, half of that for two tools
  static constexpr std::chrono::milliseconds kDrainPause{250};  // seldom enough to cost nothing

  void drain() {
    const std::uint64_t end = written_.load(std::memory_order_acquire);
    std::uint64_t index = drained_.load(std::memory_order_relaxed);
    for (; index != end; ++index) write_line_(out_, index, ring_[index % ring_.size()]);
    drained_.store(index, std::memory_order_release);
    note(out_.flush().good());
  }

  void end() {
    if (!background_) return;
    background_.reset();
    drain();
    if (const auto dropped = dropped_.load()) out_ << "# dropped " << dropped << '\n';
    out_.close();
    note(out_.good());
  }

  // The first reason; a disk that is full stays so for what comes after.
  void note(bool good) {
    if (!good && error_ == 0) error_ = errno != 0 ? errno : EIO;
  }

  std::filesystem::path file_;
  std::ofstream out_;
  int error_ = 0;  // the writing thread's, then end()'s
  WriteLine write_line_;
  std::vector<T> ring_;
  std::atomic<std::uint64_t> written_{0};
  std::atomic<std::uint64_t> drained_{0};
  std::atomic<std::uint64_t> dropped_{0};
  std::unique_ptr<Background> background_;
};

}  // namespace omentum::runtime
