#include "scene/score_keys.h"

#include "scene/camera_score_keys.h"

#include <algorithm>

namespace omentum::scene {
namespace {

using enum TomlSection::Need;

// Less is finer than any mesh, more is no line any more.
constexpr Range kLineWidth{.minimum = 1e-3, .maximum = 0.05};
constexpr Range kPull_n{.minimum = 0, .maximum = 50, .above = true};
constexpr double kShortest_m = 1e-4;  // of a part of the line

const OrganSpec& organ_named(const std::string& key, const std::string& name,
                             const std::vector<OrganSpec>& organs, const TomlSection& s) {
  const auto found = std::ranges::find(organs, name, &OrganSpec::name);
  if (found == organs.end()) s.refuse(key, "\"" + name + "\"", "the name of one of the [[organs]]");
  return *found;
}

void read_line(TomlSection& s, const std::vector<OrganSpec>& organs, ScoreSpec& score) {
  s.read("planned_line", score.planned_line, kOptional);
  s.read("line_of", score.line_of, kOptional);
  s.read("line_width_m", score.line_width_m, kOptional, kLineWidth);
  if (!s.has("planned_line")) {
    for (const char* key : {"line_of", "line_width_m"})
      if (s.has(key)) s.refuse(key, "one without a line", "planned_line beside it");
    return;
  }
  const std::vector<Vec3>& line = score.planned_line;
  if (line.size() < 2) s.refuse("planned_line", std::to_string(line.size()) + " points", "two or more");
  for (std::size_t i = 1; i < line.size(); ++i)
    if ((line[i] - line[i - 1]).norm() < kShortest_m)
      s.refuse("planned_line",
               "points " + std::to_string(i - 1) + " and " + std::to_string(i) + " in one place",
               "points apart from each other");
  if (score.line_of.empty() && !organs.empty()) score.line_of = organs.front().name;
  if (organ_named("line_of", score.line_of, organs, s).kind != OrganKind::kTetrahedralMesh)
    s.refuse("line_of", "\"" + score.line_of + "\", which nothing cuts", "an organ with a mesh");
}

}  // namespace

ScoreSpec read_score(TomlSection s, const std::vector<OrganSpec>& organs,
                     const std::vector<ToolSpec>& tools) {
  ScoreSpec score;
  s.read("exposed_organ", score.exposed_organ, kOptional);
  s.read("from_s", score.from_s, kOptional, kNotNegative);
  s.read("pull_limit_n", score.pull_limit_n, kOptional, kPull_n);
  if (s.has("exposed_organ")) organ_named("exposed_organ", score.exposed_organ, organs, s);
  read_line(s, organs, score);
  score.camera = read_camera_score(s, organs, tools);
  s.refuse_unknown_keys();
  return score;
}

}  // namespace omentum::scene
