// Writes strain and stress of the organs while somebody reads them, on a thread of its own.
#pragma once

#include "deform_node/served_organ.h"
#include "deform_node/state_mark.h"
#include "deform_node/strain_gauge.h"
#include "runtime/mailbox.h"
#include "runtime/woken_thread.h"
#include "transport/bus.h"

#include <atomic>
#include <memory>
#include <vector>

namespace omentum::deform {

/// Publishes an OrganStress of the newest offered state of each organ whose model has a gauge. What nobody
/// reads costs the loop nothing, and is asked for anew ten times a second; the first reader waits as long.
/// Measuring, which takes longer than copying a body, delays neither a step nor a state: what comes meanwhile
/// is passed over but for the newest.
class StressPublisher {
 public:
  /// Writer and organs outlive this. `rate_hz`: of the ticks. `start`: how the publishing thread is made.
  StressPublisher(transport::Writer<msg::OrganStress>& writer, const std::vector<ServedOrgan>& organs,
                  std::int32_t nodes_per_block, double rate_hz, const runtime::StartWork& start);

  /// The loop's thread, in every tick, after the steps. Neither waits nor allocates.
  void offer(const StateMark& state) noexcept;
  /// How many states were measured. The loop's thread, or after it.
  std::uint64_t measured() const noexcept { return measured_.load(std::memory_order_relaxed); }

 private:
  struct Offered {
    StateMark state;
    StrainedShape shape;
  };
  struct Organ {
    Organ(std::uint32_t organ, std::unique_ptr<StrainGauge> of_organ, const ModelSizes& sizes);

    std::uint32_t index;
    std::unique_ptr<StrainGauge> gauge;
    runtime::Mailbox<Offered> newest;
    // the publishing thread's
    std::vector<float> strain, stress_pa;
    std::vector<msg::OrganStress> blocks;
  };
  void write_newest();
  void measure(Organ& organ);
  void write(const Offered& offered, std::span<const float> strain, std::span<const float> stress_pa,
             Organ& organ);

  transport::Writer<msg::OrganStress>& writer_;
  const std::vector<ServedOrgan>& served_;
  std::int32_t nodes_per_block_;
  std::vector<std::unique_ptr<Organ>> organs_;
  std::uint64_t ticks_ = 0, ticks_per_question_;
  std::atomic<bool> is_read_ = false;
  std::atomic<std::uint64_t> measured_ = 0;
  std::unique_ptr<runtime::WokenWork> writing_;  // last: it uses what is above
};

}  // namespace omentum::deform
