#include "render_node/organ_look.h"

namespace omentum::render {
namespace {

// The hue of its reflectance in clinical photographs, linear.
const Material kLiver{{0.112f, 0.0185f, 0.0155f}, 0.0f, 0.23f};
// Bile through a thin wall: dull green-blue, under a smooth and wetter serosa.
const Material kGallbladder{{0.040f, 0.086f, 0.064f}, 0.0f, 0.17f};
// Serosa over fat and muscle with little blood: a pale grey-pink, wet.
const Material kColon{{0.300f, 0.165f, 0.130f}, 0.0f, 0.21f};
// Without the capsule's veil: the deeper, duller red of parenchyma full of blood, wet with it; the mucosa of
// a sac, yellow with bile; and that of a bowel, a moist salmon.
const Material kLiverBared{{0.088f, 0.0105f, 0.0085f}, 0.0f, 0.30f};
const Material kGallbladderBared{{0.105f, 0.078f, 0.020f}, 0.0f, 0.26f};
const Material kColonBared{{0.260f, 0.085f, 0.060f}, 0.0f, 0.28f};

}  // namespace

Material tissue_material(const std::string& look) {
  if (look == "colon") return kColon;
  return look == "gallbladder" ? kGallbladder : kLiver;
}

Material bared_material(const std::string& look) {
  if (look == "colon") return kColonBared;
  return look == "gallbladder" ? kGallbladderBared : kLiverBared;
}

}  // namespace omentum::render
