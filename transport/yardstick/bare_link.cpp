#include "transport/yardstick/bare_link.h"

namespace omentum::transport::yardstick {

std::unique_ptr<BareLink> BareLink::open(Vendor vendor, int domain, End end, OnSample on_sample) {
  return vendor == Vendor::kFast ? open_bare_fast(domain, end, std::move(on_sample))
                                 : open_bare_cyclone(domain, end, std::move(on_sample));
}

}  // namespace omentum::transport::yardstick
