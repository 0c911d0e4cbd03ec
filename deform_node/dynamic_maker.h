// Makes the models that move by themselves of what a scene and an organ file say.
#pragma once

#include "deform_node/organ_models.h"
#include "node_common/organ_source.h"

#include <memory>

namespace omentum::deform {

/// Linear elasticity on masses (Cotin 1998, section 5): the scene's "tensor-mass". `source` outlives the
/// model. Throws std::runtime_error "FILE:LINE: ..." for what the mesh does not allow.
std::unique_ptr<OrganModel> make_tensor_mass(const node::OrganSource& source, const scene::OrganSpec& spec);

}  // namespace omentum::deform
