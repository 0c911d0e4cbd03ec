// The first training score: how much of an organ behind others has been laid open.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <optional>

namespace omentum::render {

/// Shares of an organ that nothing hides, 0 to 1. Empty until it was seen once.
struct ExposureScore {
  std::optional<double> first, newest, largest;

  void add(double share);
};

/// The object of report.json: `first`, `newest`, `largest`; null where it was never seen.
nlohmann::json to_json(const ExposureScore& score);

}  // namespace omentum::render
