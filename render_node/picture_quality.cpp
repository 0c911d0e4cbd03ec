#include "render_node/picture_quality.h"

#include <algorithm>
#include <array>

namespace omentum::render {
namespace {

// Each about half as dear as the one before it on a processor (benchmarks/picture_bench). Light at the
// vertices goes with all pixels first: it costs less than the stretching.
constexpr std::array<QualityMeans, kQualityCount> kMeans{{
    {"fine", 4, 1.0f, Shading::kSoftShadows},
    {"plain", 0, 1.0f, Shading::kHardShadows},
    {"coarse", 0, 0.6f, Shading::kHardShadows},
    {"flat", 0, 0.5f, Shading::kNoShadows},
    {"draft", 0, 1.0f, Shading::kPerVertex},
    {"sketch", 0, 1.0f / 2, Shading::kPerVertex},
    {"faint", 0, 1.0f / 3, Shading::kPerVertex, true},
}};

}  // namespace

const QualityMeans& means_of(Quality quality) {
  return kMeans[static_cast<std::size_t>(quality)];
}

Size drawn_size(Quality quality, Size picture) {
  const auto scaled = [&](int side) {
    return std::max(1, static_cast<int>(means_of(quality).scale * static_cast<float>(side)));
  };
  return {scaled(picture.width), scaled(picture.height)};
}

}  // namespace omentum::render
