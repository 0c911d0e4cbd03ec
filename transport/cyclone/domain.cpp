#include "transport/cyclone/domain.h"

#include "transport/cyclone/awake.h"
#include "transport/cyclone/complaints.h"
#include "transport/settings.h"
#include "transport/topics.h"

#include <dds/dds.h>

#include <map>
#include <mutex>
#include <stdexcept>

namespace omentum::transport::cyclone {

namespace {

struct OpenDomain {
  dds_entity_t entity = 0;
  Profile profile = Profile::kLoopback;
  std::string identity;
  int users = 0;
};

struct OpenDomains {
  std::mutex mutex;
  std::map<int, OpenDomain> by_id;
};

// Process-wide because Cyclone's domains are; see Domain.
OpenDomains& open_domains() {
  static OpenDomains domains;
  return domains;
}

std::string element(const std::string& name, const std::string& content) {
  return "<" + name + ">" + content + "</" + name + ">";
}

std::string bytes(std::size_t count) {
  return std::to_string(count) + "B";
}

std::string milliseconds(int count) {
  return std::to_string(count) + "ms";
}

std::string general(Profile profile, const std::optional<Interface>& interface) {
  std::string text = element("MaxMessageSize", bytes(max_message_bytes(profile))) +
                     element("FragmentSize", bytes(fragment_bytes(profile)));
  // lo has no MULTICAST flag, and without multicast Cyclone finds no Fast DDS process started later
  if (profile == Profile::kLoopback)
    text += element("Interfaces", R"(<NetworkInterface name="lo" multicast="true"/>)");
  else if (interface)
    text += element("Interfaces", "<NetworkInterface address=\"" + interface->address + "\"/>");
  return element("General", text);
}

std::string discovery(const std::vector<std::string>& peers) {
  // participants of one machine that are found by address need ports that can be guessed: an index each
  constexpr int kMostParticipants = 30;
  std::string text = element("LeaseDuration", milliseconds(kCycloneLease_ms)) +
                     element("SPDPInterval", milliseconds(kAnnouncementPeriod_ms));
  if (!peers.empty()) {
    std::string list;
    for (const std::string& peer : peers) list += "<Peer Address=\"" + peer + "\"/>";
    text += element("ParticipantIndex", "auto") +
            element("MaxAutoParticipantIndex", std::to_string(kMostParticipants)) + element("Peers", list);
  }
  return element("Discovery", text);
}

std::string identity_of(const BusOptions& options) {
  return options.keystore.empty() ? "nobody" : options.name + " of " + options.keystore;
}

// whoever joins an open domain does it as the first one did
void require_alike(const OpenDomain& open, const BusOptions& options) {
  const std::string place = "Cyclone DDS: this process already uses domain " + std::to_string(options.domain);
  if (open.profile != options.profile) throw std::runtime_error(place + " with the other profile");
  if (open.identity != identity_of(options))
    throw std::runtime_error(place + " as " + open.identity + ", and cannot be " + identity_of(options));
}

}  // namespace

std::string configuration(Profile profile, const std::vector<std::string>& peers,
                          const std::optional<Interface>& interface) {
  // a "min" would refuse to start where the kernel allows less; Bus::warning() says so instead
  const std::string buffers = "<SocketReceiveBufferSize max=\"" + bytes(kSocketBufferBytes) + "\"/>";
  const auto used_peers = profile == Profile::kLan ? peers : std::vector<std::string>{};
  return element("CycloneDDS", "<Domain Id=\"any\">" + general(profile, interface) + discovery(used_peers) +
                                   element("Internal", buffers) + "</Domain>");
}

Domain::Domain(const BusOptions& options) : id_(options.domain) {
  tell_complaints_once();
  OpenDomains& domains = open_domains();
  const std::lock_guard lock(domains.mutex);
  const auto found = domains.by_id.find(id_);
  if (found != domains.by_id.end()) {
    require_alike(found->second, options);
    ++found->second.users;
    return;
  }
  const bool lan = options.profile == Profile::kLan;
  const std::string text =
      configuration(options.profile, lan ? peers_from_environment() : std::vector<std::string>{},
                    lan ? interface_from_environment() : std::nullopt);
  const dds_entity_t entity = dds_create_domain(static_cast<dds_domainid_t>(id_), text.c_str());
  if (entity < 0)
    throw std::runtime_error("Cyclone DDS refused domain " + std::to_string(id_) + ": " +
                             dds_strretcode(entity));
  domains.by_id[id_] = {entity, options.profile, identity_of(options), 1};
}

Domain::~Domain() {
  OpenDomains& domains = open_domains();
  const std::lock_guard lock(domains.mutex);
  const auto found = domains.by_id.find(id_);
  if (--found->second.users > 0) return;
  const Awake receivers(id_);
  dds_delete(found->second.entity);
  domains.by_id.erase(found);
}

}  // namespace omentum::transport::cyclone
