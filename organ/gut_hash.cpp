#include "organ/gut_hash.h"

#include "files/sha256.h"

#include <array>
#include <cstdio>

namespace omentum::organ {
namespace {

void add_number(double number, std::string& text) {
  std::array<char, 32> digits{};
  std::snprintf(digits.data(), digits.size(), " %.9g", number + 0.0);  // no minus before a zero
  text += digits.data();
}

}  // namespace

std::string gut_hash(const geometry::GutAnatomy& anatomy) {
  std::string text = "gut " + std::to_string(kGutVersion) + ' ' + std::to_string(anatomy.rows) + ' ' +
                     std::to_string(anatomy.columns) + ' ' + std::to_string(anatomy.legs);
  for (const double number : {anatomy.length_m, anatomy.tube_radius_m, anatomy.cylinder_radius_m,
                              anatomy.vessel_length_m, anatomy.mesentery_thickness_m, anatomy.fold_pitch_m})
    add_number(number, text);
  for (const geometry::Vec3& vector : {anatomy.origin, anatomy.along, anatomy.up})
    for (const double number : vector) add_number(number, text);
  files::Sha256 sha;
  sha.add(text.data(), text.size());
  return sha.hexadecimal();
}

}  // namespace omentum::organ
