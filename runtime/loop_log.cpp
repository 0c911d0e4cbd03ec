#include "runtime/loop_log.h"

#include <chrono>
#include <condition_variable>
#include <fstream>
#include <mutex>
#include <stdexcept>
#include <thread>

namespace omentum::runtime {
namespace {

constexpr std::chrono::milliseconds kDrainPeriod{250};  // one burst of lines, seldom enough to cost nothing

}  // namespace

// The writing thread and its file.
struct LoopLog::Drain {
  explicit Drain(LoopLog& log_, const std::filesystem::path& file) : log(log_), out(file) {
    if (!out) throw std::runtime_error(file.string() + ": cannot be written (--log)");
    out << "tick,start_ns,period_ns,compute_ns,cause\n";
    thread = std::thread([this] { run(); });
  }

  ~Drain() {
    {
      const std::lock_guard lock(mutex);
      ending = true;
    }
    changed.notify_one();
    thread.join();
    drain();
    if (const auto dropped = log.dropped_.load()) out << "# dropped " << dropped << '\n';
  }

  void run() {
    for (std::unique_lock lock(mutex); !ending;) {
      changed.wait_for(lock, kDrainPeriod, [this] { return ending; });
      drain();
    }
  }

  void drain() {
    const std::uint64_t end = log.written_.load(std::memory_order_acquire);
    std::uint64_t tick = log.drained_.load(std::memory_order_relaxed);
    for (; tick != end; ++tick) {
      const LoopSample& s = log.ring_[tick % kCapacity];
      out << tick << ',' << s.start_ns << ',' << s.period_ns << ',' << s.compute_ns << ',' << s.cause << '\n';
    }
    log.drained_.store(tick, std::memory_order_release);
    out.flush();
  }

  LoopLog& log;
  std::ofstream out;
  std::mutex mutex;
  std::condition_variable changed;
  bool ending = false;
  std::thread thread;
};

LoopLog::LoopLog(const std::filesystem::path& file)
    : ring_(kCapacity), drain_(std::make_unique<Drain>(*this, file)) {}

LoopLog::~LoopLog() = default;

void LoopLog::push(const LoopSample& sample) noexcept {
  const std::uint64_t tick = written_.load(std::memory_order_relaxed);
  if (tick - drained_.load(std::memory_order_acquire) >= kCapacity) {
    dropped_.fetch_add(1, std::memory_order_relaxed);
    return;
  }
  ring_[tick % kCapacity] = sample;
  written_.store(tick + 1, std::memory_order_release);
}

}  // namespace omentum::runtime
