#include "geometry/region_labels.h"

#include <cctype>
#include <cmath>
#include <cstdlib>
#include <utility>

namespace omentum::geometry {

bool is_label_name(std::string_view name) {
  std::string letters;
  for (const char c : name) {
    if (std::isalnum(static_cast<unsigned char>(c)))
      letters += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  if (letters == "gmshphysical" || letters == "meditref" || letters == "cellentityids") return true;
  for (const std::string_view noun : {"label", "region", "material"}) {
    if (!letters.starts_with(noun)) continue;
    const std::string_view rest = std::string_view(letters).substr(noun.size());
    if (rest.empty() || rest == "s" || rest == "id" || rest == "ids") return true;
  }
  return false;
}

std::optional<std::int32_t> label_in(const std::string& word) {
  char* end = nullptr;
  const double value = std::strtod(word.c_str(), &end);
  if (word.empty() || *end != '\0' || value != std::trunc(value) || std::abs(value) > 2147483647.0)
    return std::nullopt;
  return static_cast<std::int32_t>(value);
}

std::int32_t checked_label(const FileCursor& in, std::int64_t value, const char* expected) {
  if (!std::in_range<std::int32_t>(value)) in.fail(std::to_string(value), expected);
  return static_cast<std::int32_t>(value);
}

void CellLabels::add(const std::string& name, const std::vector<std::int64_t>& values) {
  if (!name_.empty())
    return refuse("the arrays '" + name_ + "' and '" + name + "' both give labels, expected one");
  name_ = name;
  for (const std::int64_t value : values) {
    if (!std::in_range<std::int32_t>(value))
      return refuse("the label " + std::to_string(value) + " in array '" + name + "' has more than 32 bits");
    labels_.push_back(static_cast<std::int32_t>(value));
  }
}

void CellLabels::miss(const std::string& why) {
  if (name_.empty()) refuse(why);
}

void CellLabels::refuse(const std::string& why) {
  if (why_.empty()) why_ = why;
}

std::vector<std::int32_t> CellLabels::take(std::string& why) {
  if (why_.empty()) return std::move(labels_);
  why = why_;
  return {};
}

void settle_labels(RawMesh& mesh) {
  const auto is_none = [](std::int32_t label) { return label == 0; };
  if (!mesh.why_no_regions.empty() || std::ranges::all_of(mesh.regions, is_none)) mesh.regions.clear();
}

}  // namespace omentum::geometry
