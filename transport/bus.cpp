#include "transport/bus.h"

#include "transport/cyclone/participant.h"
#include "transport/fast/participant.h"
#include "transport/settings.h"

#include <stdexcept>
#include <variant>

namespace omentum::transport {

namespace {

using FastParticipant = std::unique_ptr<fast::Participant>;
using CycloneParticipant = std::unique_ptr<cyclone::Participant>;
using AnyParticipant = std::variant<FastParticipant, CycloneParticipant>;

class VendorBus final : public Bus {
 public:
  explicit VendorBus(AnyParticipant participant) : participant(std::move(participant)) {}
  std::string warning() const override { return receive_buffer_warning(kernel_receive_buffer_limit()); }

  AnyParticipant participant;
};

AnyParticipant join(const BusOptions& options) {
  if (options.vendor == Vendor::kFast) return std::make_unique<fast::Participant>(options);
  return std::make_unique<cyclone::Participant>(options);
}

// open() makes nothing else, so that every bus is one
AnyParticipant& participant_of(Bus& bus) {
  return static_cast<VendorBus&>(bus).participant;
}

}  // namespace

std::unique_ptr<Bus> Bus::open(const BusOptions& options) {
  if (!options.keystore.empty())
    throw std::runtime_error("key store '" + options.keystore +
                             "': secured topics are not part of this version");
  if (options.domain < 0 || options.domain > kMaxDomain)
    throw std::runtime_error("DDS domain " + std::to_string(options.domain) + ": expected 0 to " +
                             std::to_string(kMaxDomain));
  return std::make_unique<VendorBus>(join(options));
}

template <class M>
std::unique_ptr<Writer<M>> Bus::writer() {
  return std::visit([](auto& participant) { return participant->template writer<M>(); },
                    participant_of(*this));
}

template <class M>
std::unique_ptr<Reader<M>> Bus::reader(ByWriter<M> callbacks) {
  return std::visit([&](auto& participant) { return participant->template reader<M>(std::move(callbacks)); },
                    participant_of(*this));
}

template <class M>
std::unique_ptr<Reader<M>> Bus::reader(std::function<void(const M&)> on_sample) {
  return reader<M>(ByWriter<M>{
      [callback = std::move(on_sample)](const M& sample, const WriterId&) { callback(sample); }, {}});
}

#define OMENTUM_INSTANTIATE(M)                                                    \
  template std::unique_ptr<Writer<msg::M>> Bus::writer<msg::M>();                 \
  template std::unique_ptr<Reader<msg::M>> Bus::reader<msg::M>(ByWriter<msg::M>); \
  template std::unique_ptr<Reader<msg::M>> Bus::reader<msg::M>(std::function<void(const msg::M&)>);
OMENTUM_FOR_EACH_TOPIC(OMENTUM_INSTANTIATE)
#undef OMENTUM_INSTANTIATE

Vendor parse_vendor(const std::string& word) {
  if (word == "fast") return Vendor::kFast;
  if (word == "cyclone") return Vendor::kCyclone;
  throw std::invalid_argument("DDS vendor '" + word + "': expected fast or cyclone");
}

Profile parse_profile(const std::string& word) {
  if (word == "loopback") return Profile::kLoopback;
  if (word == "lan") return Profile::kLan;
  throw std::invalid_argument("profile '" + word + "': expected loopback or lan");
}

}  // namespace omentum::transport
