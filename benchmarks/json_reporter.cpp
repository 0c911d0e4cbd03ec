#include "benchmarks/json_reporter.h"

#include <array>
#include <string_view>

#include <unistd.h>

namespace omentum::bench {
namespace {

std::string unit_of(std::string_view counter) {
  constexpr std::array<std::string_view, 3> kEnds{"_ns", "_us", "_MB"};
  for (const std::string_view end : kEnds)
    if (counter.ends_with(end)) return std::string(end.substr(1));
  return counter == "GB_s" ? "GB/s" : "1";
}

}  // namespace

JsonReporter::JsonReporter(Results& results)
    : ConsoleReporter(isatty(STDOUT_FILENO) ? OO_Color : OO_None), results_(results) {}

void JsonReporter::ReportRuns(const std::vector<Run>& runs) {
  ConsoleReporter::ReportRuns(runs);
  for (const Run& run : runs) {
    if (run.error_occurred) continue;
    std::string name = run.run_name.function_name;
    if (!run.run_name.args.empty()) name += "/" + run.run_name.args;
    results_.add({.name = name,
                  .value = run.GetAdjustedRealTime(),
                  .unit = benchmark::GetTimeUnitString(run.time_unit)});
    for (const auto& [counter, value] : run.counters)
      results_.add(
          {.name = std::string(name).append("/").append(counter), .value = value, .unit = unit_of(counter)});
  }
}

}  // namespace omentum::bench
