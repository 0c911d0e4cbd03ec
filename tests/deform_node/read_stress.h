// What publishers write for who reads, kept, with their threads' work done at once.
#pragma once

#include "deform_node/stress_publisher.h"

namespace omentum::deform {

/// Keeps what is written to so many readers.
template <class M>
class ReadSamples final : public transport::Writer<M> {
 public:
  bool write(const M& sample) noexcept override {
    all_.push_back(sample);
    return true;
  }
  transport::EndpointStatus status() const override { return {.matched = readers}; }
  const std::vector<M>& all() const { return all_; }
  int readers = 0;

 private:
  std::vector<M> all_;
};
using ReadMessages = ReadSamples<msg::OrganStress>;

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
