#include "render_node/organ_skin.h"

#include "geometry/precondition.h"

#include <Eigen/Geometry>

#include <algorithm>

namespace omentum::render {
namespace {

constexpr float kHorizon_m = 0.018f;  // the width of a dent that a tool presses into soft tissue

std::vector<geometry::Triangle> both(std::vector<geometry::Triangle> skin,
                                     std::span<const geometry::Triangle> lining) {
  skin.insert(skin.end(), lining.begin(), lining.end());
  return skin;
}

}  // namespace

OrganSkin::OrganSkin(const geometry::Surface& surface, std::span<const geometry::Vec3> rest,
                     std::span<const geometry::Triangle> lining)
    : skin_count_(surface.triangles.size()),
      triangles_(both(surface.triangles, lining)),
      left_(surface.triangles),
      closed_(surface.triangles),
      gone_(triangles_.size(), 0),
      used_(rest.size(), kSkin),
      normals_(rest.size(), Vec3f::UnitZ()),
      openness_(rest.size(), 1.0f),
      level_(refinement_level(triangles_.size())),
      refinement_(triangles_, static_cast<std::int32_t>(rest.size()), level_),
      pallor_(mesh_),
      bared_pallor_(mesh_) {
  Eigen::AlignedBox3d box;
  for (const auto& p : rest) {
    rest_.push_back(p.cast<float>());
    box.extend(p);
  }
  extent_m_ = box.isEmpty() ? 0 : box.sizes().maxCoeff();
  positions_ = rest_;

  mesh_.triangles = refinement_.triangles();
  mesh_.split = level_;
  mesh_.vertices.resize(refinement_.vertex_count());
  net_ = ShadingNet(left_, rest_, kHorizon_m);
  net_.find_normals(rest_, normals_);
  rest_normals_ = normals_;
  std::vector<Vec3f> refined_rest(mesh_.vertices.size());
  refinement_.curve(rest_, normals_, refined_rest);
  for (std::size_t i = 0; i < refined_rest.size(); ++i) mesh_.vertices[i].rest = refined_rest[i];
  pallor_ = Pallor(mesh_);
  deform(std::vector<float>(3 * rest_.size(), 0.0f));
}

void OrganSkin::cut(const CutShape& shape) {
  geometry::require(shape.gone.size() == triangles_.size(), "a cut of this organ");
  take_away(shape.gone);
  closed_ = left_;
  closed_.insert(closed_.end(), shape.bared.begin(), shape.bared.end());
  set_nodes(shape);
  bared_ = BaredSkin(shape.bared, rest_, std::min(level_, refinement_level(closed_.size())));
  refinement_.spread(shape.burnt, &Vertex::charring, mesh_.vertices);
  bared_.spread(shape.burnt, &Vertex::charring);
  pallor_ = Pallor(mesh_);
  bared_pallor_ = Pallor(bared_.mesh());
  bleeding_.cut(shape, closed_, left_.size(), rest_);
}

void OrganSkin::take_away(const std::vector<std::uint8_t>& gone) {
  const auto small = static_cast<std::size_t>(level_ * level_);
  changed_.clear();
  left_.clear();
  for (std::size_t f = 0; f < gone.size(); ++f) {
    if (gone[f] == 0 && f < skin_count_) left_.push_back(triangles_[f]);
    if (gone[f] == gone_[f]) continue;
    for (std::size_t k = small * f; k < small * (f + 1); ++k)
      mesh_.triangles[k] = gone[f] != 0 ? MeshTriangle{} : refinement_.triangles()[k];
    if (!changed_.empty() && changed_.back().first + changed_.back().count == small * f) {
      changed_.back().count += small;
    } else {
      changed_.push_back({small * f, small});
    }
  }
  gone_ = gone;
}

void OrganSkin::set_nodes(const CutShape& shape) {
  rest_.clear();
  for (const geometry::Vec3& p : shape.rest) rest_.push_back(p.cast<float>());
  positions_ = rest_;
  normals_.assign(rest_.size(), Vec3f::UnitZ());
  openness_.assign(rest_.size(), 1.0f);
  used_.assign(rest_.size(), 0);
  for (const geometry::Triangle& t : closed_)
    for (const geometry::SurfaceId s : t) used_[static_cast<std::size_t>(s)] = kBare;
  for (const geometry::Triangle& t : left_)
    for (const geometry::SurfaceId s : t) used_[static_cast<std::size_t>(s)] = kSkin;
  closed_normals_.assign(rest_.size(), Vec3f::UnitZ());
  rest_normals_.resize(rest_.size(), Vec3f::UnitZ());
  net_ = ShadingNet(left_, rest_, kHorizon_m);
  closed_net_ = ShadingNet(closed_, rest_, kHorizon_m);
  closed_net_.find_normals(rest_, rest_normals_);
}

void OrganSkin::deform(std::span<const float> displacements) {
  geometry::require(displacements.size() == 3 * rest_.size(), "three values for each node");
  float largest_squared = 0;
  for (std::size_t s = 0; s < rest_.size(); ++s) {
    const Vec3f u(displacements[3 * s], displacements[3 * s + 1], displacements[3 * s + 2]);
    positions_[s] = rest_[s] + u;
    const float squared = used_[s] != 0 ? u.squaredNorm() : 0;
    largest_squared = std::max(largest_squared, squared);
  }
  largest_displacement_m_ = std::sqrt(largest_squared);
  drawn_ = positions_;
  bared_.relax(drawn_);
  net_.find_normals(drawn_, normals_);
  if (bared_.triangles().empty()) {
    net_.find_openness(drawn_, normals_, openness_);
  } else {
    closed_net_.find_normals(drawn_, closed_normals_);
    closed_net_.find_openness(drawn_, closed_normals_, openness_);
  }
  refinement_.apply(drawn_, normals_, openness_, mesh_.vertices);
  bared_.deform(drawn_, normals_, openness_);
  bleeding_.deform(drawn_, closed_normals_);
}

bool OrganSkin::live(std::span<const Press> on_skin, std::span<const Press> on_bared, double dt_s) {
  const bool skin = pallor_.advance(on_skin, dt_s, mesh_.vertices);
  const bool blood = bleeding_.run(dt_s);
  if (blood) bleeding_.deform(drawn_, closed_normals_);
  return bared_pallor_.advance(on_bared, dt_s, bared_.vertices()) || skin || blood;
}

void OrganSkin::map(std::span<const float> shares) {
  geometry::require(shares.size() == rest_.size(), "a share for each node");
  refinement_.spread(shares, &Vertex::share, mesh_.vertices);
  bared_.spread(shares, &Vertex::share);
}

}  // namespace omentum::render
