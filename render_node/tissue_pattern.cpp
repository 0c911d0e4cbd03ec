#include "render_node/tissue_pattern.h"

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

namespace omentum::render {
namespace {

constexpr int kCoarsestCells = 8;  // lattice cells along one side of the cube
constexpr std::array<float, 3> kOctaves{1.0f, 0.5f, 0.28f};

// Random unit gradients on a periodic lattice.
class Lattice {
 public:
  Lattice(int cells, unsigned seed)
      : cells_(cells), gradients_(static_cast<std::size_t>(cells * cells * cells)) {
    std::mt19937 random(seed);
    std::normal_distribution<float> normal;
    for (auto& g : gradients_) {
      g = {normal(random), normal(random), normal(random)};
      g.normalize();
    }
  }

  // At a point in units of cells.
  float noise(const Eigen::Vector3f& p) const {
    const Eigen::Vector3i cell = p.array().floor().cast<int>();
    const Eigen::Vector3f f = p - cell.cast<float>();
    const Eigen::Vector3f s = f.array().cube() * (f.array() * (f.array() * 6 - 15) + 10);
    float sum = 0;
    for (int corner = 0; corner < 8; ++corner) {
      const Eigen::Vector3i d(corner & 1, corner >> 1 & 1, corner >> 2);
      const Eigen::Vector3f df = d.cast<float>();
      const Eigen::Array3f weight = df.array() * s.array() + (1 - df.array()) * (1 - s.array());
      sum += weight.prod() * at(cell + d).dot(f - df);
    }
    return sum;
  }

 private:
  const Eigen::Vector3f& at(const Eigen::Vector3i& c) const {
    const auto wrap = [this](int i) { return i % cells_; };
    return gradients_[static_cast<std::size_t>((wrap(c.z()) * cells_ + wrap(c.y())) * cells_ + wrap(c.x()))];
  }

  int cells_;
  std::vector<Eigen::Vector3f> gradients_;
};

std::vector<float> noise_values(int side) {
  std::vector<float> values(static_cast<std::size_t>(side * side * side), 0.0f);
  for (unsigned octave = 0; octave < kOctaves.size(); ++octave) {
    const int cells = kCoarsestCells << octave;
    const Lattice lattice(cells, octave + 1);
    const float scale = static_cast<float>(cells) / static_cast<float>(side);
    std::size_t i = 0;
    for (int z = 0; z < side; ++z) {
      for (int y = 0; y < side; ++y) {
        for (int x = 0; x < side; ++x) {
          const Eigen::Vector3f p = (Eigen::Vector3f(x, y, z).array() + 0.5f) * scale;
          values[i++] += kOctaves[octave] * lattice.noise(p);
        }
      }
    }
  }
  return values;
}

std::uint8_t byte(float x) {
  return static_cast<std::uint8_t>(std::clamp(std::lround(255 * x), 0L, 255L));
}

}  // namespace

TissuePattern make_tissue_pattern(int side) {
  const std::vector<float> values = noise_values(side);
  const auto at = [&](int x, int y, int z) {
    const auto wrap = [side](int i) { return (i + side) % side; };
    return values[static_cast<std::size_t>((wrap(z) * side + wrap(y)) * side + wrap(x))];
  };
  const float highest = std::abs(*std::max_element(
      values.begin(), values.end(), [](float a, float b) { return std::abs(a) < std::abs(b); }));
  // neighbours differ by a small part of the range: 4 uses most of the byte and clips hardly any
  const float value_scale = 0.5f / highest, slope_scale = 4 * value_scale;

  TissuePattern pattern{side, {}};
  pattern.texels.reserve(4 * values.size());
  for (int z = 0; z < side; ++z) {
    for (int y = 0; y < side; ++y) {
      for (int x = 0; x < side; ++x) {
        pattern.texels.push_back(byte(0.5f + slope_scale * 0.5f * (at(x + 1, y, z) - at(x - 1, y, z))));
        pattern.texels.push_back(byte(0.5f + slope_scale * 0.5f * (at(x, y + 1, z) - at(x, y - 1, z))));
        pattern.texels.push_back(byte(0.5f + slope_scale * 0.5f * (at(x, y, z + 1) - at(x, y, z - 1))));
        pattern.texels.push_back(byte(0.5f + value_scale * at(x, y, z)));
      }
    }
  }
  return pattern;
}

}  // namespace omentum::render
