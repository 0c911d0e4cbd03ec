#include "transport/cyclone/participant.h"

#include "transport/arrivals.h"
#include "transport/cyclone/complaints.h"
#include "transport/cyclone/conversion.h"
#include "transport/cyclone/entities.h"
#include "transport/cyclone/writer_names.h"
#include "transport/departures.h"
#include "transport/reader_counters.h"
#include "transport/refused_writers.h"

#include <atomic>
#include <stdexcept>

namespace omentum::transport::cyclone {

namespace {

template <class M>
class CycloneWriter final : public Writer<M> {
 public:
  explicit CycloneWriter(const Entities& entities) {
    const TopicSpec& spec = kTopicSpec<M>;
    const dds_entity_t topic = entities.topic(spec, WireType<M>::descriptor());
    writer_ = checked(dds_create_writer(entities.participant, topic, writer_qos(spec).get(), nullptr),
                      std::string("a writer of ") + spec.name);
  }
  ~CycloneWriter() override { dds_delete(writer_); }

  bool write(const M& sample) noexcept override {
    if (within_bounds(sample) && send(sample)) {
      ++samples_;
      return true;
    }
    ++rejected_;
    return false;
  }

  EndpointStatus status() const override {
    EndpointStatus status = writer_status(writer_);
    status.samples = samples_;
    status.rejected = rejected_;
    return status;
  }

 private:
  bool send(const M& sample) noexcept {
    if constexpr (WireType<M>::kFlat) {
      return dds_write(writer_, &sample) == DDS_RETCODE_OK;
    } else {
      lender_.lend(sample, wire_);
      return dds_write(writer_, &wire_) == DDS_RETCODE_OK;
    }
  }

  dds_entity_t writer_ = 0;
  Lender lender_;
  typename WireType<M>::Type wire_{};
  std::atomic<std::uint64_t> samples_{0};
  std::atomic<std::uint64_t> rejected_{0};
};

template <class M>
class CycloneReader final : public Reader<M> {
 public:
  CycloneReader(const Entities& entities, ByWriter<M> callbacks) : callbacks_(std::move(callbacks)) {
    const TopicSpec& spec = kTopicSpec<M>;
    const dds_entity_t topic = entities.topic(spec, WireType<M>::descriptor());
    const std::unique_ptr<dds_listener_t, void (*)(dds_listener_t*)> listener(dds_create_listener(this),
                                                                              dds_delete_listener);
    dds_lset_data_available(listener.get(), on_data_available);
    dds_lset_requested_incompatible_qos(listener.get(), on_requested_incompatible_qos);
    if (callbacks_.on_gone) {
      dds_lset_subscription_matched(listener.get(), on_subscription_matched);
      // Cyclone would tell the others too, whatever they request
      dds_lset_liveliness_changed(listener.get(), on_liveliness_changed);
    }
    reader_ =
        checked(dds_create_reader(entities.participant, topic, reader_qos(requested_).get(), listener.get()),
                std::string("a reader of ") + spec.name);
  }

  ~CycloneReader() override {
    dds_set_listener(reader_, nullptr);
    arrivals_.close();
    dds_delete(reader_);
  }

  EndpointStatus status() const override {
    EndpointStatus status = reader_status(reader_);
    counters_.add_to(status);
    status.rejected += undecodable(kTopicSpec<M>.name) - undecodable_before_;
    return status;
  }

 private:
  static void on_data_available(dds_entity_t reader, void* self) {
    auto& me = *static_cast<CycloneReader*>(self);
    me.arrivals_.announce([&] { me.take_all(reader); });
  }

  static void on_subscription_matched(dds_entity_t reader, dds_subscription_matched_status_t status,
                                      void* self) {
    if (status.current_count_change >= 0) return;
    auto& me = *static_cast<CycloneReader*>(self);
    me.departures_.left(handle_id(status.last_publication_handle));
    me.arrivals_.announce([&] { me.take_all(reader); });
  }

  static void on_liveliness_changed(dds_entity_t, dds_liveliness_changed_status_t status, void* self) {
    static_cast<CycloneReader*>(self)->counters_.liveliness_changed(status.not_alive_count_change);
  }

  static void on_requested_incompatible_qos(dds_entity_t, dds_requested_incompatible_qos_status_t status,
                                            void* self) {
    const auto& me = *static_cast<const CycloneReader*>(self);
    const QosPolicy policy = policy_of(status.last_policy_id, DDS_DATA_REPRESENTATION_QOS_POLICY_ID);
    tell_refused_writer(me.requested_, policy);
    if (me.callbacks_.on_refused) me.callbacks_.on_refused(policy);
  }

  // a sample over a bound of the IDL does not pass Cyclone's own deserializer, which tells its log only
  // (complaints.h)
  void take_all(dds_entity_t reader) {
    const auto gone = callbacks_.on_gone ? departures_.take() : std::vector<WriterId>{};
    while (take_some(reader)) continue;
    for (const WriterId& handle : gone) callbacks_.on_gone(names_.forget(handle));
  }

  bool take_some(dds_entity_t reader) {
    constexpr std::int32_t kAtOnce = 8;
    void* loans[kAtOnce] = {};
    dds_sample_info_t infos[kAtOnce];
    const std::int32_t count = dds_take(reader, loans, infos, kAtOnce, kAtOnce);
    if (count <= 0) return false;
    for (std::int32_t i = 0; i < count; ++i)
      if (infos[i].valid_data) deliver(loans[i], name_of(reader, infos[i].publication_handle));
    dds_return_loan(reader, loans, count);
    return true;
  }

  // nobody asks who does not want to know who left
  WriterId name_of(dds_entity_t reader, dds_instance_handle_t publication) {
    return callbacks_.on_gone ? names_.find(reader, publication) : handle_id(publication);
  }

  void deliver(const void* loan, const WriterId& writer) {
    take_over(*static_cast<const typename WireType<M>::Type*>(loan), message_);
    counters_.delivered(message_);
    callbacks_.on_sample(message_, writer);
  }

  ByWriter<M> callbacks_;
  const TopicSpec requested_ = requested(kTopicSpec<M>, static_cast<bool>(callbacks_.on_gone));
  Departures departures_;  // of handles, where somebody asks for them
  WriterNames names_;      // for whoever takes samples
  M message_;              // its sequences keep their memory from sample to sample
  Arrivals arrivals_;
  ReaderCounters<M> counters_;
  const std::uint64_t undecodable_before_ = undecodable(kTopicSpec<M>.name);
  dds_entity_t reader_ = 0;
};

}  // namespace

Participant::Participant(const BusOptions& options) : entities_(std::make_unique<Entities>(options)) {}
Participant::~Participant() = default;

template <class M>
std::unique_ptr<Writer<M>> Participant::writer() {
  return std::make_unique<CycloneWriter<M>>(*entities_);
}

template <class M>
std::unique_ptr<Reader<M>> Participant::reader(ByWriter<M> callbacks) {
  return std::make_unique<CycloneReader<M>>(*entities_, std::move(callbacks));
}

#define OMENTUM_INSTANTIATE(M)                                            \
  template std::unique_ptr<Writer<msg::M>> Participant::writer<msg::M>(); \
  template std::unique_ptr<Reader<msg::M>> Participant::reader<msg::M>(ByWriter<msg::M>);
OMENTUM_FOR_EACH_TOPIC(OMENTUM_INSTANTIATE)
#undef OMENTUM_INSTANTIATE

}  // namespace omentum::transport::cyclone
