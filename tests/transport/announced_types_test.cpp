// Recorders and spies have no definition of our messages: what writers announce must do.
#include "tests/transport/fill.h"
#include "tests/transport/peer_process.h"
#include "transport/topics.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <limits>
#include <map>
#include <sstream>

namespace omentum::transport {
namespace {

/// A message as transport/spy/type_spy.cpp prints it.
class Told {
 public:
  template <class M>
  static std::string whole(const M& message) {
    Told told;
    told.add("", message);
    return told.text_;
  }

 private:
  template <class T>
  void add(const std::string& name, const T& value) {
    if constexpr (std::is_same_v<T, bool>) {
      line(name, value ? "true" : "false");
    } else if constexpr (std::is_integral_v<T>) {
      line(name, std::to_string(value));
    } else if constexpr (std::is_floating_point_v<T>) {
      char digits[40];
      std::snprintf(digits, sizeof digits, "%.*g", std::numeric_limits<T>::max_digits10, value);
      line(name, digits);
    } else {
      for_each_field(value, [&](const msg::Field& field, const auto& member) {
        add(name + (name.empty() ? "" : ".") + field.name, member);
      });
    }
  }
  void add(const std::string& name, const std::string& text) { line(name, '"' + text + '"'); }
  template <class T>
  void add(const std::string& name, const std::vector<T>& values) {
    text_ += name + " has " + std::to_string(values.size()) + "\n";
    for (std::size_t i = 0; i < values.size(); ++i) add(name + "[" + std::to_string(i) + "]", values[i]);
  }
  void line(const std::string& name, const std::string& value) { text_ += name + " = " + value + "\n"; }

  std::string text_;
};

/// Runs the spy, and hands out what it printed of each topic.
class Spied {
 public:
  Spied(int domain, const std::vector<std::string>& topics)
      : spy_("transport_type_spy", [&] {
          std::vector<std::string> arguments{std::to_string(domain)};
          arguments.insert(arguments.end(), topics.begin(), topics.end());
          return arguments;
        }()) {
    EXPECT_EQ(spy_.wait(), 0) << spy_.messages();
    std::istringstream lines(spy_.output());
    std::string* text = nullptr;
    for (std::string line; std::getline(lines, line);) {
      if (line.starts_with("topic "))
        text = &text_of_[line.substr(6)];
      else if (text)
        *text += line + "\n";
    }
  }

  template <class M>
  void expect_known() const {
    const auto text = text_of_.find(kTopicSpec<M>.name);
    ASSERT_NE(text, text_of_.end()) << kTopicSpec<M>.name;
    const auto known = test::known_messages<M>();
    EXPECT_TRUE(std::ranges::any_of(known, [&](const M& m) { return Told::whole(m) == text->second; }))
        << kTopicSpec<M>.name << " was read as\n"
        << text->second;
  }

 private:
  test::Process spy_;
  std::map<std::string, std::string> text_of_;
};

template <class... M>
void expect_decoded(msg::TopicList<M...>, int domain) {
  const Spied spied(domain, {kTopicSpec<M>.name...});
  (spied.expect_known<M>(), ...);
}

TEST(AnnouncedTypes, WhoHasNoDefinitionReadsEachFieldOfCycloneWriters) {
  const int domain = test::domain_of_test();
  const test::PeerProcess peer("known", Vendor::kCyclone, domain);
  // structs in structs, texts, sequences of numbers, texts and structs
  expect_decoded(msg::TopicList<msg::ToolPose, msg::DeviceInfo, msg::Contact, msg::NodeStatus>{}, domain);
}

// Fast DDS 2 announces types in a way of its own; any reader on Cyclone tells the type for all
// (docs/topics.md).
TEST(AnnouncedTypes, AReaderOnCycloneTellsTheTypeOfWhatFastWrites) {
  const int domain = test::domain_of_test();
  const test::PeerProcess peer("known", Vendor::kFast, domain);
  const auto bus = Bus::open({.vendor = Vendor::kCyclone, .domain = domain, .name = "announced_types_test"});
  const auto poses = bus->reader<msg::ToolPose>([](const msg::ToolPose&) {});
  const auto infos = bus->reader<msg::DeviceInfo>([](const msg::DeviceInfo&) {});
  expect_decoded(msg::TopicList<msg::ToolPose, msg::DeviceInfo>{}, domain);
}

}  // namespace
}  // namespace omentum::transport
