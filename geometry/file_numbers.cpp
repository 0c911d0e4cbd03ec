#include "geometry/file_numbers.h"

#include <algorithm>
#include <numeric>

namespace omentum::geometry {

FileNumbers::FileNumbers(std::span<const std::int64_t> own, std::size_t count, Numbering numbering)
    : own_(own), count_(count) {
  if (numbering == Numbering::kPosition || own.empty()) return;
  first_ = own.front();
  // by neighbours: no sum that could overflow
  for (std::size_t i = 1; i < own.size() && counted_; ++i)
    counted_ = own[i - 1] < own[i] && own[i - 1] + 1 == own[i];
  if (counted_) return;
  sorted_.resize(count);
  std::iota(sorted_.begin(), sorted_.end(), 0);
  std::ranges::stable_sort(sorted_, {}, [this](std::int32_t i) { return own_[static_cast<std::size_t>(i)]; });
}

std::optional<std::int32_t> FileNumbers::position_of(std::int64_t number) const {
  if (counted_) {
    if (count_ == 0 || number < first_ || number > of(count_ - 1)) return std::nullopt;
    return static_cast<std::int32_t>(number - first_);
  }
  const auto own_number = [this](std::int32_t i) { return own_[static_cast<std::size_t>(i)]; };
  const auto found = std::ranges::lower_bound(sorted_, number, {}, own_number);
  if (found == sorted_.end() || own_number(*found) != number) return std::nullopt;
  return *found;
}

std::string FileNumbers::range() const {
  if (counted_) return "from " + std::to_string(first_) + " to " + std::to_string(of(count_ - 1));
  const auto end = [this](std::int32_t i) { return std::to_string(own_[static_cast<std::size_t>(i)]); };
  return std::to_string(count_) + " from " + end(sorted_.front()) + " to " + end(sorted_.back());
}

}  // namespace omentum::geometry
