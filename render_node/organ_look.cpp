#include "render_node/organ_look.h"

#include <map>

namespace omentum::render {
namespace {

// The hue of its reflectance in clinical photographs, linear.
const Material kLiver{{0.112f, 0.0185f, 0.0155f}, 0.0f, 0.23f};
// Bile through a thin wall: dull green-blue, under a smooth and wetter serosa.
const Material kGallbladder{{0.040f, 0.086f, 0.064f}, 0.0f, 0.17f};
// Small bowel: pink serosa over muscle, thin and shining.
const Material kGut{{0.395f, 0.158f, 0.128f}, 0.0f, 0.22f};
// Fat under a clear film: yellow, wetter than the gut.
const Material kMesentery{{0.50f, 0.335f, 0.155f}, 0.0f, 0.26f};
// Large bowel: paler and greyer, its fat shines through.
const Material kColon{{0.33f, 0.150f, 0.105f}, 0.0f, 0.26f};
// Peritoneum over muscle: pale pink, moist. And fat under it.
const Material kCavityWall{{0.385f, 0.168f, 0.125f}, 0.0f, 0.34f};
const Material kOmentum{{0.315f, 0.195f, 0.072f}, 0.0f, 0.29f};
// Without the capsule's veil: the deeper, duller red of parenchyma full of blood, wet with it; the mucosa of
// a sac, yellow with bile; and that of a bowel, a moist salmon.
const Material kLiverBared{{0.088f, 0.0105f, 0.0085f}, 0.0f, 0.30f};
const Material kGallbladderBared{{0.105f, 0.078f, 0.020f}, 0.0f, 0.26f};
const Material kColonBared{{0.260f, 0.085f, 0.060f}, 0.0f, 0.28f};

// Venous, thick: nearly black where it stands.
const Material kBlood{{0.046f, 0.0016f, 0.0016f}, 0.0f, 0.16f};

const std::map<std::string, Material> kTissues{{"gallbladder", kGallbladder}, {"gut", kGut},
                                               {"mesentery", kMesentery},     {"colon", kColon},
                                               {"wall", kCavityWall},         {"omentum", kOmentum}};

}  // namespace

Material tissue_material(const std::string& look) {
  const auto found = kTissues.find(look);
  return found != kTissues.end() ? found->second : kLiver;
}

Material blood_material() {
  return kBlood;
}

Material bared_material(const std::string& look) {
  if (look == "colon") return kColonBared;
  return look == "gallbladder" ? kGallbladderBared : kLiverBared;
}

}  // namespace omentum::render
