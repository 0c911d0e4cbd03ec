// Points, and typed indices for the index spaces that would compile if mixed up.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <array>
#include <compare>
#include <cstdint>

namespace omentum::geometry {

using Vec3 = Eigen::Vector3d;

/// An index into one space. Converts to an integer on its own, but never from another space.
template <class Tag>
class Index {
 public:
  constexpr Index() = default;
  constexpr explicit Index(std::int32_t value) : value_(value) {}
  constexpr explicit Index(std::size_t value) : value_(static_cast<std::int32_t>(value)) {}
  constexpr operator std::int32_t() const { return value_; }
  constexpr bool valid() const { return value_ >= 0; }
  friend constexpr auto operator<=>(Index, Index) = default;

 private:
  std::int32_t value_ = -1;
};

using NodeId = Index<struct NodeTag>;          // node of a tetrahedral mesh, compact, from 0
using TetId = Index<struct TetTag>;            // tetrahedron of a mesh, in the file's order
using SurfaceId = Index<struct SurfaceTag>;    // node of a boundary surface, in spatial order
using TriangleId = Index<struct TriangleTag>;  // triangle of a boundary surface

using Tetrahedron = std::array<NodeId, 4>;  // positively oriented
using Triangle = std::array<SurfaceId, 3>;  // counter-clockwise seen from outside

}  // namespace omentum::geometry
