// Tetrahedra inside an implicit shape. This pair of files alone uses CGAL.
#pragma once

#include "geometry/tetra_mesh.h"
#include "organ_tools/phantom/implicit_shape.h"

namespace omentum::phantom {

/// Bounds on a mesh's size, both ends included.
struct MeshSize {
  std::size_t fewest_nodes, most_nodes;
  std::size_t fewest_tetrahedra, most_tetrahedra;
  double first_edge_m;   // where the search for the right edge length starts
  double cell_size = 1;  // bound on tetrahedra over that on facets: below 1 the inside is finer
  // How far a boundary facet may be from the shape, as part of the edge length: the inferior edge stays
  // recognizable without drawing all nodes to itself.
  double facet_distance = 0.12;
  bool without_slivers =
      true;  // they are removed, which takes most of the time; of what is only seen they stay
};

/// The liver's. The papers' size: 1,500-1,800 nodes, 6,500-8,000 tetrahedra.
MeshSize paper_size();
/// The liver's. Above 16,000 nodes.
MeshSize fine_size();
/// The gallbladder's: elements of about half the length of those of a liver of the papers' size.
MeshSize gallbladder_size();
/// The colon's: edges of a third of its width, as long as it is.
MeshSize colon_size();
/// The cavity's: long edges where the wall is plain, short ones over ribs, few nodes inside.
MeshSize cavity_size();
/// The omentum's: edges of a fifth of a lobe.
MeshSize omentum_size();
/// The plate's: about 759 nodes and 2,212 tetrahedra (Cotin 1998, fig. 2).
MeshSize plate_size();
/// The cylinder's: about 248 nodes and 889 tetrahedra (Cotin 1998, fig. 3).
MeshSize cylinder_size();

/// Fills the shape with a valid mesh within the bounds: Delaunay refinement with a manifold
/// boundary, then sliver removal, with the edge length adjusted until the counts fit. The same input gives
/// the same mesh. Throws std::runtime_error when no edge length tried gives one.
geometry::TetraMesh tetrahedralize(const ImplicitShape& shape, const MeshSize& size);

/// Smallest dihedral angle of all tetrahedra, degrees.
double smallest_dihedral_angle(const geometry::TetraMesh& mesh);

}  // namespace omentum::phantom
