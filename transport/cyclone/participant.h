// A Cyclone DDS participant. No vendor header is included here, so that both vendors meet in bus.cpp.
#pragma once

#include "transport/bus.h"

namespace omentum::transport::cyclone {

struct Entities;

/// One participant; makes the endpoints of every topic.
class Participant {
 public:
  /// Throws std::runtime_error when Cyclone DDS refuses.
  explicit Participant(const BusOptions& options);
  ~Participant();

  template <class M>
  std::unique_ptr<Writer<M>> writer();
  template <class M>
  std::unique_ptr<Reader<M>> reader(ByWriter<M> callbacks);

 private:
  std::unique_ptr<Entities> entities_;
};

}  // namespace omentum::transport::cyclone
