#include "runtime/report.h"

#include <nlohmann/json.hpp>

#include <fstream>
#include <stdexcept>
#include <system_error>

#include <unistd.h>

namespace omentum::runtime {

nlohmann::json to_json(const Percentiles& percentiles) {
  return {{"p50", percentiles.p50},
          {"p99", percentiles.p99},
          {"p999", percentiles.p999},
          {"max", percentiles.max},
          {"count", percentiles.count}};
}

nlohmann::json to_json(const LoopRecord& record, double rate_hz) {
  return {{"rate_hz", rate_hz},
          {"ticks", record.ticks},
          {"missed", record.missed},
          {"period_us", to_json(record.period.percentiles())},
          {"compute_us", to_json(record.compute.percentiles())}};
}

void write_report(const nlohmann::json& report, const std::filesystem::path& file) {
  // the process id keeps two writers of one report from sharing a draft
  std::filesystem::path draft = file;
  draft += ".part" + std::to_string(getpid());
  std::error_code error;
  {
    std::ofstream out(draft);
    out << report.dump(2) << '\n';
    out.close();
    if (!out) {
      std::filesystem::remove(draft, error);
      throw std::runtime_error(file.string() + ": the report cannot be written there");
    }
  }
  std::filesystem::rename(draft, file, error);
  if (error) {
    const std::string reason = error.message();
    std::filesystem::remove(draft, error);
    throw std::runtime_error(file.string() + ": the report cannot be written there (" + reason + ")");
  }
}

}  // namespace omentum::runtime
