// SIGINT and SIGTERM as a question that a long computation asks now and then.
#pragma once

namespace omentum::organ_tools {

/// From now on SIGINT and SIGTERM only set a flag; a second one ends the program. A handler rather than a
/// thread that waits for blocked signals: OpenBLAS has started threads before main() that do not block them,
/// and the default action in one of those would end the process.
void watch_for_interruption();

/// Whether one of them came. Any thread.
bool interrupted() noexcept;

}  // namespace omentum::organ_tools
