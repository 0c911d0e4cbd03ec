// What a hybrid organ's tensors are of: the part of it that is precomputed.
#pragma once

#include "geometry/covered_faces.h"
#include "organ/joined_parts.h"
#include "physics/hybrid/border_tie.h"
#include "physics/surface_compliance.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace omentum::organ {

/// A hybrid organ's two parts. The precomputed one has its own boundary, connection nodes among it, and
/// supports; it yields where it would with the dynamic part taken away.
struct OrganSplit {
  std::vector<std::uint8_t> dynamic;  // [T] 1: of the dynamic part
  physics::MeshSplit parts;
  physics::FixedComponents fixed;               // [n] of the precomputed part
  geometry::Surface surface;                    // its boundary, in its own nodes
  std::vector<geometry::SurfaceId> connection;  // on it, in the order of parts.connection; or tie->slaves
  std::vector<geometry::NodeId> tensor_node;    // [mobile] of the whole organ, whose the tensors' columns are
  BorderFaces border{};                         // of parts that share no nodes; else none
  std::optional<physics::BorderTie> tie{};      // by these; else none
  std::vector<geometry::CoveredFace> covered{};  // of these, in the whole: no surface while they are covered
  std::optional<physics::SurfaceCompliance> compliance{};  // of `surface`, float; absent when not asked for

  /// [T] 1: of the precomputed part.
  std::vector<std::uint8_t> precomputed() const;
};

/// Tetrahedra of the precomputed part that would hang on a node or an edge only, if the dynamic part went,
/// become dynamic; says how many.
std::size_t take_what_would_hang(const geometry::TetraMesh& mesh, std::vector<std::uint8_t>& dynamic);

/// Throws geometry::InputError, beginning with `where`, for a dynamic part that is empty or everything, that
/// leaves a piece of the precomputed part which no support holds, and for connection nodes that are held.
/// `border`: of parts that share no nodes (joined_parts.h); also throws where it is none of theirs, and where
/// the dynamic part is the finer one at it.
OrganSplit split_organ(const geometry::TetraMesh& mesh, const physics::FixedComponents& fixed,
                       std::vector<std::uint8_t> dynamic, const std::string& where, BorderFaces border = {});

}  // namespace omentum::organ
