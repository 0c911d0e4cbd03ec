#include "transport/fast/participant.h"

#include "transport/arrivals.h"
#include "transport/fast/entities.h"
#include "transport/fast/message_type.h"
#include "transport/reader_counters.h"

#include <atomic>
#include <stdexcept>

namespace omentum::transport::fast {

namespace {

using eprosima::fastrtps::types::ReturnCode_t;

template <class M>
class FastWriter final : public Writer<M> {
 public:
  explicit FastWriter(Entities& entities) : entities_(entities) {
    const TopicSpec& spec = kTopicSpec<M>;
    dds::Topic* topic = entities.topic(spec, dds::TypeSupport(new MessageType<M>));
    const auto qos = writer_qos(spec, entities.profile, kEncapsulationBytes + msg::MessageInfo<M>::kMaxBytes);
    writer_ = entities.publisher->create_datawriter(topic, qos, nullptr, dds::StatusMask::none());
    if (!writer_) throw std::runtime_error(std::string("Fast DDS refused a writer of ") + spec.name);
  }
  ~FastWriter() override { entities_.publisher->delete_datawriter(writer_); }

  bool write(const M& sample) noexcept override {
    if (within_bounds(sample) && send(sample)) {
      ++samples_;
      return true;
    }
    ++rejected_;
    return false;
  }

  EndpointStatus status() const override {
    EndpointStatus status = status_of(*writer_);
    status.samples = samples_;
    status.rejected = rejected_;
    return status;
  }

 private:
  bool send(const M& sample) noexcept {
    // serialize() and getKey() only read it
    SampleRef<M> data{const_cast<M*>(&sample)};
    try {
      return writer_->write(&data);
    } catch (const std::exception&) {
      return false;
    }
  }

  Entities& entities_;
  dds::DataWriter* writer_ = nullptr;
  std::atomic<std::uint64_t> samples_{0};
  std::atomic<std::uint64_t> rejected_{0};
};

template <class M>
class FastReader final : public Reader<M>, private dds::DataReaderListener {
 public:
  FastReader(Entities& entities, std::function<void(const M&)> on_sample)
      : entities_(entities), on_sample_(std::move(on_sample)) {
    const TopicSpec& spec = kTopicSpec<M>;
    dds::Topic* topic = entities.topic(spec, dds::TypeSupport(new MessageType<M>));
    const auto mask = dds::StatusMask::data_available() << dds::StatusMask::liveliness_changed();
    reader_ = entities.subscriber->create_datareader(topic, reader_qos(spec), this, mask);
    if (!reader_) throw std::runtime_error(std::string("Fast DDS refused a reader of ") + spec.name);
  }

  ~FastReader() override {
    reader_->set_listener(nullptr);
    arrivals_.close();
    entities_.subscriber->delete_datareader(reader_);
  }

  EndpointStatus status() const override {
    EndpointStatus status = status_of(*reader_);
    counters_.add_to(status);
    return status;
  }

 private:
  void on_data_available(dds::DataReader* reader) override {
    arrivals_.announce([&] { take_all(*reader); });
  }

  void on_liveliness_changed(dds::DataReader*,
                             const eprosima::fastrtps::LivelinessChangedStatus& status) override {
    counters_.liveliness_changed(status.not_alive_count_change);
  }

  void take_all(dds::DataReader& reader) {
    SampleRef<M> data{&message_};
    dds::SampleInfo info;
    while (reader.take_next_sample(&data, &info) == ReturnCode_t::RETCODE_OK) {
      if (!info.valid_data) continue;
      if (!data.decoded) {
        counters_.rejected();
        continue;
      }
      counters_.delivered(message_);
      on_sample_(message_);
    }
  }

  Entities& entities_;
  std::function<void(const M&)> on_sample_;
  M message_;  // its sequences keep their memory from sample to sample
  Arrivals arrivals_;
  ReaderCounters<M> counters_;
  dds::DataReader* reader_ = nullptr;
};

}  // namespace

Participant::Participant(const BusOptions& options) : entities_(std::make_unique<Entities>(options)) {}
Participant::~Participant() = default;

template <class M>
std::unique_ptr<Writer<M>> Participant::writer() {
  return std::make_unique<FastWriter<M>>(*entities_);
}

template <class M>
std::unique_ptr<Reader<M>> Participant::reader(std::function<void(const M&)> on_sample) {
  return std::make_unique<FastReader<M>>(*entities_, std::move(on_sample));
}

#define OMENTUM_INSTANTIATE(M)                                            \
  template std::unique_ptr<Writer<msg::M>> Participant::writer<msg::M>(); \
  template std::unique_ptr<Reader<msg::M>> Participant::reader<msg::M>(std::function<void(const msg::M&)>);
OMENTUM_FOR_EACH_TOPIC(OMENTUM_INSTANTIATE)
#undef OMENTUM_INSTANTIATE

}  // namespace omentum::transport::fast
