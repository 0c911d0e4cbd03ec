// Strain and stress at the surface of an organ, measured beside the loop.
#pragma once

#include "deform_node/tick_snapshot.h"

#include <vector>

namespace omentum::deform {

/// What a gauge needs of an organ at one moment, copied. Has the largest size from the start on, so that
/// taking a view takes no memory.
struct StrainedShape {
  StrainedShape() = default;
  explicit StrainedShape(const ModelSizes& sizes);

  OrganSnapshot state;
  std::vector<double> body_u;   // OrganView::body_u
  std::vector<NodeId> surface;  // OrganView::surface, as many as the state has nodes; others hold nothing

  /// `view` is not larger than the sizes said.
  void take(const OrganView& view) noexcept;
  std::size_t node_count() const noexcept { return state.value_count / 3; }
};

/// Measures one organ. No allocation after construction; one thread at a time, which need not be the model's.
class StrainGauge {
 public:
  virtual ~StrainGauge() = default;
  /// False: strain alone.
  virtual bool knows_stress() const noexcept = 0;
  /// As OrganStress of idl/organ.idl has them, one value per node of the state. `stress_pa` is empty where
  /// none is known.
  virtual void measure(const StrainedShape& shape, std::span<float> strain,
                       std::span<float> stress_pa) noexcept = 0;
};

}  // namespace omentum::deform
