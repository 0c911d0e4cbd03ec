#include "device_bridge/trace.h"

#include "device_bridge/hand_model.h"
#include "geometry/mesh_io/file_kind.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <limits>
#include <stdexcept>
#include <string>
#include <string_view>
#include <tuple>

namespace omentum::device {
namespace {

constexpr double kUnitTolerance = 1e-3;  // three written digits of a quaternion
constexpr int kTool = 9, kButtons = 10;  // the optional columns
constexpr std::array<std::string_view, 11> kColumns{"t_s", "px", "py",   "pz",   "qw",     "qx",
                                                    "qy",  "qz", "grip", "tool", "buttons"};
constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";  // what spreadsheets put in front of UTF-8
constexpr const char* kHeader = "t_s,px,py,pz,qw,qx,qy,qz,grip";

std::string quoted(std::string_view text) {
  std::string result("'");
  return result.append(text).append("'");
}

std::vector<std::string_view> split(std::string_view line) {
  std::vector<std::string_view> fields;
  for (std::size_t begin = 0; begin <= line.size();) {
    const std::size_t end = std::min(line.find(',', begin), line.size());
    std::string_view field = line.substr(begin, end - begin);
    while (!field.empty() && std::isspace(static_cast<unsigned char>(field.front()))) field.remove_prefix(1);
    while (!field.empty() && std::isspace(static_cast<unsigned char>(field.back()))) field.remove_suffix(1);
    fields.push_back(field);
    begin = end + 1;
  }
  return fields;
}

// One file while it is read.
class TraceReader {
 public:
  explicit TraceReader(const std::filesystem::path& file) : file_(file), in_(file) {
    if (!in_ || std::filesystem::is_directory(file)) {
      throw std::runtime_error(file.string() + ": found no readable file, expected a trace (" + kHeader +
                               ")");
    }
    if (const std::string found = geometry::foreign_kind(file); !found.empty()) {
      throw std::runtime_error(file.string() + ": found " + found + ", expected a trace (" + kHeader + ")");
    }
  }

  std::map<std::uint32_t, Trace> read() {
    std::map<std::uint32_t, Trace> traces;
    if (!next_line()) refuse("nothing", std::string("a header ") + kHeader);
    read_header();
    while (next_line()) read_point(traces);
    if (traces.empty()) refuse("no pose", "at least one line of numbers");
    return traces;
  }

 private:
  [[noreturn]] void refuse(const std::string& found, const std::string& expected) const {
    throw std::runtime_error(file_.string() + ":" + std::to_string(line_number_) + ": found " + found +
                             ", expected " + expected);
  }

  void require_commas(std::string_view first_field) const {
    if (const std::string found = geometry::foreign_separator(first_field); !found.empty())
      refuse("fields separated by " + found, "',' (and '.' in numbers)");
  }

  bool next_line() {
    while (std::getline(in_, line_)) {
      if (++line_number_ == 1 && line_.starts_with(kByteOrderMark)) line_.erase(0, kByteOrderMark.size());
      const auto text = line_.find_first_not_of(" \t\r");
      if (text != std::string::npos && line_[text] != '#') return true;
    }
    return false;
  }

  void read_header() {
    std::array<int, kColumns.size()> seen{};
    const auto names = split(line_);
    require_commas(names[0]);
    for (const std::string_view name : names) {
      const auto column = std::find(kColumns.begin(), kColumns.end(), name);
      if (column == kColumns.end() || seen[column - kColumns.begin()]++ > 0) {
        refuse("column " + quoted(name), std::string(kHeader) + " and perhaps tool and buttons, each once");
      }
      order_.push_back(static_cast<int>(column - kColumns.begin()));
    }
    for (int column = 0; column < kTool; ++column) {
      if (seen[column] == 0)
        refuse("no column " + std::string(kColumns[column]), std::string("the columns ") + kHeader);
    }
  }

  void read_point(std::map<std::uint32_t, Trace>& traces) {
    const auto fields = split(line_);
    if (fields.size() != order_.size()) {
      require_commas(fields[0]);
      refuse(std::to_string(fields.size()) + " fields", std::to_string(order_.size()) + " as in the header");
    }
    std::array<double, kColumns.size()> v{};
    for (std::size_t i = 0; i < fields.size(); ++i) v[order_[i]] = number(fields[i], kColumns[order_[i]]);

    Quat q(v[4], v[5], v[6], v[7]);
    if (std::abs(q.norm() - 1) > kUnitTolerance) {
      refuse("an orientation of length " + std::to_string(q.norm()), "a unit quaternion qw,qx,qy,qz");
    }
    Trace& trace = traces[whole(v[kTool], "tool", msg::MAX_TOOLS - 1)];
    if (!trace.empty() && v[0] <= trace.back().t_s) {
      refuse("t_s " + std::to_string(v[0]) + " after " + std::to_string(trace.back().t_s), "times that grow");
    }
    trace.push_back({v[0],
                     {v[1], v[2], v[3]},
                     q.normalized(),
                     v[8],
                     whole(v[kButtons], "buttons", std::numeric_limits<std::uint32_t>::max())});
  }

  double number(std::string_view field, std::string_view column) const {
    double value = 0;
    const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
    if (error != std::errc() || end != field.data() + field.size() || !std::isfinite(value)) {
      refuse(quoted(field) + " in column " + std::string(column), "a number");
    }
    return value;
  }

  std::uint32_t whole(double value, const std::string& column, std::uint32_t most) const {
    if (value != std::floor(value) || value < 0 || value > most)
      refuse(column + " " + std::to_string(value), "a whole number from 0 to " + std::to_string(most));
    return static_cast<std::uint32_t>(value);
  }

  std::filesystem::path file_;
  std::ifstream in_;
  std::string line_;
  int line_number_ = 0;
  std::vector<int> order_;  // the column of each field
};

Measurement at_rest(const TracePoint& point) {
  return {.valid = true, .position = point.position, .orientation = point.orientation, .grip = point.grip};
}

// Behind the newest valid pose, where invalid ones begin.
constexpr std::int64_t kReleasedAfter_ns = 1'000;

void write_pose(std::ostream& out, const msg::ToolPose& pose, std::int64_t begin_ns) {
  const auto& [p, q] = std::tie(pose.position, pose.orientation);
  std::array<char, 256> line{};
  const double t_s = 1e-9 * static_cast<double>(pose.stamp_ns - begin_ns);
  std::snprintf(line.data(), line.size(), "%.9f,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g,%.6g,%u,%u\n", t_s, p.x,
                p.y, p.z, q.w, q.x, q.y, q.z, pose.grip, pose.tool, pose.buttons);
  out << line.data();
}

}  // namespace

std::map<std::uint32_t, Trace> read_trace(const std::filesystem::path& file) {
  return TraceReader(file).read();
}

Measurement trace_at(const Trace& trace, double t_s) noexcept {
  const auto after = std::upper_bound(trace.begin(), trace.end(), t_s,
                                      [](double t, const TracePoint& point) { return t < point.t_s; });
  if (after == trace.begin()) return at_rest(trace.front());
  if (after == trace.end()) return at_rest(trace.back());
  const TracePoint &a = *(after - 1), &b = *after;
  const double span_s = b.t_s - a.t_s;
  const double share = (t_s - a.t_s) / span_s;
  return {.valid = true,
          .position = a.position + share * (b.position - a.position),
          .orientation = a.orientation.slerp(share, b.orientation),
          .linear_velocity = (b.position - a.position) / span_s,
          .angular_velocity = angular_velocity(a.orientation, b.orientation, span_s),
          .grip = a.grip + share * (b.grip - a.grip),
          .buttons = a.buttons};
}

TraceLog::TraceLog(const std::filesystem::path& file)
    : SampleLog(file, std::string(kHeader) + ",tool,buttons",
                [begin_ns = std::int64_t{-1}, newest = std::array<msg::ToolPose, msg::MAX_TOOLS>{}](
                    std::ostream& out, std::uint64_t, const msg::ToolPose& pose) mutable {
                  msg::ToolPose& known = newest.at(pose.tool);
                  if (pose.valid ? pose.stamp_ns <= known.stamp_ns : known.buttons == 0) return;
                  if (begin_ns < 0) begin_ns = pose.stamp_ns;
                  const std::int64_t released_ns = known.stamp_ns + kReleasedAfter_ns;
                  if (pose.valid) {
                    known = pose;
                  } else {
                    known.buttons = 0;
                    known.stamp_ns = released_ns;
                  }
                  write_pose(out, known, begin_ns);
                }) {}

}  // namespace omentum::device
