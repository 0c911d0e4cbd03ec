// RTPS' names of the writers that a reader of Cyclone's hears.
#pragma once

#include "transport/bus.h"

#include <dds/dds.h>

#include <utility>
#include <vector>

namespace omentum::transport::cyclone {

/// A handle of this process as a writer's name, for as long as nobody knows better.
WriterId handle_id(dds_instance_handle_t publication) noexcept;

/// Cyclone tells samples' writers by handles of this process, one for each endpoint; which participant a
/// writer is of has to be asked for. One thread at a time.
class WriterNames {
 public:
  /// The GUID of a writer that the reader is matched with, asked for once; handle_id() of one that left.
  /// Allocates when it asks.
  WriterId find(dds_entity_t reader, dds_instance_handle_t publication);
  /// What find() said of the writer that left, by its handle_id().
  WriterId forget(const WriterId& handle) noexcept;

 private:
  std::vector<std::pair<WriterId, WriterId>> known_;  // handle, GUID
};

}  // namespace omentum::transport::cyclone
