#include "geometry/rotation.h"

namespace omentum::geometry {

// here alone, because each source that instantiates Eigen's singular value decomposition compiles seven
// seconds longer
Eigen::Quaterniond rotation_onto(const Vec3& from, const Vec3& to) noexcept {
  return Eigen::Quaterniond::FromTwoVectors(from, to);
}

}  // namespace omentum::geometry
