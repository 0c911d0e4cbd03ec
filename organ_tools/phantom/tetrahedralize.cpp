// CGAL's Mesh_3 is licensed under the GPL (version 3 or later) or commercially. It is confined to this file,
// and so to the program organ_phantom, an offline generator that no library and no node links; the meshes it
// writes are ours.
#include "organ_tools/phantom/tetrahedralize.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Labeled_mesh_domain_3.h>
#include <CGAL/Mesh_complex_3_in_triangulation_3.h>
#include <CGAL/Mesh_criteria_3.h>
#include <CGAL/Mesh_triangulation_3.h>
#include <CGAL/Random.h>
#include <CGAL/make_mesh_3.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

namespace omentum::phantom {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Domain = CGAL::Labeled_mesh_domain_3<Kernel>;
using Triangulation = CGAL::Mesh_triangulation_3<Domain>::type;
using Complex = CGAL::Mesh_complex_3_in_triangulation_3<Triangulation>;
using Criteria = CGAL::Mesh_criteria_3<Triangulation>;

// Quality that Delaunay refinement is proven to reach: facet angles of 25 degrees (30 is the limit), and
// tetrahedra whose circumradius is at most twice their shortest edge.
constexpr double kFacetAngleDegrees = 25;
constexpr double kRadiusEdgeRatio = 2;

// Nodes grow with the inverse cube of the edge length: a few steps of a root search suffice.
constexpr int kMostTries = 12;

Domain make_domain(const ImplicitShape& shape) {
  const Extent& extent = shape.extent;
  const auto distance = [of = shape.distance](const Kernel::Point_3& p) { return of({p.x(), p.y(), p.z()}); };
  const Kernel::Iso_cuboid_3 box(extent.low.x(), extent.low.y(), extent.low.z(), extent.high.x(),
                                 extent.high.y(), extent.high.z());
  return Domain::create_implicit_mesh_domain(distance, box);
}

geometry::RawMesh to_raw(const Complex& complex) {
  geometry::RawMesh raw;
  raw.source = "phantom";
  std::map<Triangulation::Vertex_handle, std::int32_t> number;
  for (auto cell = complex.cells_in_complex_begin(); cell != complex.cells_in_complex_end(); ++cell) {
    std::array<std::int32_t, 4> tetrahedron{};
    for (int i = 0; i < 4; ++i) {
      const auto [known, is_new] = number.emplace(cell->vertex(i), static_cast<std::int32_t>(number.size()));
      if (is_new) {
        const auto& p = cell->vertex(i)->point();
        raw.positions.emplace_back(p.x(), p.y(), p.z());
      }
      tetrahedron[static_cast<std::size_t>(i)] = known->second;
    }
    raw.tetrahedra.push_back(tetrahedron);
  }
  return raw;
}

geometry::RawMesh mesh_with_edges(const ImplicitShape& shape, double edge_m, const MeshSize& size) {
  namespace parameters = CGAL::parameters;
  CGAL::get_default_random() = CGAL::Random(0);
  const Domain domain = make_domain(shape);
  const Criteria criteria(parameters::facet_angle = kFacetAngleDegrees, parameters::facet_size = edge_m,
                          parameters::facet_distance = size.facet_distance * edge_m,
                          parameters::cell_radius_edge_ratio = kRadiusEdgeRatio,
                          parameters::cell_size = size.cell_size * edge_m);
  if (!size.without_slivers)
    return to_raw(CGAL::make_mesh_3<Complex>(domain, criteria, parameters::manifold(), parameters::no_odt(),
                                             parameters::no_lloyd(), parameters::no_perturb(),
                                             parameters::no_exude()));
  // sliver removal without a time limit, so that the result does not depend on the machine
  const Complex complex = CGAL::make_mesh_3<Complex>(
      domain, criteria, parameters::manifold(), parameters::no_odt(), parameters::no_lloyd(),
      parameters::perturb(parameters::time_limit = 0), parameters::exude(parameters::time_limit = 0));
  return to_raw(complex);
}

}  // namespace

MeshSize paper_size() {
  return {1500, 1800, 6500, 8000, 0.0077};
}

MeshSize fine_size() {
  return {16001, 19000, 75000, 105000, 0.0031};
}

MeshSize gallbladder_size() {
  return {700, 1000, 2500, 5000, 0.0042};
}

MeshSize colon_size() {
  return {1400, 1900, 4500, 9000, 0.0135};
}

MeshSize cavity_size() {
  return {2500, 6000, 5000, 40000, 0.028, 4, 0.04, false};
}

MeshSize omentum_size() {
  return {2000, 5000, 5000, 30000, 0.014, 2, 0.12, false};
}

MeshSize plate_size() {
  return {700, 820, 2000, 2450, 0.0105};
}

MeshSize cylinder_size() {
  return {238, 262, 840, 940, 0.0172, 0.7};
}

geometry::TetraMesh tetrahedralize(const ImplicitShape& shape, const MeshSize& size) {
  double edge_m = size.first_edge_m;
  const double wanted = 0.5 * static_cast<double>(size.fewest_nodes + size.most_nodes);
  std::string tried;
  for (int i = 0; i < kMostTries; ++i) {
    const geometry::RawMesh raw = mesh_with_edges(shape, edge_m, size);
    const std::size_t nodes = raw.positions.size(), tetrahedra = raw.tetrahedra.size();
    tried = std::to_string(nodes) + " nodes and " + std::to_string(tetrahedra) + " tetrahedra";
    const bool fits = nodes >= size.fewest_nodes && nodes <= size.most_nodes &&
                      tetrahedra >= size.fewest_tetrahedra && tetrahedra <= size.most_tetrahedra;
    try {
      geometry::TetraMesh mesh = geometry::check_mesh(raw, 1.0).mesh;
      if (fits) return mesh;
    } catch (const geometry::InputError& e) {
      tried += std::string(" (") + e.what() + ")";
    }
    // a little off the exact ratio, so that a mesh that fits in size but is not valid is not made again
    edge_m *= std::cbrt(static_cast<double>(nodes) / wanted) * (1 + 1e-3 * (i + 1));
  }
  throw std::runtime_error("phantom: found " + tried + " at last, expected a valid mesh of " +
                           std::to_string(size.fewest_nodes) + " to " + std::to_string(size.most_nodes) +
                           " nodes and " + std::to_string(size.fewest_tetrahedra) + " to " +
                           std::to_string(size.most_tetrahedra) + " tetrahedra");
}

double smallest_dihedral_angle(const geometry::TetraMesh& mesh) {
  double smallest = std::numbers::pi;
  for (const geometry::Tetrahedron& t : mesh.tetrahedra) {
    for (int i = 0; i < 4; ++i) {
      for (int j = i + 1; j < 4; ++j) {
        const int k = i == 0 ? (j == 1 ? 2 : 1) : 0, l = 6 - i - j - k;
        const Vec3 &a = mesh.positions[t[i]], along = (mesh.positions[t[j]] - a).normalized();
        const Vec3 u = (mesh.positions[t[k]] - a).cross(along), v = (mesh.positions[t[l]] - a).cross(along);
        smallest = std::min(smallest, std::atan2(u.cross(v).norm(), u.dot(v)));
      }
    }
  }
  return smallest * 180 / std::numbers::pi;
}

}  // namespace omentum::phantom
