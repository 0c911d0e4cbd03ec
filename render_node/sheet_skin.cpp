#include "render_node/sheet_skin.h"

#include "geometry/precondition.h"

#include <algorithm>
#include <cmath>

namespace omentum::render {
namespace {

constexpr std::int32_t kColumnsWanted = 300;  // for 4 m of gut: folds look round
constexpr std::int32_t kMostSteps = 4;        // from column to column
constexpr std::int32_t kShadedColumns = 128;  // light from all around changes slowly

// What the difference of neighbours must be longer than to have a direction, m.
constexpr float kLeast_m = 1e-6f;

Vec3f ghost(const Vec3f& p0, const Vec3f& p1, const Vec3f& p2) {
  return geometry::ghost_before(p0.cast<double>(), p1.cast<double>(), p2.cast<double>()).cast<float>();
}

// Puts a ghost before and behind what stands between. Two points go straight on.
void add_ghosts(std::span<Vec3f> row) {
  const std::size_t n = row.size();
  row.front() = n > 4 ? ghost(row[1], row[2], row[3]) : Vec3f(2 * row[1] - row[2]);
  row.back() = n > 4 ? ghost(row[n - 2], row[n - 3], row[n - 4]) : Vec3f(2 * row[n - 2] - row[n - 3]);
}

}  // namespace

SheetSkin::SheetSkin(const geometry::GutShape& rest)
    : layout_(rest.layout),
      rows_(places(layout_.rows, kAcross)),
      columns_(places(layout_.columns, std::clamp(kColumnsWanted / layout_.columns, 1, kMostSteps))),
      half_m_(static_cast<float>(kDrawnThickness * rest.mesentery_thickness_m / 2)),
      along_(static_cast<std::size_t>(layout_.rows + 2) * columns_.size()),
      middle_(rows_.size() * columns_.size()),
      normals_(middle_.size(), Vec3f::UnitZ()),
      shares_(rest.positions.size(), 0.0f) {
  geometry::require(rest.positions.size() == static_cast<std::size_t>(layout_.mass_count()),
                    "as many places as masses");
  openness_.fill(std::vector<float>(rest.positions.size(), 1.0f));
  mesh_.vertices.resize(2 * middle_.size());
  lay_out_rest(rest.positions);
  make_triangles();
  make_rim();
  make_few_triangles();
  deform(rest.positions, FoldShade(rest.tube_radius_m));
}

std::vector<SheetSkin::Place> SheetSkin::places(std::int32_t masses, std::int32_t steps) {
  std::vector<Place> places;
  for (std::int32_t p = 0; p <= (masses - 1) * steps; ++p) {
    const std::int32_t before = std::min(p / steps, masses - 2);
    const double share = static_cast<double>(p - before * steps) / steps;
    places.push_back({before, static_cast<float>(share), geometry::cardinal_weights(share).cast<float>()});
  }
  return places;
}

Vec3f SheetSkin::blend(const Place& place, std::span<const Vec3f> ghosted) {
  const auto p = ghosted.subspan(static_cast<std::size_t>(place.before), 4);
  return place.weight[0] * p[0] + place.weight[1] * p[1] + place.weight[2] * p[2] + place.weight[3] * p[3];
}

void SheetSkin::lay_out_rest(std::span<const geometry::Vec3> rest) {
  std::vector<float> along(rest.size(), 0.0f), away(rest.size(), 0.0f);
  for (std::int32_t m = 0; m < layout_.mass_count(); ++m) {
    const std::int32_t row = m / layout_.columns, column = m % layout_.columns;
    if (column > 0) along[m] = along[m - 1] + static_cast<float>((rest[column] - rest[column - 1]).norm());
    if (row == 0) continue;
    const std::int32_t nearer = m - layout_.columns;
    away[m] = away[nearer] + static_cast<float>((rest[m] - rest[nearer]).norm());
  }
  for (std::size_t r = 0; r < rows_.size(); ++r) {
    for (std::size_t c = 0; c < columns_.size(); ++c) {
      const float s = between_masses(along, r, c), w = between_masses(away, r, c);
      mesh_.vertices[at(r, c)].rest = {s, w, half_m_};
      mesh_.vertices[middle_.size() + at(r, c)].rest = {s, w, -half_m_};
    }
  }
}

void SheetSkin::make_triangles() {
  const auto back = static_cast<std::uint32_t>(middle_.size());
  for (std::size_t r = 0; r + 1 < rows_.size(); ++r) {
    for (std::size_t c = 0; c + 1 < columns_.size(); ++c) {
      const auto i = static_cast<std::uint32_t>(at(r, c)), down = static_cast<std::uint32_t>(at(r + 1, c));
      for (const MeshTriangle& t : {MeshTriangle{i, i + 1, down + 1}, MeshTriangle{i, down + 1, down}}) {
        mesh_.triangles.push_back(t);
        mesh_.triangles.push_back({t[0] + back, t[2] + back, t[1] + back});
      }
    }
  }
}

// Between masses: as coarse as the tube's own pieces are then.
void SheetSkin::make_few_triangles() {
  const auto back = static_cast<std::uint32_t>(middle_.size());
  const auto across = static_cast<std::size_t>(kAcross), along = steps_along();
  for (std::size_t r = 0; r + across < rows_.size(); r += across) {
    for (std::size_t c = 0; c + along < columns_.size(); c += along) {
      const auto i = static_cast<std::uint32_t>(at(r, c)), j = static_cast<std::uint32_t>(at(r, c + along));
      const auto down = static_cast<std::uint32_t>(at(r + across, c)),
                 beyond = static_cast<std::uint32_t>(at(r + across, c + along));
      for (const MeshTriangle& t : {MeshTriangle{i, j, beyond}, MeshTriangle{i, beyond, down}}) {
        mesh_.few.push_back(t);
        mesh_.few.push_back({t[0] + back, t[2] + back, t[1] + back});
      }
    }
  }
}

// From face to face along the outline.
void SheetSkin::make_rim() {
  std::vector<std::size_t> outline;
  const std::size_t last_row = rows_.size() - 1, last_column = columns_.size() - 1;
  for (std::size_t c = 0; c < last_column; ++c) outline.push_back(at(0, c));
  for (std::size_t r = 0; r < last_row; ++r) outline.push_back(at(r, last_column));
  for (std::size_t c = last_column; c > 0; --c) outline.push_back(at(last_row, c));
  for (std::size_t r = last_row; r > 0; --r) outline.push_back(at(r, 0));
  for (std::size_t k = 0; k < outline.size(); ++k) {
    const auto i = static_cast<std::uint32_t>(outline[k]);
    const auto j = static_cast<std::uint32_t>(outline[(k + 1) % outline.size()]);
    const auto back = static_cast<std::uint32_t>(middle_.size());
    mesh_.triangles.push_back({j, i, i + back});
    mesh_.triangles.push_back({j, i + back, j + back});
  }
}

void SheetSkin::deform(std::span<const geometry::Vec3> masses, FoldShade loops) {
  geometry::require(masses.size() == shares_.size(), "as many masses as at rest");
  place_middle(masses);
  find_normals();
  take_normals_of_neighbours();
  shade(loops);
  write_faces();
}

void SheetSkin::place_middle(std::span<const geometry::Vec3> masses) {
  const auto masses_in_row = static_cast<std::size_t>(layout_.columns);
  const auto rows = static_cast<std::size_t>(layout_.rows);
  std::vector<Vec3f> row(masses_in_row + 2), column(rows + 2);
  for (std::size_t r = 0; r < rows; ++r) {
    for (std::size_t c = 0; c < masses_in_row; ++c) row[c + 1] = masses[r * masses_in_row + c].cast<float>();
    add_ghosts(row);
    for (std::size_t c = 0; c < columns_.size(); ++c) along_[at(r + 1, c)] = blend(columns_[c], row);
  }
  for (std::size_t c = 0; c < columns_.size(); ++c) {
    for (std::size_t r = 1; r <= rows; ++r) column[r] = along_[at(r, c)];
    add_ghosts(column);
    for (std::size_t r = 0; r < rows_.size(); ++r) middle_[at(r, c)] = blend(rows_[r], column);
  }
}

// Of the front. Where the sheet has no area a normal stays what it was.
void SheetSkin::find_normals() {
  const auto neighbour = [](std::size_t i, std::size_t count) {
    return std::pair{i > 0 ? i - 1 : i, std::min(i + 1, count - 1)};
  };
  for (std::size_t r = 0; r < rows_.size(); ++r) {
    const auto [above, below] = neighbour(r, rows_.size());
    for (std::size_t c = 0; c < columns_.size(); ++c) {
      const auto [left, right] = neighbour(c, columns_.size());
      const Vec3f area =
          (middle_[at(r, right)] - middle_[at(r, left)]).cross(middle_[at(below, c)] - middle_[at(above, c)]);
      const float size = area.norm();
      if (size > kLeast_m * kLeast_m) normals_[at(r, c)] = area / size;
    }
  }
}

// All of the first and of the last column is in one place.
void SheetSkin::take_normals_of_neighbours() {
  for (std::size_t r = 0; r < rows_.size(); ++r) {
    normals_[at(r, 0)] = normals_[at(r, 1)];
    normals_[at(r, columns_.size() - 1)] = normals_[at(r, columns_.size() - 2)];
  }
}

void SheetSkin::shade(FoldShade& loops) {
  const std::int32_t stride = std::max(1, layout_.columns / kShadedColumns);
  const auto per_column = static_cast<std::int32_t>(steps_along());
  for (std::int32_t row = 0; row < layout_.rows; ++row) {
    for (std::int32_t column = 0; column < layout_.columns; ++column) {
      const auto mass = static_cast<std::size_t>(row * layout_.columns + column);
      if (column % stride != 0) {
        for (auto& of_face : openness_) of_face[mass] = of_face[mass - 1];
        continue;
      }
      const std::size_t place = at(row * kAcross, column * per_column);
      loops.stand_at(middle_[place]);
      openness_[0][mass] = loops.openness(middle_[place], normals_[place]);
      openness_[1][mass] = loops.openness(middle_[place], -normals_[place]);
    }
  }
}

void SheetSkin::map(std::span<const float> shares) {
  geometry::require(shares.size() == shares_.size(), "a share for each mass");
  std::ranges::copy(shares, shares_.begin());
}

float SheetSkin::between_masses(std::span<const float> of_masses, std::size_t row, std::size_t column) const {
  const Place &r = rows_[row], &c = columns_[column];
  const auto above = static_cast<std::size_t>(r.before * layout_.columns + c.before);
  const std::size_t below = above + static_cast<std::size_t>(layout_.columns);
  return std::lerp(std::lerp(of_masses[above], of_masses[above + 1], c.share),
                   std::lerp(of_masses[below], of_masses[below + 1], c.share), r.share);
}

void SheetSkin::write_faces() {
  for (std::size_t r = 0; r < rows_.size(); ++r) {
    for (std::size_t c = 0; c < columns_.size(); ++c) {
      const std::size_t i = at(r, c);
      for (const std::size_t face : {0u, 1u}) {
        Vertex& vertex = mesh_.vertices[i + face * middle_.size()];
        vertex.normal = face == 0 ? normals_[i] : Vec3f(-normals_[i]);
        vertex.position = middle_[i] + half_m_ * vertex.normal;
        vertex.openness = between_masses(openness_[face], r, c);
        vertex.share = between_masses(shares_, r, c);
      }
    }
  }
}

}  // namespace omentum::render
