#include "deform_node/strain_gauge.h"

#include <algorithm>

namespace omentum::deform {

std::unique_ptr<StrainGauge> OrganModel::strain_gauge() const {
  return nullptr;
}

StrainedShape::StrainedShape(const ModelSizes& sizes)
    : state(sizes), body_u(sizes.body), surface(sizes.body > 0 ? sizes.values / 3 : 0) {}

void StrainedShape::take(const OrganView& view) noexcept {
  state.take(view);
  std::copy_n(view.body_u.begin(), std::min(view.body_u.size(), body_u.size()), body_u.begin());
  std::copy_n(view.surface.begin(), std::min(view.surface.size(), surface.size()), surface.begin());
}

}  // namespace omentum::deform
