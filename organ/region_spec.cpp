#include "organ/region_spec.h"

#include "geometry/boxes.h"
#include "organ/csv.h"
#include "organ/organ_check.h"
#include "organ/plausibility.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <optional>
#include <set>
#include <utility>

namespace omentum::organ {

namespace {

using geometry::TetraMesh;
using geometry::Vec3;

struct Spec {
  std::string whole;
  std::optional<std::int32_t> label;
  std::function<bool(const Vec3& centre)> holds;  // of a box or a ball
  physics::Material material;
};

[[noreturn]] void refuse(const Spec& spec, const std::string& what) {
  throw geometry::InputError("--region " + spec.whole + ": " + what);
}

std::string trimmed(const std::string& text) {
  const std::size_t first = text.find_first_not_of(" \t"), last = text.find_last_not_of(" \t");
  return first == std::string::npos ? "" : text.substr(first, last - first + 1);
}

std::vector<double> numbers_of(const Spec& spec, const std::string& key, const std::string& value,
                               std::size_t count, const char* expected) {
  const auto numbers = parse_numbers(value);
  if (!numbers || numbers->size() != count)
    refuse(spec, "found " + key + "=" + value + "; expected " + expected);
  return *numbers;
}

void set_label(const std::string& value, Spec& spec) {
  const auto label = parse_integer(value);
  if (!label || !std::in_range<std::int32_t>(*label))
    refuse(spec, "found label=" + value + "; expected a whole number that the mesh file gives tetrahedra");
  spec.label = static_cast<std::int32_t>(*label);
}

void set_box(const std::string& value, Spec& spec) {
  const auto corners = numbers_of(spec, "box", value, 6, "box=x0,y0,z0,x1,y1,z1 (metres)");
  const Vec3 a(corners.data()), b(corners.data() + 3);
  spec.holds = [a, b](const Vec3& p) { return geometry::in_box(p, a, b); };
}

void set_ball(const std::string& value, Spec& spec) {
  constexpr const char* kExpected = "ball=x,y,z,r with a radius above 0 (metres)";
  const auto numbers = numbers_of(spec, "ball", value, 4, kExpected);
  const Vec3 middle(numbers.data());
  const double radius = numbers[3];
  if (!(radius > 0)) refuse(spec, "found ball=" + value + "; expected " + kExpected);
  spec.holds = [middle, radius](const Vec3& p) { return (p - middle).norm() <= radius; };
}

void set(const std::string& key, const std::string& value, Spec& spec) {
  if (key == "label") return set_label(value, spec);
  if (key == "box") return set_box(value, spec);
  if (key == "ball") return set_ball(value, spec);
  physics::Material& m = spec.material;
  double* const number = key == "young"     ? &m.young_pa
                         : key == "poisson" ? &m.poisson
                         : key == "density" ? &m.density_kg_m3
                                            : nullptr;
  if (number == nullptr)
    refuse(spec, "found '" + key + "'; expected label, box, ball, young, poisson or density");
  *number = numbers_of(spec, key, value, 1, "a number").front();
}

Spec parse(const std::string& text, const physics::Material& organ) {
  Spec spec{text, {}, {}, organ};
  std::set<std::string> keys;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(';', begin), text.size());
    const std::string part = trimmed(text.substr(begin, end - begin));
    const std::size_t equals = part.find('=');
    if (equals == std::string::npos)
      refuse(spec, "found '" + part +
                       "'; expected KEY=VALUE between semicolons, such as ball=0,0,0.02,0.01; young=30000");
    const std::string key = trimmed(part.substr(0, equals));
    if (!keys.insert(key).second) refuse(spec, "gives " + key + " twice; expected it once");
    set(key, trimmed(part.substr(equals + 1)), spec);
    begin = end + 1;
  }
  const std::size_t places = keys.count("label") + keys.count("box") + keys.count("ball");
  if (places != 1)
    refuse(spec, "gives " + std::to_string(places) + " places; expected one of label, box and ball");
  if (keys.size() == 1) refuse(spec, "gives no material of its own; expected young, poisson or density");
  require_materials(spec.material, "--region " + text + ": ");
  return spec;
}

class Regions {
 public:
  Regions(std::vector<Spec> specs, TetraMesh& mesh)
      : specs_(std::move(specs)), mesh_(mesh), last_(mesh.tetrahedra.size(), kNone) {
    if (mesh_.regions.empty()) mesh_.regions.assign(mesh_.tetrahedra.size(), 0);
  }

  std::vector<physics::RegionMaterial> assign(bool labelled) {
    for (std::size_t i = 0; i < specs_.size(); ++i) claim(i, labelled);
    std::vector<physics::RegionMaterial> regions;
    std::int32_t highest = std::max(0, *std::ranges::max_element(mesh_.regions));
    for (std::size_t i = 0; i < specs_.size(); ++i) {
      if (!specs_[i].label) specs_[i].label = next(highest, specs_[i]);
      regions.push_back({*specs_[i].label, specs_[i].material});
      if (std::ranges::count(last_, i) == 0)
        refuse(specs_[i], "all of its tetrahedra are those of later regions");
    }
    for (std::size_t t = 0; t < last_.size(); ++t) {
      if (last_[t] != kNone) mesh_.regions[t] = *specs_[last_[t]].label;
    }
    std::ranges::sort(regions, {}, &physics::RegionMaterial::label);
    return regions;
  }

 private:
  static constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();

  static std::int32_t next(std::int32_t& highest, const Spec& spec) {
    if (highest == std::numeric_limits<std::int32_t>::max())
      refuse(spec, "no label is left above the mesh's, which go to 2^31 - 1");
    return ++highest;
  }

  void claim(std::size_t i, bool labelled) {
    const Spec& spec = specs_[i];
    if (spec.label) require_label(i, labelled);
    bool any = false;
    for (std::size_t t = 0; t < last_.size(); ++t) {
      if (!(spec.label ? mesh_.regions[t] == *spec.label : spec.holds(centre(t)))) continue;
      last_[t] = i;
      any = true;
    }
    if (any) return;
    refuse(spec, spec.label
                     ? "names no tetrahedron; the mesh has the labels " + labels_text()
                     : "no tetrahedron has its centre there; the mesh extends over " + extent_text(mesh_));
  }

  void require_label(std::size_t i, bool labelled) const {
    if (!labelled) {
      refuse(specs_[i], "the mesh file gives its tetrahedra no labels" +
                            (mesh_.why_no_regions.empty() ? "" : ": " + mesh_.why_no_regions));
    }
    for (std::size_t j = 0; j < i; ++j) {
      if (specs_[j].label == specs_[i].label)
        refuse(specs_[i], "names the label of --region " + specs_[j].whole + "; expected each once");
    }
  }

  std::string labels_text() const {
    constexpr std::size_t kNamed = 10;
    const std::set<std::int32_t> labels(mesh_.regions.begin(), mesh_.regions.end());
    std::string text;
    std::size_t named = 0;
    for (const std::int32_t label : labels) {
      if (named == kNamed) return text + " and " + std::to_string(labels.size() - kNamed) + " more";
      text += (named++ == 0 ? "" : ", ") + std::to_string(label);
    }
    return text;
  }

  Vec3 centre(std::size_t t) const {
    const geometry::Tetrahedron& v = mesh_.tetrahedra[t];
    return (mesh_.positions[v[0]] + mesh_.positions[v[1]] + mesh_.positions[v[2]] + mesh_.positions[v[3]]) /
           4;
  }

  std::vector<Spec> specs_;
  TetraMesh& mesh_;
  std::vector<std::size_t> last_;  // [T] which SPEC named it last
};

}  // namespace

physics::MaterialMap parse_regions(std::span<const std::string> specs, const physics::Material& organ,
                                   geometry::TetraMesh& mesh) {
  if (specs.empty()) return organ;
  std::vector<Spec> parsed;
  for (const std::string& text : specs) parsed.push_back(parse(text, organ));
  const bool labelled = !mesh.regions.empty();
  return {organ, Regions(std::move(parsed), mesh).assign(labelled)};
}

}  // namespace omentum::organ
