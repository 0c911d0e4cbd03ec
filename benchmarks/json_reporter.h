// Google Benchmark's table on the terminal, and the same figures for programs.
#pragma once

#include "benchmarks/bench_json.h"

#include <benchmark/benchmark.h>

namespace omentum::bench {

/// Prints as Google Benchmark does, and adds to `results`: NAME/ARGUMENTS, the time of one iteration in the
/// benchmark's own unit; and NAME/ARGUMENTS/COUNTER for each counter, whose unit is what its name ends in
/// (_ns, _us, _MB, GB_s; else "1"). A run that was skipped adds nothing.
class JsonReporter final : public benchmark::ConsoleReporter {
 public:
  explicit JsonReporter(Results& results);
  void ReportRuns(const std::vector<Run>& runs) override;

 private:
  Results& results_;
};

}  // namespace omentum::bench
