#include "runtime/histogram.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace omentum::runtime {
namespace {

constexpr int kBins = 64;    // an octave
constexpr int kBinBits = 6;  // log2(kBins)

// Below 64 ns a bin is 1 ns wide; above, an octave [2^e, 2^(e+1)) has 64 equal bins.
int bin_of(std::uint64_t ns) {
  if (ns < kBins) return static_cast<int>(ns);
  const int octave = std::bit_width(ns) - 1;
  const int shift = octave - kBinBits;
  return (shift + 1) * kBins + static_cast<int>((ns >> shift) - kBins);
}

}  // namespace

void Histogram::add_ns(std::int64_t duration_ns) noexcept {
  const std::int64_t ns = std::max<std::int64_t>(duration_ns, 0);
  Bin& bin = bins_[std::min(bin_of(static_cast<std::uint64_t>(ns)), static_cast<int>(bins_.size()) - 1)];
  bin.mean_ns += (static_cast<float>(ns) - bin.mean_ns) / static_cast<float>(++bin.count);
  ++count_;
  max_ns_ = std::max(max_ns_, ns);
}

double Histogram::percentile_us(double fraction) const {
  if (count_ == 0) return 0;
  const auto rank = std::clamp<std::uint64_t>(
      static_cast<std::uint64_t>(std::ceil(fraction * static_cast<double>(count_))), 1, count_);
  std::uint64_t below = 0;
  for (const Bin& bin : bins_) {
    below += bin.count;
    if (below >= rank) return 1e-3 * std::min<double>(bin.mean_ns, static_cast<double>(max_ns_));
  }
  return 1e-3 * static_cast<double>(max_ns_);
}

Percentiles Histogram::percentiles() const {
  return {percentile_us(0.5), percentile_us(0.99), percentile_us(0.999), 1e-3 * static_cast<double>(max_ns_),
          count_};
}

void Histogram::clear() noexcept {
  *this = Histogram{};
}

}  // namespace omentum::runtime
