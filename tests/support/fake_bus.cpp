#include "fake_bus.h"

namespace omentum::test {

class FakeParticipant final : public transport::Bus {
 public:
  explicit FakeParticipant(FakeBus& bus) : bus_(bus), number_(++bus.participants_) {}
  std::string warning() const override { return {}; }

 private:
#define OMENTUM_FAKE_ENDPOINTS(M)                                                                          \
  std::unique_ptr<transport::Writer<msg::M>> make_writer(msg::MessageTag<msg::M>) override {               \
    return std::make_unique<FakeWriter<msg::M>>(bus_.topic<msg::M>(), bus_.next_writer(number_));          \
  }                                                                                                        \
  std::unique_ptr<transport::Reader<msg::M>> make_reader(transport::ByWriter<msg::M> callbacks) override { \
    return std::make_unique<FakeReader<msg::M>>(bus_.topic<msg::M>(), std::move(callbacks));               \
  }
  OMENTUM_FOR_EACH_TOPIC(OMENTUM_FAKE_ENDPOINTS)
#undef OMENTUM_FAKE_ENDPOINTS

  FakeBus& bus_;
  std::uint8_t number_;
};

FakeBus::~FakeBus() {
  for (const std::string& line : left_over()) ADD_FAILURE() << line;
}

transport::OpenBus FakeBus::opener() {
  return [this] { return std::make_unique<FakeParticipant>(*this); };
}

std::vector<std::string> FakeBus::left_over() const {
  std::vector<std::string> lines;
  const auto add = [&](const std::vector<std::string>& more) {
    lines.insert(lines.end(), more.begin(), more.end());
  };
  std::apply([&](const auto&... topic) { (add(topic.left_over()), ...); }, topics_);
  return lines;
}

transport::WriterId FakeBus::next_writer(std::uint8_t participant) {
  transport::WriterId writer{participant};
  writer.back() = ++writers_;
  return writer;
}

}  // namespace omentum::test
