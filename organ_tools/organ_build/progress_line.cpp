#include "organ_tools/organ_build/progress_line.h"

#include <cstdio>

namespace omentum::organ_tools {

namespace {

constexpr std::chrono::seconds kInterval{2};  // what a person waits without wondering

}  // namespace

ProgressLine::ProgressLine(std::string program)
    : program_(std::move(program)), last_(std::chrono::steady_clock::now()) {}

void ProgressLine::operator()(const std::string& stage, double fraction) {
  const auto now = std::chrono::steady_clock::now();
  if (now - last_ < kInterval) return;
  last_ = now;
  std::fprintf(stderr, "%s: %s %.0f %%\n", program_.c_str(), stage.c_str(), 100 * fraction);
}

}  // namespace omentum::organ_tools
