#include "transport/fast/participant.h"

#include "transport/arrivals.h"
#include "transport/departures.h"
#include "transport/fast/membership.h"
#include "transport/fast/message_type.h"
#include "transport/fast/newest_by_key.h"
#include "transport/reader_counters.h"
#include "transport/refused_writers.h"
#include "transport/settings.h"
#include "transport/standstill.h"

#include <algorithm>
#include <atomic>
#include <shared_mutex>
#include <stdexcept>
#include <type_traits>

namespace omentum::transport::fast {

namespace {

WriterId writer_id(const dds::InstanceHandle_t& publication) {
  WriterId id{};
  for (std::size_t i = 0; i < id.size(); ++i) id[i] = publication.value[i];
  return id;
}

// A process that stood still for so long forgot some others and not all, or they it.
constexpr auto kForgottenAfter = std::chrono::milliseconds(std::min(kCycloneLease_ms, kFastLease_ms)) * 3 / 4;

// On a LAN a block fits a datagram, whatever its type's bound. So its writer sends it, alone: Fast DDS' own
// thread would put those that wait into one message, secured of up to 8 kB, which IP splits. Of what is split
// the kernel keeps the rest for 30 s when a part is lost, until it has no room for any.
template <class M>
constexpr std::size_t largest_sample(Profile profile) {
  constexpr bool kBlocks = std::is_same_v<M, msg::OrganState> || std::is_same_v<M, msg::OrganStress> ||
                           std::is_same_v<M, msg::TouchingPairs>;
  if (kBlocks && profile == Profile::kLan) return fragment_bytes(profile);
  return kEncapsulationBytes + msg::MessageInfo<M>::kMaxBytes;
}

template <class M>
class FastWriter final : public Writer<M>, private Endpoint {
 public:
  explicit FastWriter(Membership& membership) : membership_(membership) { membership.add(*this); }
  ~FastWriter() override { membership_.remove(*this); }

  bool write(const M& sample) noexcept override {
    if (within_bounds(sample) && send(sample)) {
      ++samples_;
      return true;
    }
    ++rejected_;
    return false;
  }

  EndpointStatus status() const override {
    const std::shared_lock lock(mutex_);
    EndpointStatus status = writer_ ? status_of(*writer_) : EndpointStatus{};
    status.samples = samples_;
    status.rejected = rejected_;
    return status;
  }

 private:
  void join(Entities& entities) override {
    const TopicSpec& spec = kTopicSpec<M>;
    dds::Topic* topic = entities.topic(spec, dds::TypeSupport(new MessageType<M>));
    const auto qos = writer_qos(spec, entities.profile, largest_sample<M>(entities.profile));
    const std::lock_guard lock(mutex_);
    writer_ = entities.publisher->create_datawriter(topic, qos, nullptr, dds::StatusMask::none());
    if (!writer_) throw std::runtime_error(std::string("Fast DDS refused a writer of ") + spec.name);
    // a new writer's history is empty
    newest_.for_each([this](const M& sample) { hand_over(sample); });
  }

  void leave(Entities& entities) override {
    const std::lock_guard lock(mutex_);
    if (writer_) entities.publisher->delete_datawriter(writer_);
    writer_ = nullptr;
  }

  bool send(const M& sample) noexcept {
    try {
      std::shared_lock lock(mutex_, std::defer_lock);
      if constexpr (kDurable<M>) {
        lock.lock();
        newest_.keep(sample);
        return !writer_ || hand_over(sample);  // without a participant: said by the next one
      } else {
        // a participant that is being renewed is not waited for
        return lock.try_lock() && writer_ && hand_over(sample);
      }
    } catch (const std::exception&) {
      return false;
    }
  }

  bool hand_over(const M& sample) {
    // serialize() and getKey() only read it
    SampleRef<M> data{const_cast<M*>(&sample)};
    return written(writer_->write(&data));
  }

  Membership& membership_;
  mutable std::shared_mutex mutex_;  // exclusive: writer_ changes
  dds::DataWriter* writer_ = nullptr;
  NewestByKey<M> newest_;  // of durable topics only
  std::atomic<std::uint64_t> samples_{0};
  std::atomic<std::uint64_t> rejected_{0};
};

template <class M>
class FastReader final : public Reader<M>, private Endpoint, private dds::DataReaderListener {
 public:
  FastReader(Membership& membership, ByWriter<M> callbacks)
      : membership_(membership), callbacks_(std::move(callbacks)) {
    membership.add(*this);
  }
  ~FastReader() override { membership_.remove(*this); }

  EndpointStatus status() const override {
    const std::shared_lock lock(mutex_);
    EndpointStatus status = reader_ ? status_of(*reader_) : EndpointStatus{};
    counters_.add_to(status);
    return status;
  }

 private:
  void join(Entities& entities) override {
    const TopicSpec& spec = kTopicSpec<M>;
    dds::Topic* topic = entities.topic(spec, dds::TypeSupport(new MessageType<M>));
    auto mask = dds::StatusMask::data_available()
                << dds::StatusMask::liveliness_changed() << dds::StatusMask::requested_incompatible_qos();
    if (callbacks_.on_gone) mask << dds::StatusMask::subscription_matched();
    if (callbacks_.on_gone)
      for (const WriterId& writer : departures_.take_all()) callbacks_.on_gone(writer);
    arrivals_.open();
    dds::DataReader* reader =
        entities.subscriber->create_datareader(topic, reader_qos(requested_), this, mask);
    if (!reader) throw std::runtime_error(std::string("Fast DDS refused a reader of ") + spec.name);
    const std::lock_guard lock(mutex_);
    reader_ = reader;
  }

  void leave(Entities& entities) override {
    if (!reader_) return;
    reader_->set_listener(nullptr);
    arrivals_.close();
    const std::lock_guard lock(mutex_);
    entities.subscriber->delete_datareader(reader_);
    reader_ = nullptr;
  }

  void on_data_available(dds::DataReader* reader) override {
    arrivals_.announce([&] { take_all(*reader); });
  }

  void on_subscription_matched(dds::DataReader* reader,
                               const dds::SubscriptionMatchedStatus& status) override {
    if (status.current_count_change >= 0) return;
    departures_.left(writer_id(status.last_publication_handle));
    arrivals_.announce([&] { take_all(*reader); });
  }

  void on_liveliness_changed(dds::DataReader*, const LivelinessChangedStatus& status) override {
    counters_.liveliness_changed(status.not_alive_count_change);
  }

  void on_requested_incompatible_qos(dds::DataReader*,
                                     const dds::RequestedIncompatibleQosStatus& status) override {
    const QosPolicy policy = policy_of(static_cast<std::uint32_t>(status.last_policy_id),
                                       static_cast<std::uint32_t>(dds::DATAREPRESENTATION_QOS_POLICY_ID));
    tell_refused_writer(requested_, policy);
    if (callbacks_.on_refused) callbacks_.on_refused(policy);
  }

  void take_all(dds::DataReader& reader) {
    const auto gone = callbacks_.on_gone ? departures_.take() : std::vector<WriterId>{};
    SampleRef<M> data{&message_};
    dds::SampleInfo info;
    while (reader.take_next_sample(&data, &info) == kOk) {
      if (!info.valid_data) continue;
      if (!data.decoded) {
        counters_.rejected();
        continue;
      }
      counters_.delivered(message_);
      const WriterId writer = writer_id(info.publication_handle);
      if (callbacks_.on_gone) departures_.delivered(writer);
      callbacks_.on_sample(message_, writer);
    }
    for (const WriterId& writer : gone) callbacks_.on_gone(writer);
  }

  Membership& membership_;
  ByWriter<M> callbacks_;
  const TopicSpec requested_ = requested(kTopicSpec<M>, static_cast<bool>(callbacks_.on_gone));
  Departures departures_;  // where somebody asks for them
  M message_;              // its sequences keep their memory from sample to sample
  Arrivals arrivals_;
  ReaderCounters<M> counters_;
  mutable std::shared_mutex mutex_;  // exclusive: reader_ changes
  dds::DataReader* reader_ = nullptr;
};

}  // namespace

Participant::Participant(const BusOptions& options)
    : membership_(std::make_unique<Membership>(options)),
      watch_(std::make_unique<StandstillWatch>(kForgottenAfter, [this] { return membership_->renew(); })) {}

Participant::~Participant() = default;

bool Participant::renew() noexcept {
  return membership_->renew();
}

template <class M>
std::unique_ptr<Writer<M>> Participant::writer() {
  return std::make_unique<FastWriter<M>>(*membership_);
}

template <class M>
std::unique_ptr<Reader<M>> Participant::reader(ByWriter<M> callbacks) {
  return std::make_unique<FastReader<M>>(*membership_, std::move(callbacks));
}

#define OMENTUM_INSTANTIATE(M)                                            \
  template std::unique_ptr<Writer<msg::M>> Participant::writer<msg::M>(); \
  template std::unique_ptr<Reader<msg::M>> Participant::reader<msg::M>(ByWriter<msg::M>);
OMENTUM_FOR_EACH_TOPIC(OMENTUM_INSTANTIATE)
#undef OMENTUM_INSTANTIATE

}  // namespace omentum::transport::fast
