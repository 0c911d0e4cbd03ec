// The numbers of a run, as report.json holds them (docs/design.md, "Report").
#pragma once

#include "runtime/tick_account.h"

#include <nlohmann/json_fwd.hpp>

#include <filesystem>

namespace omentum::runtime {

/// {"p50":..., "p99":..., "p999":..., "max":..., "count":...}, microseconds.
nlohmann::json to_json(const Percentiles& percentiles);
/// {"rate_hz", "ticks", "missed", "period_us", "compute_us"}.
nlohmann::json to_json(const LoopRecord& record, double rate_hz);
/// Whole or not at all (write_whole). Throws std::runtime_error.
void write_report(const nlohmann::json& report, const std::filesystem::path& file);

}  // namespace omentum::runtime
