#include "render_node/exposure_score.h"

#include <nlohmann/json.hpp>

#include <algorithm>

namespace omentum::render {

void ExposureScore::add(double share) {
  if (!first) first = share;
  newest = share;
  largest = std::max(largest.value_or(share), share);
}

nlohmann::json to_json(const ExposureScore& score) {
  const auto value = [](const std::optional<double>& x) { return x ? nlohmann::json(*x) : nlohmann::json(); };
  return {{"first", value(score.first)}, {"newest", value(score.newest)}, {"largest", value(score.largest)}};
}

}  // namespace omentum::render
