#include "transport/bus.h"

#include "transport/cyclone/participant.h"
#include "transport/fast/participant.h"
#include "transport/settings.h"

#include <stdexcept>

namespace omentum::transport {

namespace {

template <class Participant>
class VendorBus final : public Bus {
 public:
  explicit VendorBus(const BusOptions& options) : participant_(options) {}
  std::string warning() const override { return receive_buffer_warning(kernel_receive_buffer_limit()); }

 private:
#define OMENTUM_MAKE_ENDPOINTS(M)                                                    \
  std::unique_ptr<Writer<msg::M>> make_writer(msg::MessageTag<msg::M>) override {    \
    return participant_.template writer<msg::M>();                                   \
  }                                                                                  \
  std::unique_ptr<Reader<msg::M>> make_reader(ByWriter<msg::M> callbacks) override { \
    return participant_.template reader<msg::M>(std::move(callbacks));               \
  }
  OMENTUM_FOR_EACH_TOPIC(OMENTUM_MAKE_ENDPOINTS)
#undef OMENTUM_MAKE_ENDPOINTS

  Participant participant_;
};

}  // namespace

std::unique_ptr<Bus> Bus::open(const BusOptions& options) {
  if (options.domain < 0 || options.domain > kMaxDomain)
    throw std::runtime_error("DDS domain " + std::to_string(options.domain) + ": expected 0 to " +
                             std::to_string(kMaxDomain));
  if (options.vendor == Vendor::kFast) return std::make_unique<VendorBus<fast::Participant>>(options);
  return std::make_unique<VendorBus<cyclone::Participant>>(options);
}

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
