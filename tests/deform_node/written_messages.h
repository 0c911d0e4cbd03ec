// A writer that keeps what is written, and can be as slow as a full wire.
#pragma once

#include "transport/bus.h"

#include <condition_variable>
#include <mutex>
#include <vector>

namespace omentum::deform_test {

/// The order of all writers' messages, as their topics' names.
class Journal {
 public:
  void add(const std::string& what) {
    const std::lock_guard lock(mutex_);
    lines_.push_back(what);
  }
  std::vector<std::string> lines() const {
    const std::lock_guard lock(mutex_);
    return lines_;
  }

 private:
  mutable std::mutex mutex_;
  std::vector<std::string> lines_;
};

template <class M>
class WrittenMessages final : public transport::Writer<M> {
 public:
  explicit WrittenMessages(std::string name, Journal* journal = nullptr)
      : name_(std::move(name)), journal_(journal) {}

  bool write(const M& sample) noexcept override {
    std::unique_lock lock(mutex_);
    ++begun_;
    changed_.notify_all();
    changed_.wait(lock, [this] { return !stuck_; });
    if (refuses_) return false;
    all_.push_back(sample);
    if (journal_ != nullptr) journal_->add(name_);
    changed_.notify_all();
    return true;
  }
  transport::EndpointStatus status() const override { return {}; }

  /// From now on a write does not come back until the wire is free again.
  void get_stuck() { set(stuck_, true); }
  void come_free() { set(stuck_, false); }
  void refuse(bool refuses) { set(refuses_, refuses); }

  /// Waits until so many writes have begun, or are done.
  void await_begun(std::size_t count) {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return begun_ >= count; });
  }
  std::vector<M> await(std::size_t count) {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return all_.size() >= count; });
    return all_;
  }
  std::vector<M> all() const {
    const std::lock_guard lock(mutex_);
    return all_;
  }

 private:
  void set(bool& what, bool value) {
    const std::lock_guard lock(mutex_);
    what = value;
    changed_.notify_all();
  }
  std::string name_;
  Journal* journal_;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  bool stuck_ = false, refuses_ = false;
  std::size_t begun_ = 0;
  std::vector<M> all_;
};

}  // namespace omentum::deform_test
