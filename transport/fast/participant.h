// A Fast DDS participant. No vendor header is included here, so that both vendors meet in bus.cpp.
#pragma once

#include "transport/bus.h"

namespace omentum::transport {
class StandstillWatch;
}

namespace omentum::transport::fast {

class Membership;

/// One participant with a publisher and a subscriber; makes the endpoints of every topic.
///
/// When the process stood still for long (stopped, or the machine suspended), the participant is replaced by
/// a new one underneath its endpoints: a Cyclone participant that forgot a Fast one asks for its endpoints
/// anew, and Fast DDS 2.9, which forgot nothing, does not tell them twice. Meanwhile a writer refuses what is
/// not durable, durable samples are said again, and no callback runs.
class Participant {
 public:
  /// Throws std::runtime_error when Fast DDS refuses.
  explicit Participant(const BusOptions& options);
  ~Participant();

  template <class M>
  std::unique_ptr<Writer<M>> writer();
  template <class M>
  std::unique_ptr<Reader<M>> reader(ByWriter<M> callbacks);

  /// Leaves and joins the domain at once, as after a standstill. False when Fast DDS refused. Any thread, but
  /// not from a reader's callback.
  bool renew() noexcept;

 private:
  std::unique_ptr<Membership> membership_;
  std::unique_ptr<StandstillWatch> watch_;  // last: it renews the membership
};

}  // namespace omentum::transport::fast
