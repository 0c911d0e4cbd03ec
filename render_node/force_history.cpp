#include "render_node/force_history.h"

#include <algorithm>
#include <cmath>

namespace omentum::render {

void ForceHistory::add(double time_s, double force_n) {
  samples_.push_back({time_s, static_cast<float>(force_n), interrupted_});
  interrupted_ = false;
  const auto young = std::find_if(samples_.begin(), samples_.end(),
                                  [&](const Sample& sample) { return time_s - sample.time_s <= kSpan_s; });
  samples_.erase(samples_.begin(), young);
}

float ForceHistory::largest_n() const {
  float largest = 0;
  for (const Sample& sample : samples_) largest = std::max(largest, sample.force_n);
  return largest;
}

double force_axis_n(double largest_n) {
  const double decade = std::pow(10, std::floor(std::log10(std::max(largest_n, 1.0))));
  for (const double step : {1.0, 2.0, 5.0}) {
    if (largest_n <= step * decade) return step * decade;
  }
  return 10 * decade;
}

}  // namespace omentum::render
