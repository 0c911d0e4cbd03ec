#include "transport/yardstick/bare_link.h"

#include "cyclone_types.h"  // generated into the build tree by idl/generate.py --cyclone

#include <dds/dds.h>

#include <cstring>
#include <stdexcept>

namespace omentum::transport::yardstick {

namespace {

dds_entity_t checked(dds_entity_t entity) {
  if (entity < 0) throw std::runtime_error(std::string("bare Cyclone DDS: ") + dds_strretcode(entity));
  return entity;
}

class BareCyclone final : public BareLink {
 public:
  BareCyclone(int domain, End end, OnSample on_sample) : on_sample_(std::move(on_sample)) {
    const auto id = static_cast<dds_domainid_t>(domain);
    domain_ = checked(dds_create_domain(id, R"(<CycloneDDS><Domain Id="any"><General><Interfaces>
        <NetworkInterface name="lo" multicast="true"/></Interfaces></General></Domain></CycloneDDS>)"));
    participant_ = checked(dds_create_participant(id, nullptr, nullptr));
    dds_qos_t* qos = dds_create_qos();
    dds_qset_reliability(qos, DDS_RELIABILITY_BEST_EFFORT, 0);
    dds_listener_t* listener = dds_create_listener(this);
    dds_lset_data_available(listener, on_data_available);
    const bool ping = end == End::kPing;
    writer_ = checked(dds_create_writer(participant_, topic(ping ? "bare/ping" : "bare/pong"), qos, nullptr));
    checked(dds_create_reader(participant_, topic(ping ? "bare/pong" : "bare/ping"), qos, listener));
    dds_delete_listener(listener);
    dds_delete_qos(qos);
  }
  ~BareCyclone() override { dds_delete(domain_); }

  void send(const msg::ToolPose& pose) override { dds_write(writer_, &pose); }

 private:
  dds_entity_t topic(const char* name) const {
    return checked(dds_create_topic(participant_, &omentum_msg_ToolPose_desc, name, nullptr, nullptr));
  }

  static void on_data_available(dds_entity_t reader, void* self) {
    auto& me = *static_cast<BareCyclone*>(self);
    for (;;) {
      void* loan[1] = {nullptr};
      dds_sample_info_t info;
      if (dds_take(reader, loan, &info, 1, 1) <= 0) return;
      if (info.valid_data) std::memcpy(static_cast<void*>(&me.pose_), loan[0], sizeof(me.pose_));
      dds_return_loan(reader, loan, 1);
      if (info.valid_data) me.on_sample_(me.pose_);
    }
  }

  OnSample on_sample_;
  msg::ToolPose pose_;
  dds_entity_t domain_ = 0;
  dds_entity_t participant_ = 0;
  dds_entity_t writer_ = 0;
};

}  // namespace

std::unique_ptr<BareLink> open_bare_cyclone(int domain, BareLink::End end, BareLink::OnSample on_sample) {
  return std::make_unique<BareCyclone>(domain, end, std::move(on_sample));
}

}  // namespace omentum::transport::yardstick
