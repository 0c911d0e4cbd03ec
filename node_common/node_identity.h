// What every node does the same way: it reads its scene, joins a domain, names itself and tells how it is.
#pragma once

#include "runtime/faults.h"
#include "runtime/node_options.h"
#include "runtime/tick_account.h"
#include "scene/scene.h"
#include "transport/bus.h"

namespace omentum::node {

/// The scene of --scene, its first organ's file replaced by --organ when that is given. Throws as
/// scene::load_scene and require_tellable (loaded_scene.h).
scene::Scene load_scene(const runtime::NodeOptions& options);

/// The participant of a node called `name`. Throws std::invalid_argument for an unknown vendor or profile.
transport::BusOptions bus_options(const runtime::LinkOptions& options, std::string name);

/// Joins the domain as bus_options() says, and tells on stderr, in one line, what in this machine's settings
/// will cost samples (transport::Bus::warning). Throws what bus_options() and transport::Bus::open() throw.
std::unique_ptr<transport::Bus> open_bus(const runtime::LinkOptions& options, const std::string& name);

/// A status that says who speaks: `kind` is one of msg::NODE_*; the instance is the start time on the
/// wall clock, ns, so that of two runs the smaller one is the older, also on two machines.
msg::NodeStatus introduce(std::uint32_t kind, double rate_hz);

/// A distribution as the topics carry it, us.
msg::Percentiles to_message(const runtime::Percentiles& percentiles);

/// Fills in the loop's figures and the faults; the rest stays. Not for a real-time thread (texts allocate).
void fill_status(const runtime::LoopRecord& record, const runtime::FaultList& faults,
                 msg::NodeStatus& status);
/// The faults alone.
void fill_faults(const runtime::FaultList& faults, msg::NodeStatus& status);

}  // namespace omentum::node
