// Shows a session's tools to ROS 2 (docs/devices.md, "Seen from ROS 2").
#include "files/console.h"
#include "node_common/node_identity.h"
#include "ros_bridge/republisher.h"
#include "ros_bridge/ros_domain.h"
#include "runtime/command_line.h"
#include "runtime/rate_loop.h"
#include "runtime/signals.h"

#include <chrono>
#include <cstdlib>
#include <optional>
#include <stdexcept>
#include <string>

namespace {

using namespace omentum;

struct Options {
  transport::BusOptions bus{.name = "ros_bridge"}, ros{.name = "ros_bridge"};
  ros::RepublisherOptions tools;
  std::vector<std::string> names;
  double rate_hz = 200;
};

constexpr std::int64_t kSilence_ns = 3'000'000'000;  // longer than discovery takes

// "1=PSM2" names the topics of tool 1.
void name_tools(const std::vector<std::string>& names, ros::RepublisherOptions& tools) {
  for (std::size_t id = 0; id < tools.names.size(); ++id) tools.names[id] = "tool" + std::to_string(id);
  for (const std::string& text : names) {
    const bool is_pair = text.size() > 2 && text[1] == '=' && text[0] >= '0' && text[0] <= '7';
    if (!is_pair || !ros::is_namespace(text.substr(2)))
      throw std::runtime_error(
          "--name: found " + text +
          ", expected TOOL=NAME with a tool from 0 to 7 and a name of letters, digits and _");
    tools.names[static_cast<std::size_t>(text[0] - '0')] = text.substr(2);
  }
  for (std::size_t i = 0; i < tools.names.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (tools.names[i] == tools.names[j])
        throw std::runtime_error("--name: found " + tools.names[i] + " twice, expected a name for each tool");
}

std::int64_t wall_now_ns() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(
             std::chrono::system_clock::now().time_since_epoch())
      .count();
}

void run(Options& options) {
  name_tools(options.names, options.tools);
  runtime::RateLoop loop(options.rate_hz);
  const runtime::StopSignal stop([&loop] { loop.stop(); });
  const auto bus = transport::Bus::open(options.bus);
  const auto port = ros::RosPort::open(options.ros);
  ros::Republisher republisher(options.tools, *bus, *port, loop);
  const std::int64_t begin_ns = loop.now_ns();
  bool told = false;
  while (loop.wait() != runtime::Pace::Cause::kStopped) {
    republisher.tick(wall_now_ns());
    loop.finish_tick();
    if (told || republisher.has_tools() || loop.now_ns() - begin_ns < kSilence_ns) continue;
    told = true;
    files::say("ros_bridge: no tool in DDS domain " + std::to_string(options.bus.domain) +
               " yet: the launcher says which one a session has (--domain), --profile and --secure are the "
               "session's");
  }
  if (republisher.refused() > 0)
    files::say("ros_bridge: " + std::to_string(republisher.refused()) + " messages could not be sent");
}

int ros_domain() {
  const char* set = std::getenv("ROS_DOMAIN_ID");
  return ros::domain_of(set ? std::optional<std::string>(set) : std::nullopt);
}

}  // namespace

int main(int argc, char** argv) {
  runtime::CommandLine line("ros_bridge",
                            "Shows the tools of a running session to ROS 2, as CRTK names their topics: "
                            "NAME/measured_cp, measured_cs, spatial/servo_cf and operating_state");
  Options options;
  int domain = -1;  // of ROS; below 0: what the environment says
  runtime::LinkOptions link;
  std::string ros_profile = "lan";
  runtime::add_link_options(line, link);
  line.option("--ros-domain", domain, "of ROS (default: ROS_DOMAIN_ID, or 0)").between(0, ros::kLastDomain);
  line.option("--ros-profile", ros_profile, "of ROS: lan, or loopback for ROS nodes on lo alone")
      .one_of({"loopback", "lan"})
      .show_default();
  line.option("--name", options.names, "the topics of a tool begin with this (default: tool0, tool1, ...)")
      .type_name("TOOL=NAME");
  line.option("--frame", options.tools.frame, "frame_id of the scene's frame W").show_default();
  line.option("--rate-hz", options.rate_hz, "messages per second of each topic")
      .between(1.0, 1000.0)
      .show_default();
  line.flag("--obey", options.tools.obeys,
            "take NAME/state_command: pause, resume, and enable, which clears a latched fault");
  return line.run(argc, argv, [&] {
    options.bus = node::bus_options(link, options.bus.name);
    options.ros.vendor = options.bus.vendor;
    options.ros.domain = domain < 0 ? ros_domain() : domain;
    options.ros.profile = transport::parse_profile(ros_profile);
    run(options);
  });
}
