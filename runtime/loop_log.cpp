#include "runtime/loop_log.h"

namespace omentum::runtime {

LoopLog::LoopLog(const std::filesystem::path& file)
    : SampleLog(file, "tick,start_ns,period_ns,compute_ns,cause",
                [](std::ostream& out, std::uint64_t tick, const LoopSample& s) {
                  out << tick << ',' << s.start_ns << ',' << s.period_ns << ',' << s.compute_ns << ','
                      << s.cause << '\n';
                }) {}

}  // namespace omentum::runtime
