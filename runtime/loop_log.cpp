#include "runtime/loop_log.h"

namespace omentum::runtime {

LoopLog::LoopLog(const std::filesystem::path& file)
    : samples_(file, kColumns, [](std::ostream& out, std::uint64_t tick, const LoopSample& sample) {
        write_columns(out, tick, sample);
        out << '\n';
      }) {}

void write_columns(std::ostream& out, std::uint64_t tick, const LoopSample& sample) {
  out << tick << ',' << sample.start_ns << ',' << sample.period_ns << ',' << sample.compute_ns << ','
      << sample.cause;
}

}  // namespace omentum::runtime
