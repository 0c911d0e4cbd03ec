// How well an organ is cut along a planned line: the trainee's score (docs/score.md).
#pragma once

#include "deform_node/served_organ.h"
#include "geometry/surface.h"
#include "geometry/tetra_mesh.h"
#include "scene/scene.h"

#include <nlohmann/json_fwd.hpp>

#include <memory>
#include <vector>

namespace omentum::deform {

struct CutFigures {
  double way_m = 0;                       // of the blade through the organ
  double mean_m = 0, largest_m = 0;       // of the blade from the planned line on that way
  double outside_m3 = 0, removed_m3 = 0;  // of what is gone now: outside of the planned cut, and all of it
  double seconds = 0;  // from the first moment in which the blade met the organ to the last
};

/// The planned cut goes from the line into the organ, against its normals. The line is drawn on the organ at
/// rest and goes with the tissue; how far a blade is from it is the shortest distance between both, as they
/// are at that moment, weighted by the blade's way. Tissue lies outside where all of a tetrahedron is farther
/// from the planned cut at rest than the scene's line_width_m.
///
/// One thread; follow() and reset() allocate nothing.
class CutScore {
 public:
  /// `mesh` outlives this, and `surface` is its own. The line has two points or more.
  CutScore(const scene::ScoreSpec& score, const geometry::TetraMesh& mesh, const geometry::Surface& surface);

  /// After each step: what edges swept in it, the organ after it, the model's CutAccount::tools, and the time
  /// since the start, s. Strokes of tools that met the organ count.
  void follow(std::span<const CutStroke> strokes, const OrganView& organ, std::uint32_t tools,
              double now_s) noexcept;
  /// The organ is whole again, and nobody has cut yet.
  void reset() noexcept;

  CutFigures figures(const OrganView& organ) const;

 private:
  // of the line, every few millimetres
  struct Station {
    Vec3 rest, normal;
    NodeId node;  // it goes with it
  };

  double aside_m(const Vec3& a, const Vec3& b) const noexcept;
  bool lies_outside(geometry::TetId t, double width_m) const noexcept;

  const geometry::TetraMesh& mesh_;
  std::vector<Station> stations_;
  std::vector<Vec3> now_;      // [stations]
  std::vector<bool> outside_;  // [T]
  double way_m_ = 0, weighted_m2_ = 0, largest_m_ = 0;
  double first_s_ = -1, last_s_ = -1;
};

/// The score of a scene, of the organ with that index; null where it plans no cut.
struct ScoredCut {
  std::size_t organ = 0;
  std::unique_ptr<CutScore> score;
};
/// The organs' sources outlive it. Throws std::runtime_error "FILE: score.planned_line: ..." where the line
/// is not at the organ.
ScoredCut scored_cut(const scene::Scene& scene, const std::vector<ServedOrgan>& organs);

/// {"way_mm", "mean_mm", "largest_mm", "removed_cm3", "outside_cm3", "seconds"}
nlohmann::json to_json(const CutFigures& figures);

}  // namespace omentum::deform
