// The paper's own contact: displacements imposed at the three vertices of a touched triangle.
#pragma once

#include "haptic_node/contact_nodes.h"

#include <span>
#include <vector>

namespace omentum::haptic {

/// alpha_v = k_v + 1 - (k_1^2 + k_2^2 + k_3^2) (Cotin 1999, section 5, sign corrected) of the vertex with
/// k_v: imposing alpha_v d at the vertices moves the point itself by exactly d, sum_v k_v alpha_v = 1.
inline double spread_weight(double k_v, const Vec3& barycentric) noexcept {
  return k_v + (1 - barycentric.squaredNorm());
}

/// One contact: the displacement d of its point, spread over its vertices.
struct SpreadContact {
  std::array<int, 3> slot;  // of its mobile vertices in ContactNodes
  Vec3 alpha;               // their spread weights
  int count = 0;
  Vec3 displacement;      // d, m
  Vec3 normal;            // outward: a contact that would pull is dropped
  bool may_pull = false;  // grasped
};

struct SpreadWorkspace {
  SpreadWorkspace();
  std::vector<double> factor;  // [3n][3n], lower triangle
  std::vector<double> f;       // [3n]
};

/// A node that a contact imposes, and the force that takes.
struct SpreadForce {
  int slot;
  int contact;  // of those that share the node, the one that moves it furthest
  Vec3 force;   // on the tissue, N
};

/// f_A = C_AA^-1 u_A with u_v = alpha_v d (Cotin 1999, eqs. 8 and 10 in symmetric form), contacts that would
/// pull dropped. Writes at most ContactNodes::kSlots entries into `result`; returns how many. No allocation.
int solve_spread(const ContactNodes& nodes, std::span<const SpreadContact> contacts, SpreadWorkspace& work,
                 std::span<SpreadForce> result) noexcept;

}  // namespace omentum::haptic
