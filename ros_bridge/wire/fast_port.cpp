#include "ros_bridge/wire/fast_type.h"
#include "ros_bridge/wire/ros_port.h"
#include "transport/arrivals.h"
#include "transport/fast/entities.h"

#include <fastdds/dds/subscriber/DataReaderListener.hpp>
#include <fastdds/dds/subscriber/SampleInfo.hpp>

#include <stdexcept>

namespace omentum::ros {
namespace {

namespace fast = transport::fast;
namespace dds = eprosima::fastdds::dds;

template <class End>
End* made(End* end, const std::string& what) {
  if (!end) throw std::runtime_error("Fast DDS refused " + what);
  return end;
}

template <class M>
class FastPublisher final : public Publisher<M> {
 public:
  FastPublisher(fast::Entities& entities, const TopicName& topic) : entities_(entities) {
    const transport::TopicSpec spec = spec_of(topic);
    auto type = new FastType<M>;
    auto* on_wire = entities.topic(spec, dds::TypeSupport(type));
    writer_ = made(entities.publisher->create_datawriter(
                       on_wire, fast::writer_qos(spec, entities.profile, type->most_bytes()), nullptr,
                       dds::StatusMask::none()),
                   "a writer of " + topic.name);
  }
  ~FastPublisher() override { entities_.publisher->delete_datawriter(writer_); }

  bool publish(const M& message) noexcept override try {
    return fast::written(
        writer_->write(const_cast<M*>(&message)));  // the vendor's interface has no const; it reads
  } catch (const std::exception&) {
    return false;
  }

 private:
  fast::Entities& entities_;
  dds::DataWriter* writer_ = nullptr;
};

template <class M>
class FastSubscription final : public Subscription, private dds::DataReaderListener {
 public:
  FastSubscription(fast::Entities& entities, const TopicName& topic, std::function<void(const M&)> take)
      : entities_(entities), take_(std::move(take)) {
    const transport::TopicSpec spec = spec_of(topic);
    auto* on_wire = entities.topic(spec, dds::TypeSupport(new FastType<M>));
    reader_ = made(entities.subscriber->create_datareader(on_wire, fast::reader_qos(spec), this,
                                                          dds::StatusMask::data_available()),
                   "a reader of " + topic.name);
  }
  ~FastSubscription() override {
    reader_->set_listener(nullptr);
    arrivals_.close();
    entities_.subscriber->delete_datareader(reader_);
  }

 private:
  void on_data_available(dds::DataReader* reader) override {
    arrivals_.announce([&] { take_all(*reader); });
  }

  void take_all(dds::DataReader& reader) {
    M message{};
    dds::SampleInfo info;
    while (reader.take_next_sample(&message, &info) == fast::kOk)
      if (info.valid_data) take_(message);
    dds_sample_free(&message, &descriptor<M>(), DDS_FREE_CONTENTS);
  }

  fast::Entities& entities_;
  std::function<void(const M&)> take_;
  transport::Arrivals arrivals_;
  dds::DataReader* reader_ = nullptr;
};

class FastPort final : public RosPort {
 public:
  explicit FastPort(const transport::BusOptions& options) : entities_(options) {}

 private:
#define OMENTUM_MAKES_ENDS(M, name)                                                                   \
  std::unique_ptr<Publisher<ros::M>> make_publisher(const TopicName& topic, ros::M*) override {       \
    return std::make_unique<FastPublisher<ros::M>>(entities_, topic);                                 \
  }                                                                                                   \
  std::unique_ptr<Subscription> make_subscription(const TopicName& topic,                             \
                                                  std::function<void(const ros::M&)> take) override { \
    return std::make_unique<FastSubscription<ros::M>>(entities_, topic, std::move(take));             \
  }
  OMENTUM_FOR_EACH_ROS(OMENTUM_MAKES_ENDS)
#undef OMENTUM_MAKES_ENDS

  fast::Entities entities_;
};

}  // namespace

std::unique_ptr<RosPort> open_fast_port(const transport::BusOptions& options) {
  return std::make_unique<FastPort>(options);
}

}  // namespace omentum::ros
