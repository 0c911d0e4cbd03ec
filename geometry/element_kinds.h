// What kinds of elements mesh files hold besides tetrahedra: for messages that say what was found.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

namespace omentum::geometry {

enum class ElementKind {
  kPoint,
  kLine,
  kTriangle,
  kQuadrangle,
  kTetrahedron,
  kHexahedron,
  kPrism,
  kPyramid,
  kPolygon,
  kPolyhedron,
  kOther  // of a type that is not known here
};

/// Elements by kind, [ElementKind].
using ElementCounts = std::array<std::size_t, 11>;

/// "12 hexahedra and 24 quadrangles": those of which there are any, solid ones first; empty when there is
/// none.
std::string describe_elements(const ElementCounts& counts);

/// The same of those that fill space, or might: of a type that is not known here.
std::string describe_solids(const ElementCounts& counts);

/// A Gmsh element type: its kind, and how many nodes it has (0: a type that is not known here). The first
/// four nodes of a tetrahedron of any order are its corners.
struct GmshElement {
  ElementKind kind = ElementKind::kOther;
  int nodes = 0;
};
GmshElement gmsh_element(std::int64_t type);

/// The kind of a VTK cell type. Tetrahedra of any order name their corners first.
ElementKind vtk_kind(std::int64_t type);

}  // namespace omentum::geometry
