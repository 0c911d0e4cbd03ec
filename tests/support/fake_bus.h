// A bus without DDS, and the scripted peer at its other end.
#pragma once

#include "transport/bounds.h"
#include "transport/bus.h"
#include "transport/topics.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <deque>
#include <map>
#include <optional>
#include <sstream>
#include <tuple>
#include <vector>

namespace omentum::test {

/// Who posts unless a test names another one.
inline constexpr transport::WriterId kPeer{0xff};

template <class M>
class FakeReader;

/// One topic's wire: the readers and writers of the loops under test, and what the test's peer says and
/// hears. All calls come in turns (scripted_pace.h); nothing waits, and a sample is heard before the call
/// that sends it returns.
template <class M>
class FakeTopic {
 public:
  using Matcher = testing::Matcher<const M&>;

  // ---- the peer

  /// Says `sample`. Of a durable topic readers that come later hear it too, as long as its writer has not
  /// left.
  void post(const M& sample, const transport::WriterId& writer) {
    if (is_due(to_lose_)) return;
    if (is_due(to_reject_)) {
      ++reader_status_.rejected;
      return;
    }
    if (std::exchange(holds_next_, false)) {
      held_ = {sample, writer};
      return;
    }
    if (readers_.empty() && !kDurable) ++unheard_;
    deliver(sample, writer);
    if (const auto late = std::exchange(held_, std::nullopt)) deliver(late->first, late->second);
  }
  void leave(const transport::WriterId& writer);
  void offer_too_little(transport::QosPolicy policy) {
    for (const FakeReader<M>* reader : readers_) reader->refuse(policy);
  }
  void expect(Matcher matcher) { expected_.push_back(std::move(matcher)); }
  void watch() { watched_ = true; }
  std::deque<M> take_all() { return std::exchange(written_, {}); }
  const std::optional<M>& newest() {
    written_.clear();
    return newest_;
  }

  // ---- a bad wire

  void lose(int samples) { to_lose_ = samples; }
  void reject(int samples) { to_reject_ = samples; }
  void swap_next_two() { holds_next_ = true; }
  void refuse_writes(bool refused) { refuses_ = refused; }
  void on_write(std::function<void(const M&)> action) { on_write_ = std::move(action); }
  transport::EndpointStatus& reader_status() { return reader_status_; }

  /// What the test left open.
  std::vector<std::string> left_over() const {
    const std::string name = transport::kTopicSpec<M>.name;
    std::vector<std::string> lines;
    for (const Matcher& matcher : expected_) {
      std::ostringstream text;
      matcher.DescribeTo(&text);
      lines.push_back(name + ": no sample came that " + text.str());
    }
    if (watched_ && !written_.empty())
      lines.push_back(name + ": " + std::to_string(written_.size()) + " written samples were not consumed");
    if (unheard_ > 0) lines.push_back(name + ": " + std::to_string(unheard_) + " posted to nobody");
    if (held_) lines.push_back(name + ": a sample waits for the one that shall overtake it");
    return lines;
  }

  // ---- the endpoints

  void add(FakeReader<M>& reader);
  void remove(FakeReader<M>& reader) { std::erase(readers_, &reader); }
  int reader_count() const { return static_cast<int>(readers_.size()); }
  bool write(const M& sample, const transport::WriterId& writer) {
    if (on_write_) on_write_(sample);
    if (refuses_ || !transport::within_bounds(sample)) return false;
    newest_ = sample;
    const auto wanted = std::find_if(expected_.begin(), expected_.end(),
                                     [&](const Matcher& matcher) { return matcher.Matches(sample); });
    if (wanted == expected_.end()) {
      written_.push_back(sample);
    } else {
      expected_.erase(wanted);
    }
    deliver(sample, writer);
    return true;
  }

 private:
  static constexpr bool kDurable =
      transport::kTopicSpec<M>.durability == transport::Durability::kTransientLocal;
  using Key = std::pair<transport::WriterId, std::string>;

  static bool is_due(int& left) { return left > 0 && left-- > 0; }
  static std::string key_of(const M& sample) {
    std::string key;
    for_each_field(sample, [&](const msg::Field& field, const auto& value) {
      if constexpr (std::is_arithmetic_v<std::decay_t<decltype(value)>>)
        if (field.key) key += std::to_string(value) + ' ';
    });
    return key;
  }
  void deliver(const M& sample, const transport::WriterId& writer);

  std::vector<FakeReader<M>*> readers_;
  std::map<Key, M> kept_;  // of durable topics
  std::deque<M> written_;  // by the loops, not consumed
  std::optional<M> newest_;
  std::vector<Matcher> expected_;
  bool watched_ = false;
  int to_lose_ = 0, to_reject_ = 0;
  bool holds_next_ = false, refuses_ = false;
  std::optional<std::pair<M, transport::WriterId>> held_;
  std::uint64_t unheard_ = 0;
  std::function<void(const M&)> on_write_;
  transport::EndpointStatus reader_status_;
};

template <class M>
class FakeReader final : public transport::Reader<M> {
 public:
  FakeReader(FakeTopic<M>& topic, transport::ByWriter<M> callbacks)
      : topic_(topic), callbacks_(std::move(callbacks)) {
    topic_.add(*this);
  }
  ~FakeReader() override { topic_.remove(*this); }

  void hear(const M& sample, const transport::WriterId& writer) const {
    callbacks_.on_sample(sample, writer);
  }
  void gone(const transport::WriterId& writer) const {
    if (callbacks_.on_gone) callbacks_.on_gone(writer);
  }
  void refuse(transport::QosPolicy policy) const {
    if (callbacks_.on_refused) callbacks_.on_refused(policy);
  }
  transport::EndpointStatus status() const override { return topic_.reader_status(); }

 private:
  FakeTopic<M>& topic_;
  transport::ByWriter<M> callbacks_;
};

template <class M>
class FakeWriter final : public transport::Writer<M> {
 public:
  FakeWriter(FakeTopic<M>& topic, const transport::WriterId& id) : topic_(topic), id_(id) {}
  ~FakeWriter() override { topic_.leave(id_); }

  bool write(const M& sample) noexcept override {
    const bool written = topic_.write(sample, id_);
    ++(written ? status_.samples : status_.rejected);
    return written;
  }
  transport::EndpointStatus status() const override {
    transport::EndpointStatus status = status_;
    status.matched = topic_.reader_count();
    return status;
  }

 private:
  FakeTopic<M>& topic_;
  transport::WriterId id_;
  transport::EndpointStatus status_;
};

template <class M>
void FakeTopic<M>::add(FakeReader<M>& reader) {
  readers_.push_back(&reader);
  for (const auto& [key, sample] : kept_) reader.hear(sample, key.first);
}

template <class M>
void FakeTopic<M>::deliver(const M& sample, const transport::WriterId& writer) {
  if constexpr (kDurable) kept_.insert_or_assign(Key(writer, key_of(sample)), sample);
  reader_status_.samples += readers_.size();
  for (const FakeReader<M>* reader : readers_) reader->hear(sample, writer);
}

template <class M>
void FakeTopic<M>::leave(const transport::WriterId& writer) {
  std::erase_if(kept_, [&](const auto& kept) { return kept.first.first == writer; });
  for (const FakeReader<M>* reader : readers_) reader->gone(writer);
}

/// The domain that loops under test join, and the script of all who are not under test. Outlives them.
///
/// At its end it fails its test for every sample that was expected and never came, every sample of a watched
/// topic that was written and not consumed, and every sample that was posted where nobody listened.
class FakeBus {
 public:
  FakeBus() = default;
  ~FakeBus();
  FakeBus(const FakeBus&) = delete;
  FakeBus& operator=(const FakeBus&) = delete;

  /// For a loop: a participant of its own each time.
  transport::OpenBus opener();

  /// Says a sample, as `writer`, to every loop that reads its topic.
  template <class M>
  void post(const M& sample, const transport::WriterId& writer = kPeer) {
    topic<M>().post(sample, writer);
  }
  /// `writer` leaves, in whatever way.
  template <class M>
  void leave(const transport::WriterId& writer = kPeer) {
    topic<M>().leave(writer);
  }

  /// A sample that matches must be written from now on; the first one is consumed by it.
  template <class M, class Matcher>
  void expect(Matcher matcher) {
    topic<M>().expect(testing::MatcherCast<const M&>(std::move(matcher)));
  }
  /// From now on every sample that the loops write must be consumed: expected or taken.
  template <class M>
  void watch() {
    topic<M>().watch();
  }
  /// Consumes what was written, in order.
  template <class M>
  std::deque<M> take_all() {
    return topic<M>().take_all();
  }
  /// Consumes what was written; the newest sample ever.
  template <class M>
  std::optional<M> newest() {
    return topic<M>().newest();
  }

  /// The next samples that are posted are lost / cannot be decoded, and are counted by their readers.
  template <class M>
  void lose(int samples) {
    topic<M>().lose(samples);
  }
  template <class M>
  void reject(int samples) {
    topic<M>().reject(samples);
  }
  /// The next posted sample comes after the one behind it.
  template <class M>
  void swap_next_two() {
    topic<M>().swap_next_two();
  }
  /// write() gives false, as a vendor that has no room or joins anew.
  template <class M>
  void refuse_writes(bool refused) {
    topic<M>().refuse_writes(refused);
  }
  /// Done in each write() before the sample leaves: time may pass there (ScriptedPace::stall).
  template <class M>
  void on_write(std::function<void(const M&)> action) {
    topic<M>().on_write(std::move(action));
  }
  /// Somebody writes it who offers less of that policy than its readers request.
  template <class M>
  void offer_too_little(transport::QosPolicy policy) {
    topic<M>().offer_too_little(policy);
  }
  /// What readers say of themselves.
  template <class M>
  transport::EndpointStatus& reader_status() {
    return topic<M>().reader_status();
  }

  /// Everything that the end would fail for, a line each.
  std::vector<std::string> left_over() const;

 private:
  friend class FakeParticipant;
  template <class... M>
  static std::tuple<FakeTopic<M>...> topics_of(msg::TopicList<M...>);

  template <class M>
  FakeTopic<M>& topic() {
    return std::get<FakeTopic<M>>(topics_);
  }
  transport::WriterId next_writer(std::uint8_t participant);

  decltype(topics_of(msg::AllTopics{})) topics_;
  std::uint8_t participants_ = 0, writers_ = 0;
};

}  // namespace omentum::test
