#include "render_node/tube_drawing.h"

#include "geometry/gut_skin.h"
#include "geometry/precondition.h"
#include "render_node/pallor.h"
#include "render_node/sheet_skin.h"
#include "render_node/tube_frames.h"
#include "render_node/tube_skin.h"

#include <algorithm>
#include <numbers>

namespace omentum::render {
namespace {

std::span<const geometry::Vec3> axis_of(const geometry::GutLayout& layout,
                                        std::span<const geometry::Vec3> masses) {
  return masses.first(static_cast<std::size_t>(layout.columns));
}

class TubeDrawing final : public OrganDrawing {
 public:
  TubeDrawing(const geometry::GutShape& rest, const Material& wall)
      : layout_(rest.layout),
        wall_(wall),
        masses_(rest.positions),
        tube_(axis_of(layout_, masses_), rest.tube_radius_m),
        sheet_(rest),
        swept_(axis_of(layout_, masses_), rest.tube_radius_m),
        touched_(rest),
        touched_places_(touched_.node_count()),
        sheet_pallor_(sheet_.mesh()) {
    sheet_.deform(masses_, tube_.shade());
  }

  // Of the mesentery its lowest place alone: the tube shades the ground, but nothing may lie below it.
  Outline outline() const override;
  bool wanders() const override { return true; }
  void deform(std::span<const float> values) override;
  [[nodiscard]] bool map(std::span<const float> shares) override;
  bool live(std::span<const NodeForce> forces, double dt_s) override;
  const MeshData& mesh() const override;
  TubeFrames* tube() override { return &tube_; }
  Material material() const override { return wall_; }
  Look look() const override { return Look::kGut; }
  std::vector<OrganPart> parts() const override {
    return {{&sheet_.mesh(), Look::kMesentery, tissue_material("mesentery")}};
  }
  double length_m() const override { return tube_.length_m(); }

 private:
  geometry::GutLayout layout_;
  Material wall_;
  std::vector<geometry::Vec3> masses_;  // of the last state
  TubeFrames tube_;
  SheetSkin sheet_;
  // Of the last state once somebody asks: who looks at the wall without a picture does so once in a second.
  mutable TubeSkin swept_;
  mutable bool is_swept_ = true;
  geometry::GutSkin touched_;  // what tools' forces are told of
  std::vector<geometry::Vec3> touched_places_;
  Pallor sheet_pallor_;
  std::vector<Press> on_wall_, on_sheet_;  // workspace
};

const MeshData& TubeDrawing::mesh() const {
  if (!is_swept_) swept_.deform(axis_of(layout_, masses_));
  is_swept_ = true;
  return swept_.mesh();
}

bool TubeDrawing::live(std::span<const NodeForce> forces, double dt_s) {
  on_wall_.clear();
  on_sheet_.clear();
  if (!forces.empty()) touched_.place(masses_, touched_places_);
  const auto nodes = touched_.node_count();
  const std::size_t of_sheet = 2 * static_cast<std::size_t>(layout_.mass_count());  // the last ones
  for (const auto& [node, force_n] : forces) {
    if (node >= nodes) continue;
    const geometry::Vec3& place = touched_places_[node];
    const geometry::NodeId id(std::size_t{node});
    const geometry::Vec3 outward = place - geometry::weighted(touched_.node(id), masses_);
    const Press press = press_of(place.cast<float>(), outward.normalized().cast<float>(), force_n);
    (node + of_sheet < nodes ? on_wall_ : on_sheet_).push_back(press);
  }
  const bool wall = tube_.live(on_wall_, dt_s);
  return sheet_pallor_.advance(on_sheet_, dt_s, sheet_.vertices()) || wall;
}

Outline TubeDrawing::outline() const {
  Outline outline;
  for (const Vertex& vertex : mesh().vertices) {
    outline.points.push_back(vertex.position.cast<double>());
    outline.normals.push_back(vertex.normal);
  }
  const auto height = [](const Vertex& vertex) { return vertex.position.z(); };
  const Vertex lowest = *std::ranges::min_element(sheet_.mesh().vertices, {}, height);
  outline.points.push_back(lowest.position.cast<double>());
  outline.normals.push_back(Vec3f::Zero());
  outline.area_m2 = 2 * std::numbers::pi * swept_.radius_m() * tube_.length_m();
  return outline;
}

void TubeDrawing::deform(std::span<const float> values) {
  geometry::require(values.size() == 3 * masses_.size(), "three values for each mass");
  for (std::size_t m = 0; m < masses_.size(); ++m)
    masses_[m] = {values[3 * m], values[3 * m + 1], values[3 * m + 2]};
  is_swept_ = false;
  tube_.deform(axis_of(layout_, masses_));
  sheet_.deform(masses_, tube_.shade());
}

bool TubeDrawing::map(std::span<const float> shares) {
  tube_.map(shares.first(static_cast<std::size_t>(layout_.columns)));
  sheet_.map(shares);
  return true;
}

}  // namespace

std::unique_ptr<OrganDrawing> make_tube_drawing(const geometry::GutShape& rest, const Material& wall) {
  return std::make_unique<TubeDrawing>(rest, wall);
}

}  // namespace omentum::render
