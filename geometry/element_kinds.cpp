#include "geometry/element_kinds.h"

#include <span>
#include <vector>

namespace omentum::geometry {
namespace {

using enum ElementKind;

struct KindName {
  ElementKind kind;
  const char* one;
  const char* many;
};

// Solid ones first.
constexpr std::array<KindName, 11> kNames = {
    {{kTetrahedron, "tetrahedron", "tetrahedra"},
     {kHexahedron, "hexahedron", "hexahedra"},
     {kPrism, "prism", "prisms"},
     {kPyramid, "pyramid", "pyramids"},
     {kPolyhedron, "polyhedron", "polyhedra"},
     {kOther, "element of an unknown type", "elements of unknown types"},
     {kTriangle, "triangle", "triangles"},
     {kQuadrangle, "quadrangle", "quadrangles"},
     {kPolygon, "polygon", "polygons"},
     {kLine, "line", "lines"},
     {kPoint, "point", "points"}}};
constexpr std::size_t kSolids = 6;

// Gmsh's types from 1 to 31, with 92 and 93: all orders that its manual lists for the usual shapes.
constexpr std::array<GmshElement, 32> kGmshTypes = {
    {{kOther, 0},        {kLine, 2},         {kTriangle, 3},    {kQuadrangle, 4}, {kTetrahedron, 4},
     {kHexahedron, 8},   {kPrism, 6},        {kPyramid, 5},     {kLine, 3},       {kTriangle, 6},
     {kQuadrangle, 9},   {kTetrahedron, 10}, {kHexahedron, 27}, {kPrism, 18},     {kPyramid, 14},
     {kPoint, 1},        {kQuadrangle, 8},   {kHexahedron, 20}, {kPrism, 15},     {kPyramid, 13},
     {kTriangle, 9},     {kTriangle, 10},    {kTriangle, 12},   {kTriangle, 15},  {kTriangle, 15},
     {kTriangle, 21},    {kLine, 4},         {kLine, 5},        {kLine, 6},       {kTetrahedron, 20},
     {kTetrahedron, 35}, {kTetrahedron, 56}}};

struct VtkType {
  std::int64_t type;
  ElementKind kind;
};

// vtkCellType.h: nothing (a cell that was taken out), linear, quadratic, parametric, and of any order
// (Lagrange, Bezier).
constexpr VtkType kVtkTypes[] = {
    {0, kPoint},        {1, kPoint},        {2, kPoint},       {3, kLine},         {4, kLine},
    {5, kTriangle},     {6, kPolygon},      {7, kPolygon},     {8, kQuadrangle},   {9, kQuadrangle},
    {10, kTetrahedron}, {11, kHexahedron},  {12, kHexahedron}, {13, kPrism},       {14, kPyramid},
    {15, kPrism},       {16, kPrism},       {36, kPolygon},    {41, kPolyhedron},  {42, kPolyhedron},
    {51, kLine},        {52, kPolygon},     {53, kTriangle},   {54, kQuadrangle},  {56, kHexahedron},
    {60, kLine},        {61, kTriangle},    {62, kQuadrangle}, {63, kPolygon},     {65, kPrism},
    {66, kPyramid},     {67, kHexahedron},  {21, kLine},       {22, kTriangle},    {23, kQuadrangle},
    {24, kTetrahedron}, {25, kHexahedron},  {26, kPrism},      {27, kPyramid},     {28, kQuadrangle},
    {29, kHexahedron},  {30, kQuadrangle},  {31, kPrism},      {32, kPrism},       {33, kHexahedron},
    {34, kTriangle},    {35, kLine},        {37, kPyramid},    {68, kLine},        {69, kTriangle},
    {70, kQuadrangle},  {71, kTetrahedron}, {72, kHexahedron}, {73, kPrism},       {74, kPyramid},
    {75, kLine},        {76, kTriangle},    {77, kQuadrangle}, {78, kTetrahedron}, {79, kHexahedron},
    {80, kPrism},       {81, kPyramid}};

std::string describe(const ElementCounts& counts, std::span<const KindName> names) {
  std::vector<std::string> parts;
  for (const KindName& name : names) {
    const std::size_t count = counts[static_cast<std::size_t>(name.kind)];
    if (count > 0) parts.push_back(std::to_string(count) + " " + (count == 1 ? name.one : name.many));
  }
  std::string text;
  for (std::size_t i = 0; i < parts.size(); ++i)
    text += (i == 0 ? "" : i + 1 == parts.size() ? " and " : ", ") + parts[i];
  return text;
}

}  // namespace

std::string describe_elements(const ElementCounts& counts) {
  return describe(counts, kNames);
}

std::string describe_solids(const ElementCounts& counts) {
  return describe(counts, std::span(kNames).first(kSolids));
}

GmshElement gmsh_element(std::int64_t type) {
  if (type == 92) return {kHexahedron, 64};
  if (type == 93) return {kHexahedron, 125};
  return type > 0 && type < std::ssize(kGmshTypes) ? kGmshTypes[static_cast<std::size_t>(type)]
                                                   : GmshElement{};
}

ElementKind vtk_kind(std::int64_t type) {
  for (const VtkType& known : kVtkTypes) {
    if (known.type == type) return known.kind;
  }
  return kOther;
}

}  // namespace omentum::geometry
