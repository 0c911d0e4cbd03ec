// From what a scene says of an intestine to the model that moves it.
#pragma once

#include "deform_node/organ_models.h"
#include "node_common/organ_source.h"

#include <memory>

namespace omentum::deform {

/// Throws std::runtime_error "FILE:LINE: organ NAME: ..." for a material or step that cannot be, an explicit
/// step beyond what is stable with that, a start in an obstacle.
std::unique_ptr<OrganModel> make_intestine(const node::OrganSource& source, const scene::OrganSpec& spec);

}  // namespace omentum::deform
