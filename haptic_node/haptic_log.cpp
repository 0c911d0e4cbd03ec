#include "haptic_node/haptic_log.h"

#include <ostream>
#include <string>

namespace omentum::haptic {
namespace {

constexpr int kDigits = 9;  // a nanometre of a metre

constexpr const char* kToolColumns[] = {"seq",   "stamp_ns", "x_m",   "y_m",  "z_m",  "qw",
                                        "qx",    "qy",       "qz",    "fx_n", "fy_n", "fz_n",
                                        "tx_nm", "ty_nm",    "tz_nm", "state"};

std::string header_of(const std::vector<std::uint32_t>& tools) {
  std::string header = runtime::LoopLog::kColumns;
  for (const std::uint32_t id : tools) {
    for (const char* column : kToolColumns) header += ",tool" + std::to_string(id) + "_" + column;
  }
  return header;
}

void write(std::ostream& out, const msg::Vec3& v) {
  out << ',' << v.x << ',' << v.y << ',' << v.z;
}

void write(std::ostream& out, const ToolSample& tool) {
  const msg::Quat& q = tool.orientation;
  out << ',' << tool.seq << ',' << tool.stamp_ns;
  write(out, tool.position);
  out << ',' << q.w << ',' << q.x << ',' << q.y << ',' << q.z;
  write(out, tool.force);
  write(out, tool.torque);
  out << ',' << tool.state;
}

}  // namespace

HapticLog::HapticLog(const std::filesystem::path& file, const std::vector<std::uint32_t>& tools)
    : samples_(
          file, header_of(tools),
          [count = tools.size()](std::ostream& out, std::uint64_t tick, const Sample& sample) {
            out.precision(kDigits);
            runtime::write_columns(out, tick, sample.tick);
            for (std::size_t i = 0; i < count; ++i) write(out, sample.tools[i]);
            out << '\n';
          },
          kWaiting) {}

}  // namespace omentum::haptic
