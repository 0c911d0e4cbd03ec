// Makes the models that move by themselves of what a scene and an organ file say.
#pragma once

#include "deform_node/organ_models.h"
#include "node_common/organ_source.h"

#include <memory>

namespace omentum::deform {

/// Each is the scene's model of that name: linear elasticity on masses (Cotin 1998, section 5), the same in
/// frames that turn with the tissue, and springs. `source` outlives the model. Throws std::runtime_error
/// "FILE:LINE: ..." for a step that the mesh does not allow.
std::unique_ptr<OrganModel> make_tensor_mass(const node::OrganSource& source, const scene::OrganSpec& spec);
std::unique_ptr<OrganModel> make_corotational(const node::OrganSource& source, const scene::OrganSpec& spec);
/// In equilibrium at every moment, cut or not.
std::unique_ptr<OrganModel> make_quasi_static_cut(const node::OrganSource& source,
                                                  const scene::OrganSpec& spec);
std::unique_ptr<OrganModel> make_spring_mass(const node::OrganSource& source, const scene::OrganSpec& spec);
/// One of the first two in the dynamic part of a hybrid organ, whose other part is precomputed (Cotin 1998,
/// section 6): one body to hands, cuts and pictures. Precondition: `source` was loaded with the part's
/// tensors.
std::unique_ptr<OrganModel> make_hybrid(const node::OrganSource& source, const scene::OrganSpec& spec);
/// The same organ cut in either part: no tensors are read. Throws geometry::InputError for one that has no
/// dynamic part.
std::unique_ptr<OrganModel> make_hybrid_cut(const node::OrganSource& source, const scene::OrganSpec& spec);

}  // namespace omentum::deform
