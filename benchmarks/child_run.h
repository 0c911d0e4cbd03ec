// One child process, and what it alone took.
#pragma once

#include <string>
#include <vector>

namespace omentum::bench {

struct ChildRun {
  int exit = 0;  // code, or minus the signal that ended it
  double seconds = 0;
  double peak_bytes = 0;  // largest resident memory
};

/// Runs `program` (a path) to its end; what it prints on stdout is dropped. Its memory is measured by wait4,
/// so that no other child of this process, or of whoever was this process before, counts. But the system
/// counts what this process itself holds when it starts the child: measure while it is small. Throws
/// std::runtime_error when no process can be started.
ChildRun run_child(const std::string& program, const std::vector<std::string>& arguments);

}  // namespace omentum::bench
