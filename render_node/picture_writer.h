// Writes pictures while the next frames are drawn.
#pragma once

#include "render_node/renderer.h"
#include "runtime/faults.h"

#include <condition_variable>
#include <deque>
#include <filesystem>
#include <functional>
#include <mutex>
#include <thread>

namespace omentum::render {

/// A thread of its own that writes PNG files into one folder. A failure becomes a fault. When the disk is too
/// slow, the oldest waiting pictures are dropped, which is a fault too. Destruction writes what is left.
class PictureWriter {
 public:
  /// Makes the folder. Throws std::runtime_error when that is impossible.
  PictureWriter(std::filesystem::path folder, runtime::FaultList& faults);
  ~PictureWriter();
  PictureWriter(const PictureWriter&) = delete;
  PictureWriter& operator=(const PictureWriter&) = delete;

  /// `name`: of a file in the folder. Does not wait. Any thread.
  void write(Picture picture, const std::string& name);
  /// The same, of a picture that may be missed: false, and nothing more, where as many wait as may.
  [[nodiscard]] bool offer(Picture picture, const std::string& name);
  /// No picture comes any more: when all that wait are written its thread does `last`, which must not throw.
  /// Does not wait.
  void end(std::function<void()> last);
  /// Writes what waits; after the last write(). Why the first picture that failed did; empty when all are
  /// there.
  std::string finish();

 private:
  struct Job {
    Picture picture;
    std::string name;
  };
  void work();
  void write_now(const Job& job);

  static constexpr std::size_t kWaiting = 4;  // pictures; 9 MB for 960x600

  std::filesystem::path folder_;
  runtime::FaultList& faults_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Job> jobs_;
  bool end_ = false;
  std::function<void()> last_;
  std::string failure_;  // the thread's, until it is joined
  std::thread thread_;   // last: it uses all of the above
};

}  // namespace omentum::render
