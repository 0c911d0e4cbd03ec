#include "runtime/report.h"

#include "files/whole_file.h"

#include <nlohmann/json.hpp>

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
  // texts that came from elsewhere may be of any bytes
  files::write_whole(file, report.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + '\n');
}

}  // namespace omentum::runtime
