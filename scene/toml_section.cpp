#include "scene/toml_section.h"

#include "scene/scene_values.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace omentum::scene {
namespace {

constexpr double kUnitTolerance = 1e-3;  // three written digits of a direction

std::string as_written(const toml::node& node) {
  std::ostringstream out;
  node.visit([&](const auto& n) {
    if constexpr (toml::is_table<decltype(n)>) {
      out << "a table";
    } else {
      out << toml::toml_formatter{n};
    }
  });
  std::string text = out.str();
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

std::string number_words(double value) {
  std::ostringstream out;
  out << value;
  return out.str();
}

std::string join(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "\"" : ", \"") + word + "\"";
  return text;
}

}  // namespace

bool Range::holds(double value) const {
  return std::isfinite(value) && (above ? value > minimum : value >= minimum) &&
         (below ? value < maximum : value <= maximum);
}

std::string Range::words() const {
  std::string text = "a number";
  if (std::isfinite(minimum)) text += (above ? " above " : " of at least ") + number_words(minimum);
  if (std::isfinite(minimum) && std::isfinite(maximum)) text += " and";
  if (std::isfinite(maximum)) text += (below ? " below " : " of at most ") + number_words(maximum);
  return text;
}

TomlSection::TomlSection(std::shared_ptr<const toml::table> table, std::filesystem::path file,
                         std::string name)
    : table_(std::move(table)), file_(std::move(file)), name_(std::move(name)) {}

void TomlSection::read(const std::string& key, double& value, Need need, const Range& range) {
  const toml::node* node = find(key, need, range.words());
  if (node == nullptr) return;
  const auto number = node->is_number() ? node->value<double>() : std::nullopt;
  if (!number || !range.holds(*number)) refuse(key, as_written(*node), range.words());
  value = *number;
}

void TomlSection::read(const std::string& key, std::uint32_t& value, Need need, std::uint32_t maximum) {
  const std::string expected = "a whole number from 0 to " + std::to_string(maximum);
  const toml::node* node = find(key, need, expected);
  if (node == nullptr) return;
  const auto number = node->value_exact<std::int64_t>();
  if (!number || *number < 0 || *number > maximum) refuse(key, as_written(*node), expected);
  value = static_cast<std::uint32_t>(*number);
}

void TomlSection::read(const std::string& key, std::string& value, Need need) {
  const std::string expected = need == kRequired ? "a text in quotes, not empty" : "a text in quotes";
  const toml::node* node = find(key, need, expected);
  if (node == nullptr) return;
  const auto text = node->value_exact<std::string>();
  if (!text || (need == kRequired && text->empty())) refuse(key, as_written(*node), expected);
  value = *text;
}

void TomlSection::read(const std::string& key, Vec3& value, Need need) {
  if (const toml::node* node = find(key, need, "three numbers [x, y, z]")) value = triple(key, *node);
}

void TomlSection::read(const std::string& key, std::optional<Vec3>& value) {
  if (const toml::node* node = find(key, kOptional, "")) value = triple(key, *node);
}

void TomlSection::read(const std::string& key, std::optional<double>& value, const Range& range) {
  double number = 0;
  read(key, number, kOptional, range);
  if (has(key)) value = number;
}

void TomlSection::read(const std::string& key, std::optional<std::int32_t>& value) {
  const toml::node* node = find(key, kOptional, "");
  if (node == nullptr) return;
  const auto number = node->value_exact<std::int64_t>();
  if (!number || !std::in_range<std::int32_t>(*number)) refuse(key, as_written(*node), "a whole number");
  value = static_cast<std::int32_t>(*number);
}

void TomlSection::read(const std::string& key, std::vector<double>& value, std::size_t count) {
  const toml::node* node = find(key, kOptional, "");
  if (node != nullptr) value = numbers(key, *node, count, "a list of " + std::to_string(count) + " numbers");
}

void TomlSection::read(const std::string& key, std::vector<Vec3>& value, Need need) {
  const std::string expected = "a list of [x, y, z]";
  const toml::node* node = find(key, need, expected);
  if (node == nullptr) return;
  const toml::array* list = node->as_array();
  if (list == nullptr || list->empty()) refuse(key, as_written(*node), expected);
  value.clear();
  for (const toml::node& point : *list) {
    value.push_back(triple(key + "[" + std::to_string(value.size()) + "]", point));
  }
}

void TomlSection::read(const std::string& key, bool& value, Need need) {
  const std::string expected = "true or false";
  const toml::node* node = find(key, need, expected);
  if (node == nullptr) return;
  const auto truth = node->value_exact<bool>();
  if (!truth) refuse(key, as_written(*node), expected);
  value = *truth;
}

void TomlSection::read_word(const std::string& key, std::string& value, Need need,
                            const std::vector<std::string>& words) {
  const toml::node* node = find(key, need, "one of " + join(words));
  if (node == nullptr) return;
  const auto text = node->value_exact<std::string>();
  if (!text || std::find(words.begin(), words.end(), *text) == words.end()) {
    refuse(key, as_written(*node), "one of " + join(words));
  }
  value = *text;
}

void TomlSection::read_direction(const std::string& key, Vec3& value, Need need) {
  const toml::node* node = find(key, need, "a unit vector [x, y, z]");
  if (node == nullptr) return;
  value = triple(key, *node);
  const double length = value.norm();
  if (std::abs(length - 1) > kUnitTolerance) {
    refuse(key, as_written(*node) + " of length " + number_words(length), "a unit vector [x, y, z]");
  }
  value /= length;
}

TomlSection TomlSection::section(const std::string& key) {
  const toml::node* node = find(key, kOptional, "");
  if (node == nullptr) return {std::make_shared<const toml::table>(), file_, name_ + key + "."};
  if (!node->is_table()) refuse(key, as_written(*node), "a table [" + key + "]");
  return {{table_, node->as_table()}, file_, name_ + key + "."};
}

std::vector<TomlSection> TomlSection::sections(const std::string& key) {
  const std::string expected = "tables [[" + key + "]]";
  std::vector<TomlSection> sections;
  const toml::node* node = find(key, kOptional, expected);
  if (node == nullptr) return sections;
  if (!node->is_array_of_tables()) refuse(key, as_written(*node), expected);
  for (const toml::node& table : *node->as_array()) {
    const std::string name = name_ + key + "[" + std::to_string(sections.size()) + "].";
    sections.push_back({{table_, table.as_table()}, file_, name});
  }
  return sections;
}

void TomlSection::refuse_unknown_keys() const {
  for (const auto& [key, node] : *table_) {
    const std::string word(key.str());
    if (std::find(known_.begin(), known_.end(), word) != known_.end()) continue;
    refuse(word, "an unknown key", "one of " + join(known_));
  }
}

void TomlSection::refuse(const std::string& key, const std::string& found,
                         const std::string& expected) const {
  throw std::runtime_error(
      printable(place(key) + ": " + name_ + key + ": found " + found + ", expected " + expected));
}

std::string TomlSection::place(const std::string& key) const {
  const toml::node* node = table_->get(key.substr(0, key.find('[')));
  const auto line = node != nullptr ? node->source().begin.line : table_->source().begin.line;
  return file_.string() + ":" + std::to_string(std::max<std::uint32_t>(line, 1));
}

const toml::node* TomlSection::find(const std::string& key, Need need, const std::string& expected) {
  known_.push_back(key);
  const toml::node* node = table_->get(key);
  if (node == nullptr && need == kRequired) refuse(key, "nothing", expected);
  return node;
}

Vec3 TomlSection::triple(const std::string& key, const toml::node& node) const {
  const std::vector<double> values = numbers(key, node, 3, "three numbers [x, y, z]");
  return {values[0], values[1], values[2]};
}

std::vector<double> TomlSection::numbers(const std::string& key, const toml::node& node, std::size_t count,
                                         const std::string& expected) const {
  const toml::array* list = node.as_array();
  std::vector<double> values;
  for (std::size_t i = 0; list != nullptr && i < list->size(); ++i) {
    const toml::node& component = *list->get(i);
    if (component.is_number() && std::isfinite(*component.value<double>()))
      values.push_back(*component.value<double>());
  }
  if (list == nullptr || list->size() != count || values.size() != count)
    refuse(key, as_written(node), expected);
  return values;
}

TomlSection open_toml(const std::filesystem::path& file) {
  if (!std::filesystem::is_regular_file(file)) {
    throw std::runtime_error(file.string() + ": found no such file, expected a TOML file");
  }
  try {
    return {std::make_shared<const toml::table>(toml::parse_file(file.string())), file, ""};
  } catch (const toml::parse_error& e) {
    throw std::runtime_error(file.string() + ":" + std::to_string(e.source().begin.line) + ": " +
                             printable(e.description()));
  }
}

}  // namespace omentum::scene
