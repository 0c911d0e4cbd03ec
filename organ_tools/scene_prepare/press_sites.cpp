#include "organ_tools/scene_prepare/press_sites.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace omentum::scene_prepare {

namespace {

/// "Flat" is judged over this radius: an instrument's tip and the dent around it, m.
constexpr double kFlatRadius_m = 0.02;
/// Lengths above are meant for an organ of a liver's size; a smaller one is judged over smaller ones, m.
constexpr double kLiverDiagonal_m = 0.2;
/// A slide may come this near to a support, as a part of the largest distance from the supports.
constexpr double kSupportShare = 0.3;
/// Two hands press at least this far apart, as a part of the organ's diagonal: a hand's width on a liver.
constexpr double kApartShare = 0.25;
/// Below this part of the diagonal no distance is asked for any more.
constexpr double kLeastApartShare = 0.01;
/// Supports count as "above" when their direction from the centre is steeper than this (cosine).
constexpr double kSupportsAbove = 0.5;
/// Examined places lie at least this far apart, as a part of the organ's diagonal.
constexpr double kSpacingShare = 0.02;
/// How many of the places that look best at a glance are examined.
constexpr std::size_t kExamined = 400;
constexpr int kDirections = 16;
constexpr int kStepsAlong = 6;

struct Candidate {
  SurfaceId node;
  double score;
};

/// Where the hands come from.
Vec3 open_side(const OrganSkin& skin) {
  const Vec3 away = skin.centre() - skin.support_centre();
  if (away.norm() < 1e-9 || away.normalized().z() > -kSupportsAbove) return Vec3::UnitZ();
  return away.normalized();
}

class SiteSearch {
 public:
  explicit SiteSearch(const OrganSkin& skin)
      : skin_(skin), scale_(std::min(1.0, skin.diagonal() / kLiverDiagonal_m)), open_(open_side(skin)) {
    for (std::int32_t s = 0; s < skin.node_count(); ++s)
      farthest_ = std::max(farthest_, skin.support_distance(SurfaceId(s)));
    rank_nodes();
  }

  PressSite best(double slide_m, const std::vector<PressSite>& taken) const {
    // the last time without a distance: on an organ with one free place two hands share it
    for (double apart = kApartShare * skin_.diagonal();;
         apart = apart > kLeastApartShare * skin_.diagonal() ? apart / 2 : 0) {
      PressSite best{};
      double best_score = -1;
      for (const Candidate& candidate : candidates_) {
        if (near_any(skin_.position(candidate.node), taken, apart)) continue;
        // no direction can raise a node above its own flatness
        if (candidate.score <= best_score) break;
        PressSite site{skin_.position(candidate.node), skin_.normal(candidate.node), Vec3::UnitX()};
        const double score = candidate.score * best_direction(candidate.node, slide_m, site.slide);
        if (score > best_score) {
          best_score = score;
          best = site;
        }
      }
      if (best_score >= 0) return best;
    }
  }

 private:
  /// Nodes by what a glance tells: facing the hands, away from the supports; then flatness.
  void rank_nodes() {
    for (std::int32_t i = 0; i < skin_.node_count(); ++i) {
      const SurfaceId s(i);
      if (!skin_.mobile(s)) continue;
      const double facing = 0.5 + 0.5 * skin_.normal(s).dot(open_);
      candidates_.push_back({s, facing * facing * std::sqrt(share_of_farthest(s))});
    }
    if (candidates_.empty())
      throw geometry::InputError("no surface node is free to move; expected an organ with fewer supports");
    sort();
    thin_out();
    for (Candidate& c : candidates_) c.score *= flatness(c.node);
    sort();
  }

  /// Keeps the best of every neighbourhood, so that a fine mesh is examined all over and not in one spot.
  void thin_out() {
    std::vector<Candidate> kept;
    for (const Candidate& c : candidates_) {
      const auto close = [&](const Candidate& k) {
        return (skin_.position(k.node) - skin_.position(c.node)).norm() < kSpacingShare * skin_.diagonal();
      };
      if (std::none_of(kept.begin(), kept.end(), close)) kept.push_back(c);
      if (kept.size() == kExamined) break;
    }
    candidates_ = std::move(kept);
  }

  void sort() {
    std::stable_sort(candidates_.begin(), candidates_.end(),
                     [](const Candidate& a, const Candidate& b) { return a.score > b.score; });
  }

  /// 1 on a plane, 0 where the surface turns by a right angle or more nearby.
  double flatness(SurfaceId s) const {
    double least = 1;
    for (const SurfaceId n : skin_.patch(s, kFlatRadius_m * scale_))
      least = std::min(least, skin_.normal(n).dot(skin_.normal(s)));
    return std::max(0.0, least);
  }

  /// The direction along which the surface stays under the instrument longest: its quality in [0,1].
  double best_direction(SurfaceId s, double slide_m, Vec3& direction) const {
    const auto patch = skin_.patch(s, slide_m * 1.5 + kFlatRadius_m * scale_);
    const Vec3 n = skin_.normal(s);
    const Vec3 first = n.unitOrthogonal();
    double best = -1;
    for (int i = 0; i < kDirections; ++i) {
      const double angle = 2 * std::numbers::pi * i / kDirections;
      const Vec3 d = std::cos(angle) * first + std::sin(angle) * n.cross(first);
      const double quality = slide_quality(s, d, slide_m, patch);
      if (quality <= best) continue;
      best = quality;
      direction = d;
    }
    return best;
  }

  double slide_quality(SurfaceId s, const Vec3& d, double slide_m,
                       const std::vector<SurfaceId>& patch) const {
    double quality = 1;
    for (int i = 1; i <= kStepsAlong; ++i) {
      // a little farther than the slide, so that it does not end on an edge
      const Vec3 target = skin_.position(s) + d * (slide_m * 1.2 * i / kStepsAlong);
      const SkinPoint below = skin_.closest(target, patch);
      const double turned = std::max(0.0, below.normal.dot(skin_.normal(s)));
      const double lifted = std::max(0.0, 1 - (target - below.position).norm() / (slide_m + 1e-6));
      quality = std::min(quality, turned * lifted * support_room(below, patch));
    }
    return quality;
  }

  /// 1 well away from the supports, falling to 0 at them.
  double support_room(const SkinPoint& at, const std::vector<SurfaceId>& patch) const {
    const auto nearest = *std::min_element(patch.begin(), patch.end(), [&](SurfaceId a, SurfaceId b) {
      return (skin_.position(a) - at.position).squaredNorm() <
             (skin_.position(b) - at.position).squaredNorm();
    });
    return std::min(1.0, share_of_farthest(nearest) / kSupportShare);
  }

  /// Distance from the supports, as a part of the largest one; 1 where every node is one (rollers all over).
  double share_of_farthest(SurfaceId s) const {
    return farthest_ > 0 ? skin_.support_distance(s) / farthest_ : 1;
  }

  static bool near_any(const Vec3& p, const std::vector<PressSite>& taken, double distance) {
    return std::any_of(taken.begin(), taken.end(),
                       [&](const PressSite& site) { return (site.point - p).norm() < distance; });
  }

  const OrganSkin& skin_;
  double scale_;
  Vec3 open_;
  double farthest_ = 0;
  std::vector<Candidate> candidates_;
};

}  // namespace

std::vector<PressSite> choose_press_sites(const OrganSkin& skin, const std::vector<double>& slides_m) {
  const SiteSearch search(skin);
  std::vector<PressSite> sites;
  sites.reserve(slides_m.size());
  for (const double slide_m : slides_m) sites.push_back(search.best(slide_m, sites));
  return sites;
}

}  // namespace omentum::scene_prepare
