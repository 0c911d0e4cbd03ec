#include "scripted_pace.h"

#include <cmath>
#include <utility>

namespace omentum::test {

class ScriptedPace::Chore final : public runtime::SideWork {
 public:
  Chore(ScriptedPace& pace, std::chrono::nanoseconds pause, std::function<void()> work)
      : pace_(pace), pause_ns_(pause.count()), due_ns_(pace.now_ns() + pause_ns_), work_(std::move(work)) {
    pace_.chores_.push_back(this);
  }
  ~Chore() override { std::erase(pace_.chores_, this); }

  void do_if_due() {
    if (pace_.now_ns() < due_ns_) return;
    work_();
    due_ns_ = pace_.now_ns() + pause_ns_;
  }

 private:
  ScriptedPace& pace_;
  std::int64_t pause_ns_, due_ns_;
  std::function<void()> work_;
};

ScriptedPace::ScriptedPace(double rate_hz) : period_ns_(std::llround(1e9 / rate_hz)), account_(period_ns_) {}

ScriptedPace::~ScriptedPace() {
  try {
    finish();
  } catch (...) {  // the test has failed for another reason
  }
}

void ScriptedPace::run(std::function<void()> loop) {
  ended_ = false;
  thread_ = std::thread([this, loop = std::move(loop)] {
    try {
      loop();
    } catch (...) {
      failure_ = std::current_exception();
    }
    ended_ = true;
    came_.release();
  });
  came_.acquire();
}

bool ScriptedPace::tick(int count) {
  for (int i = 0; i < count && !ended_; ++i) {
    now_ns_ += period_ns_;
    for (Chore* chore : std::vector(chores_)) chore->do_if_due();
    cause_ = wakes_.exchange(false) ? Cause::kWoken : Cause::kSchedule;
    if (cause_ == Cause::kWoken) ++woken_;
    hand_over();
  }
  return !ended_;
}

bool ScriptedPace::pass(double seconds) {
  return tick(static_cast<int>(std::llround(1e9 * seconds / static_cast<double>(period_ns_))));
}

void ScriptedPace::finish() {
  stopped_ = true;
  if (!ended_) hand_over();
  if (thread_.joinable()) thread_.join();
  if (failure_) std::rethrow_exception(std::exchange(failure_, nullptr));
}

void ScriptedPace::hand_over() {
  go_.release();
  came_.acquire();
}

ScriptedPace::Cause ScriptedPace::wait() noexcept {
  if (stopped_) return Cause::kStopped;
  came_.release();
  go_.acquire();
  if (stopped_) return Cause::kStopped;
  account_.start(now_ns_);
  return cause_;
}

void ScriptedPace::finish_tick() noexcept {
  account_.finish(now_ns_);
  if (log_ != nullptr) {
    log_->push({account_.last_start_ns(), account_.last_period_ns(), account_.last_compute_ns(),
                static_cast<std::int32_t>(cause_)});
  }
}

namespace {

/// Does it in turn, in the call that wakes it.
class AtOnce final : public runtime::WokenWork {
 public:
  explicit AtOnce(std::function<void()> work) : work_(std::move(work)) {}
  ~AtOnce() override { work_(); }
  void wake() noexcept override { work_(); }

 private:
  std::function<void()> work_;
};

}  // namespace

std::unique_ptr<runtime::WokenWork> ScriptedPace::on_wake(std::function<void()> work) {
  return std::make_unique<AtOnce>(std::move(work));
}

std::unique_ptr<runtime::SideWork> ScriptedPace::beside(std::chrono::milliseconds pause,
                                                        std::function<void()> work) {
  return std::make_unique<Chore>(*this, pause, std::move(work));
}

}  // namespace omentum::test
