#include "transport/cyclone/participant.h"

#include "transport/arrivals.h"
#include "transport/cyclone/complaints.h"
#include "transport/cyclone/conversion.h"
#include "transport/cyclone/entities.h"
#include "transport/reader_counters.h"

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
  CycloneReader(const Entities& entities, std::function<void(const M&)> on_sample)
      : on_sample_(std::move(on_sample)) {
    const TopicSpec& spec = kTopicSpec<M>;
    const dds_entity_t topic = entities.topic(spec, WireType<M>::descriptor());
    const std::unique_ptr<dds_listener_t, void (*)(dds_listener_t*)> listener(dds_create_listener(this),
                                                                              dds_delete_listener);
    dds_lset_data_available(listener.get(), on_data_available);
    dds_lset_liveliness_changed(listener.get(), on_liveliness_changed);
    reader_ = checked(dds_create_reader(entities.participant, topic, reader_qos(spec).get(), listener.get()),
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

  static void on_liveliness_changed(dds_entity_t, dds_liveliness_changed_status_t status, void* self) {
    static_cast<CycloneReader*>(self)->counters_.liveliness_changed(status.not_alive_count_change);
  }

  // a sample over a bound of the IDL does not pass Cyclone's own deserializer, which tells nobody
  void take_all(dds_entity_t reader) {
    constexpr std::int32_t kAtOnce = 8;
    for (;;) {
      void* loans[kAtOnce] = {};
      dds_sample_info_t infos[kAtOnce];
      const std::int32_t count = dds_take(reader, loans, infos, kAtOnce, kAtOnce);
      if (count <= 0) return;
      for (std::int32_t i = 0; i < count; ++i)
        if (infos[i].valid_data) deliver(loans[i]);
      dds_return_loan(reader, loans, count);
    }
  }

  void deliver(const void* loan) {
    take_over(*static_cast<const typename WireType<M>::Type*>(loan), message_);
    counters_.delivered(message_);
    on_sample_(message_);
  }

  std::function<void(const M&)> on_sample_;
  M message_;  // its sequences keep their memory from sample to sample
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
std::unique_ptr<Reader<M>> Participant::reader(std::function<void(const M&)> on_sample) {
  return std::make_unique<CycloneReader<M>>(*entities_, std::move(on_sample));
}

#define OMENTUM_INSTANTIATE(M)                                            \
  template std::unique_ptr<Writer<msg::M>> Participant::writer<msg::M>(); \
  template std::unique_ptr<Reader<msg::M>> Participant::reader<msg::M>(std::function<void(const msg::M&)>);
OMENTUM_FOR_EACH_TOPIC(OMENTUM_INSTANTIATE)
#undef OMENTUM_INSTANTIATE

}  // namespace omentum::transport::cyclone
