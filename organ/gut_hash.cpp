#include "organ/gut_hash.h"

#include "files/sha256.h"

namespace omentum::organ {

std::string gut_hash(const geometry::GutShape& gut) {
  files::Sha256 sha;
  sha.add(&gut.layout, sizeof gut.layout);
  sha.add(gut.positions.data(), gut.positions.size() * sizeof(geometry::Vec3));
  sha.add(&gut.tube_radius_m, sizeof gut.tube_radius_m);
  sha.add(&gut.mesentery_thickness_m, sizeof gut.mesentery_thickness_m);
  return sha.hexadecimal();
}

}  // namespace omentum::organ
