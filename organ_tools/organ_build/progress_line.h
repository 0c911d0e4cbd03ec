// A line of progress for anything that takes longer than two seconds.
#pragma once

#include <chrono>
#include <string>

namespace omentum::organ_tools {

/// Writes "PROGRAM: STAGE 34 %" to stderr at most every two seconds, and not before two have passed. One
/// caller at a time.
class ProgressLine {
 public:
  explicit ProgressLine(std::string program);
  void operator()(const std::string& stage, double fraction);

 private:
  std::string program_;
  std::chrono::steady_clock::time_point last_;
};

}  // namespace omentum::organ_tools
