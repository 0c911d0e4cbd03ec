#include "organ_tools/tissue_compare/laws.h"

#include "physics/dynamics/corotational.h"
#include "physics/dynamics/spring_mesh.h"
#include "physics/dynamics/tensor_mass.h"

namespace omentum::tissue_compare {

namespace {

using Arithmetic = physics::TensorMass::Arithmetic;

std::unique_ptr<physics::ForceLaw> make(Law law, const Tissue& tissue, Arithmetic of_tensors) {
  switch (law) {
    case Law::kCorotational:
      return std::make_unique<physics::Corotational>(tissue.mesh, tissue.material);
    case Law::kSpringMass:
      return std::make_unique<physics::SpringMesh>(tissue.mesh, tissue.material);
    case Law::kTensorMass:
      break;
  }
  return std::make_unique<physics::TensorMass>(tissue.mesh, tissue.material, of_tensors);
}

}  // namespace

const char* name_of(Law law) {
  switch (law) {
    case Law::kCorotational:
      return "corotational";
    case Law::kSpringMass:
      return "spring-mass";
    case Law::kTensorMass:
      break;
  }
  return "tensor-mass";
}

std::unique_ptr<physics::ForceLaw> make_law(Law law, const Tissue& tissue) {
  return make(law, tissue, Arithmetic::kFloat);
}

std::unique_ptr<physics::ForceLaw> make_exact_law(Law law, const Tissue& tissue) {
  return make(law, tissue, Arithmetic::kDouble);
}

std::int32_t edge_count(const Tissue& tissue) {
  return physics::SpringMesh(tissue.mesh, tissue.material).edge_count();
}

}  // namespace omentum::tissue_compare
