#include "organ/plausibility.h"

#include <algorithm>
#include <cstddef>
#include <cstdio>

namespace omentum::organ {

namespace {

using geometry::Vec3;

struct Range {
  double low, high;
  bool holds(double value) const { return value >= low && value <= high; }
};

// From a gland to a whole liver with room to spare, m.
constexpr Range kLength{0.01, 1};
// From brain and fat (hundreds of Pa) to cartilage and silicone, Pa.
constexpr Range kYoung{100, 1e8};
// From an inflated lung to bone, kg/m^3.
constexpr Range kDensity{100, 5000};
// Constant strains of tetrahedra that keep their volume leave no room to bend: they lock.
constexpr Range kPoisson{0, 0.495};

// What fills a ball of not quite two elements' width.
constexpr std::ptrdiff_t kFewTetrahedra = 20;

template <class... Values>
std::string text(const char* format, Values... values) {
  char line[240];
  std::snprintf(line, sizeof line, format, values...);
  return line;
}

// `where`: the region, or nothing.
void add_implausible(const std::string& where, const physics::Material& material,
                     std::vector<std::string>& found) {
  if (!kYoung.holds(material.young_pa)) {
    found.push_back(where +
                    text("Young's modulus is %g Pa; soft tissue has 100 Pa to 100 MPa (1 kPa is 1000)",
                         material.young_pa));
  }
  if (!kDensity.holds(material.density_kg_m3)) {
    found.push_back(where + text("the density is %g kg/m^3; tissue has 100 to 5000 (1 g/cm^3 is 1000)",
                                 material.density_kg_m3));
  }
  if (!kPoisson.holds(material.poisson)) {
    found.push_back(where +
                    text("Poisson's ratio is %g; expected 0 to 0.495 (above, linear tetrahedra lock and "
                         "the organ is too stiff; 0.45 to 0.49 is usual)",
                         material.poisson));
  }
}

}  // namespace

double longest_side(const geometry::TetraMesh& mesh) {
  Vec3 low = mesh.positions.front(), high = low;
  for (const Vec3& p : mesh.positions) low = low.cwiseMin(p), high = high.cwiseMax(p);
  return (high - low).maxCoeff();
}

std::string length_text(double metres) {
  return metres < 1 ? text("%.3g mm", 1000 * metres) : text("%.3g m", metres);
}

std::string extent_text(const geometry::TetraMesh& mesh) {
  Vec3 low = mesh.positions.front(), high = low;
  for (const Vec3& p : mesh.positions) low = low.cwiseMin(p), high = high.cwiseMax(p);
  return text("x %.6g .. %.6g, y %.6g .. %.6g, z %.6g .. %.6g m", low.x(), high.x(), low.y(), high.y(),
              low.z(), high.z());
}

std::vector<std::string> implausible(const geometry::TetraMesh& mesh, const physics::MaterialMap& material) {
  std::vector<std::string> found;
  const double length = longest_side(mesh);
  if (!kLength.holds(length)) {
    found.push_back("the organ is " + length_text(length) +
                    " long; organs are 10 mm to 1 m long (its scale may be " +
                    "another: 1 for a mesh in metres, 0.01 in centimetres, 0.001 in millimetres)");
  }
  add_implausible("", material.common, found);
  for (const physics::RegionMaterial& region : material.regions) {
    const std::string where = "region " + std::to_string(region.label) + ": ";
    const auto count = std::ranges::count(mesh.regions, region.label);
    if (count < kFewTetrahedra) {
      found.push_back(
          where + std::to_string(count) + (count == 1 ? " tetrahedron" : " tetrahedra") +
          "; expected 20 or more: with fewer it has their shape rather than its own (a finer mesh helps)");
    }
    add_implausible(where, region.material, found);
  }
  return found;
}

}  // namespace omentum::organ
