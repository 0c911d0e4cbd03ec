#include "ros_bridge/wire/ros_port.h"
#include "transport/arrivals.h"
#include "transport/cyclone/entities.h"

#include <dds/dds.h>

namespace omentum::ros {
namespace {

namespace cyclone = transport::cyclone;

template <class M>
class CyclonePublisher final : public Publisher<M> {
 public:
  CyclonePublisher(const cyclone::Entities& entities, const TopicName& topic) {
    const transport::TopicSpec spec = spec_of(topic);
    writer_ = cyclone::checked(dds_create_writer(entities.participant, entities.topic(spec, descriptor<M>()),
                                                 cyclone::writer_qos(spec).get(), nullptr),
                               "a writer of " + topic.name);
  }
  ~CyclonePublisher() override { dds_delete(writer_); }
  bool publish(const M& message) noexcept override { return dds_write(writer_, &message) == DDS_RETCODE_OK; }

 private:
  dds_entity_t writer_ = 0;
};

template <class M>
class CycloneSubscription final : public Subscription {
 public:
  CycloneSubscription(const cyclone::Entities& entities, const TopicName& topic,
                      std::function<void(const M&)> take)
      : take_(std::move(take)) {
    const transport::TopicSpec spec = spec_of(topic);
    const std::unique_ptr<dds_listener_t, void (*)(dds_listener_t*)> listener(dds_create_listener(this),
                                                                              dds_delete_listener);
    dds_lset_data_available(listener.get(), [](dds_entity_t reader, void* self) {
      auto& me = *static_cast<CycloneSubscription*>(self);
      me.arrivals_.announce([&] { me.take_all(reader); });
    });
    reader_ = cyclone::checked(dds_create_reader(entities.participant, entities.topic(spec, descriptor<M>()),
                                                 cyclone::reader_qos(spec).get(), listener.get()),
                               "a reader of " + topic.name);
  }
  ~CycloneSubscription() override {
    dds_set_listener(reader_, nullptr);
    arrivals_.close();
    dds_delete(reader_);
  }

 private:
  void take_all(dds_entity_t reader) {
    void* loan = nullptr;
    dds_sample_info_t info;
    while (dds_take(reader, &loan, &info, 1, 1) > 0) {
      if (info.valid_data) take_(*static_cast<const M*>(loan));
      dds_return_loan(reader, &loan, 1);
      loan = nullptr;
    }
  }

  std::function<void(const M&)> take_;
  transport::Arrivals arrivals_;
  dds_entity_t reader_ = 0;
};

class CyclonePort final : public RosPort {
 public:
  explicit CyclonePort(const transport::BusOptions& options) : entities_(options) {}

 private:
#define OMENTUM_MAKES_ENDS(M, name)                                                                   \
  std::unique_ptr<Publisher<ros::M>> make_publisher(const TopicName& topic, ros::M*) override {       \
    return std::make_unique<CyclonePublisher<ros::M>>(entities_, topic);                              \
  }                                                                                                   \
  std::unique_ptr<Subscription> make_subscription(const TopicName& topic,                             \
                                                  std::function<void(const ros::M&)> take) override { \
    return std::make_unique<CycloneSubscription<ros::M>>(entities_, topic, std::move(take));          \
  }
  OMENTUM_FOR_EACH_ROS(OMENTUM_MAKES_ENDS)
#undef OMENTUM_MAKES_ENDS

  cyclone::Entities entities_;
};

}  // namespace

std::unique_ptr<RosPort> open_cyclone_port(const transport::BusOptions& options) {
  return std::make_unique<CyclonePort>(options);
}

}  // namespace omentum::ros
