#include "render_node/picture_writer.h"

#include "render_node/png_file.h"

#include <stdexcept>
#include <system_error>

namespace omentum::render {

PictureWriter::PictureWriter(std::filesystem::path folder, runtime::FaultList& faults)
    : folder_(std::move(folder)), faults_(faults) {
  std::error_code error;
  std::filesystem::create_directories(folder_, error);
  if (error || !std::filesystem::is_directory(folder_)) {
    throw std::runtime_error("--out " + folder_.string() + ": cannot make this folder" +
                             (error ? ": " + error.message() : ""));
  }
  thread_ = std::thread([this] { work(); });
}

PictureWriter::~PictureWriter() {
  finish();
}

std::string PictureWriter::finish() {
  {
    const std::lock_guard lock(mutex_);
    end_ = true;
  }
  changed_.notify_one();
  if (thread_.joinable()) thread_.join();
  return failure_;
}

void PictureWriter::write(Picture picture, const std::string& name) {
  {
    const std::lock_guard lock(mutex_);
    if (jobs_.size() == kWaiting) {
      jobs_.pop_front();
      faults_.raise("pictures: the disk is too slow, some were dropped");
    }
    jobs_.push_back({std::move(picture), name});
  }
  changed_.notify_one();
}

bool PictureWriter::offer(Picture picture, const std::string& name) {
  {
    const std::lock_guard lock(mutex_);
    if (jobs_.size() == kWaiting) return false;
    jobs_.push_back({std::move(picture), name});
  }
  changed_.notify_one();
  return true;
}

void PictureWriter::end(std::function<void()> last) {
  {
    const std::lock_guard lock(mutex_);
    end_ = true;
    last_ = std::move(last);
  }
  changed_.notify_one();
}

void PictureWriter::work() {
  std::unique_lock lock(mutex_);
  while (true) {
    changed_.wait(lock, [this] { return end_ || !jobs_.empty(); });
    if (jobs_.empty()) break;
    const Job job = std::move(jobs_.front());
    jobs_.pop_front();
    lock.unlock();
    write_now(job);
    lock.lock();
  }
  lock.unlock();
  if (last_) last_();
}

void PictureWriter::write_now(const Job& job) {
  try {
    write_png(job.picture, folder_ / job.name);
  } catch (const std::exception& error) {
    faults_.raise(error.what());
    if (failure_.empty()) failure_ = error.what();
  }
}

}  // namespace omentum::render
