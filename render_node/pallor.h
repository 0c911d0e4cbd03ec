// How tissue pales where pressure squeezes the blood out of it.
#pragma once

#include "render_node/contact_pressure.h"

namespace omentum::render {

/// The pressure under which all blood but a share of 1/e is gone, Pa: 22 mmHg, midway between the 32 with
/// which blood enters a capillary and the 12 with which it leaves (Landis, Heart 15, 1930). A vessel closes
/// when what is around it presses harder than what is inside, and not all of a tissue's at one pressure.
inline constexpr float kCapillary_pa = 2933;

/// Blood leaves at once, and comes back more slowly through what feeds it: nine tenths of it in a second, as
/// a pressed nail of a healthy person refills.
inline constexpr double kPaling_s = 0.07, kRefill_s = 0.43;

/// The share of its blood that tissue lacks under a steady pressure: 1 - exp(-p / p_capillary), 0 to 1.
float steady_pallor(float pressure_pa);

/// `pallor` after `dt_s` on its way to `target`: exact for a target that stays, so that two half steps are a
/// whole one and no frame rate shows.
float pallor_after(float pallor, float target, double dt_s);

/// The pallor of one mesh's vertices, which is where it is kept. One thread.
class Pallor {
 public:
  /// To be made anew when triangles change.
  explicit Pallor(const MeshData& mesh);

  /// `vertices`: the mesh's, as they lie now. Whether any of them changed; costs nothing where no tissue is
  /// pressed or pale.
  bool advance(std::span<const Press> presses, double dt_s, std::span<Vertex> vertices);

 private:
  static constexpr float kSeen = 0.002f;  // less than half a step of 255 in a picture

  ContactPressure pressure_;
  bool pale_;  // some of it is: vertices outlive this
};

}  // namespace omentum::render
