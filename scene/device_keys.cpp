#include "scene/device_keys.h"

#include "messages/common.h"

namespace omentum::scene {

void read_device(TomlSection& s, ToolSpec& tool) {
  s.read("device", tool.device, TomlSection::Need::kOptional);
  if (s.has("device") && tool.device.empty())
    s.refuse("device", "no name", "that which the device gives itself, or no key");
  if (tool.device.size() > msg::MAX_NAME)
    s.refuse("device", std::to_string(tool.device.size()) + " characters",
             "at most " + std::to_string(msg::MAX_NAME) + ", as DeviceInfo.name");
}

}  // namespace omentum::scene
