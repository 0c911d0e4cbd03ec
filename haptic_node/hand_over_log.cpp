#include "haptic_node/hand_over_log.h"

#include "scene/scene_values.h"

#include <nlohmann/json.hpp>

namespace omentum::haptic {
namespace {

// anybody may have written it
std::string quoted(const node::DeviceName& name) {
  if (name[0] == 0) return "a device without a name";
  return std::string("'").append(scene::printable(name.data())).append("'");
}

}  // namespace

std::string HandOverLog::line(std::uint32_t tool, std::int64_t now_ns) {
  if (newest_.count == told_ || (told_ > 0 && now_ns - told_ns_ < kLineEvery_ns)) return {};
  std::string line = "haptic_node: tool " + std::to_string(tool) + " goes from " + quoted(newest_.from) +
                     " to " + quoted(newest_.to);
  if (newest_.count > told_ + 1) line += " (" + std::to_string(newest_.count) + " hand-overs by now)";
  told_ = newest_.count;
  told_ns_ = now_ns;
  return line;
}

nlohmann::json HandOverLog::report() const {
  nlohmann::json report{{"count", newest_.count}};
  if (newest_.count == 0) return report;
  report["from"] = scene::printable(newest_.from.data());
  report["to"] = scene::printable(newest_.to.data());
  return report;
}

}  // namespace omentum::haptic
