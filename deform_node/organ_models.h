// What deform_node knows of an organ's physics: loads in, surface displacements out.
#pragma once

#include "geometry/types.h"

#include <cstdint>
#include <span>

namespace omentum::deform {

using geometry::SurfaceId;
using geometry::Vec3;

/// What one tool does to one organ at this moment. Equal lengths; every node is a mobile surface node.
struct ToolLoad {
  std::uint32_t tool = 0;
  std::span<const SurfaceId> nodes;
  std::span<const Vec3> displacements;  // imposed u of each node, in W, m
  std::span<const Vec3> forces;         // on the tissue, in W, N
};

/// One organ's deformation. The quasi-static, tensor-mass, hybrid and intestine models each are one of
/// these; deform_loop knows nothing else of them. One thread at a time.
class OrganModel {
 public:
  virtual ~OrganModel() = default;

  /// Advances by dt_s (fixed for a run) under the loads of this moment. Allocates nothing.
  virtual void step(std::span<const ToolLoad> loads, double dt_s) noexcept = 0;

  /// Back to rest.
  virtual void reset() noexcept = 0;

  /// Displacement of every surface node, x y z in SurfaceId order, pinned nodes included: [3 S], m, in W.
  virtual std::span<const float> displacements() const noexcept = 0;
};

}  // namespace omentum::deform
