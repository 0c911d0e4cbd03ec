// A local model as the message that carries it.
#pragma once

#include "deform_node/tick_snapshot.h"

namespace omentum::deform {

/// A local model and when it held.
struct StampedPatch {
  std::uint32_t organ = 0;
  std::uint32_t tool = 0;  // that it was made for
  std::uint64_t seq = 0;   // of this organ's for this tool
  std::int64_t stamp_ns = 0;
  Echoes echoes;
  LocalPatch patch;
};

/// The patch is numbered like the tool that it was made for. Takes memory only where `message` had less.
void fill_local_model(const StampedPatch& stamped, msg::LocalModel& message);

}  // namespace omentum::deform
