#include "organ_tools/phantom/liver_shape.h"

namespace omentum::phantom {
namespace {

// All of it in metres. Proportions after the look of an adult liver, scaled to 18 cm.
constexpr double kLobeBlend = 0.028;     // radius over which the lobes flow into each other
constexpr double kEdgeRounding = 0.006;  // of the inferior edge: sharp, but still a surface to mesh
constexpr double kDentRounding = 0.006;  // of the borders of dents

const Ellipsoid kRightLobe{{-0.0353, 0.0019, -0.0428}, {0.0521, 0.0800, 0.0744}};
const Ellipsoid kMiddle{{-0.0037, 0.0205, -0.0372}, {0.0539, 0.0595, 0.0623}};
const Ellipsoid kLeftLobe{{0.0409, 0.0316, -0.0223}, {0.0539, 0.0353, 0.0353}};

// Dents: what lies against a liver leaves its print.
const Ellipsoid kGallbladderFossa{{-0.0112, -0.0335, -0.0130}, {0.0112, 0.0316, 0.0130}};
const Ellipsoid kUmbilicalNotch{{0.0260, -0.0279, -0.0019}, {0.0056, 0.0186, 0.0279}};
const Ellipsoid kKidneyPrint{{-0.0521, 0.0372, -0.0698}, {0.0326, 0.0418, 0.0391}};
const Ellipsoid kStomachPrint{{0.0558, 0.0279, -0.0512}, {0.0558, 0.0512, 0.0418}};

// The visceral face before its prints: a plane that rises towards the inferior edge and towards the left
// lobe.
const Vec3 kVisceralPoint{0, 0, -0.0242};
const Vec3 kVisceralOutward = Vec3(0.10, -0.36, -1.0).normalized();

double dented(double body, const Ellipsoid& dent, const Vec3& p) {
  return blended_max(body, -ellipsoid_distance(dent, p), kDentRounding);
}

}  // namespace

double liver_distance(const Vec3& p) {
  double d = ellipsoid_distance(kRightLobe, p);
  for (const Ellipsoid& lobe : {kMiddle, kLeftLobe})
    d = blended_min(d, ellipsoid_distance(lobe, p), kLobeBlend);
  d = blended_max(d, (p - kVisceralPoint).dot(kVisceralOutward), kEdgeRounding);
  for (const Ellipsoid& dent : {kGallbladderFossa, kUmbilicalNotch, kKidneyPrint, kStomachPrint})
    d = dented(d, dent, p);
  return d;
}

ImplicitShape liver() {
  return {"liver", liver_distance, {{-0.092, -0.070, -0.062}, {0.099, 0.091, 0.038}}};
}

}  // namespace omentum::phantom
