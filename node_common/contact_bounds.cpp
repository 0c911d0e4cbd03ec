#include "node_common/contact_bounds.h"

#include "node_common/vectors.h"

namespace omentum::node {

double total_force_n(const msg::Contact& contact) noexcept {
  double total_n = 0;
  for (const msg::Vec3& force : contact.forces) total_n += to_vector(force).norm();
  return total_n;
}

bool within_scene(double total_force_n, double max_force_n) noexcept {
  return total_force_n <= kTissueHeadRoom * max_force_n;
}

}  // namespace omentum::node
