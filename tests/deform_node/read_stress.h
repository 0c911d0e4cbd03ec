// What StressPublisher writes, kept, with its thread's work done at once.
#pragma once

#include "deform_node/stress_publisher.h"

namespace omentum::deform {

/// Keeps what is written to so many readers.
class ReadMessages final : public transport::Writer<msg::OrganStress> {
 public:
  bool write(const msg::OrganStress& sample) noexcept override {
    all_.push_back(sample);
    return true;
  }
  transport::EndpointStatus status() const override { return {.matched = readers}; }
  const std::vector<msg::OrganStress>& all() const { return all_; }
  int readers = 0;

 private:
  std::vector<msg::OrganStress> all_;
};

/// On this thread, within wake().
inline std::unique_ptr<runtime::WokenWork> work_at_once(std::function<void()> work) {
  struct AtOnce final : runtime::WokenWork {
    explicit AtOnce(std::function<void()> to_do) : work(std::move(to_do)) {}
    void wake() noexcept override { work(); }
    std::function<void()> work;
  };
  return std::make_unique<AtOnce>(std::move(work));
}

}  // namespace omentum::deform
