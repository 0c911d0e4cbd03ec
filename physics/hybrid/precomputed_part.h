// The precomputed part of a hybrid organ, as its connection nodes and its tools meet it.
#pragma once

#include "physics/surface_compliance.h"
#include "physics/symmetric_tiles.h"

#include <Eigen/Dense>

#include <span>
#include <vector>

namespace omentum::physics {

/// The quasi-static half of Cotin 1998's loop (fig. 5), in force form. Connection nodes c that are held at
/// w_c, and forces f at other nodes A of the surface (tools), give
///
///     r_c = S (w_c - sag_c - C_cA f),   S = C_cc^-1,
///     w = sag + C_:A f + C_:c r_c,
///
/// one solve with all of them, so that a tool is felt on the other side at once. The dynamic part is pushed
/// by -r_c = f_c - S w_c, with f_c = S (sag_c + C_cA f). `sag`: where the part's surface would be under loads
/// that always act, with its connection nodes free. All memory is taken at construction; one thread at a
/// time.
class PrecomputedPart {
 public:
  /// Forces on nodes of the surface, N; equal lengths, mobile nodes.
  struct Loads {
    std::span<const SurfaceId> nodes;
    std::span<const Vec3> forces;
  };
  /// What loads that always act do is part of an answer, or not of how it changes.
  enum class Sag { kWith, kWithout };

  /// `compliance` outlives it. `sag`: [mobile], m, or empty. Throws geometry::InputError for damaged tensors
  /// (condensed_stiffness.h).
  PrecomputedPart(const SurfaceCompliance& compliance, std::vector<SurfaceId> connection,
                  std::vector<Vec3> sag);

  /// S, [3c x 3c], N/m.
  const Eigen::MatrixXd& stiffness() const { return stiffness_; }
  std::span<const SurfaceId> connection() const { return connection_; }
  std::int32_t mobile_count() const { return compliance_.mobile_count(); }

  /// f_c, [3c], N. Without loads it is known.
  void condense(const Loads& loads, Sag sag, std::span<double> f_c) noexcept;
  /// w, [3 mobile], m, for w_c, [3c], and what condense() said of the same loads and sag.
  void follow(std::span<const double> w_c, const Loads& loads, Sag sag, std::span<const double> f_c,
              std::span<double> w) noexcept;

  /// How forces at nodes P pass to the connection nodes: B = S C_cP, [3c x 3p]; its transpose is how far P is
  /// taken along by them. Precondition: as many columns as B has.
  void passed_on(std::span<const SurfaceId> nodes, Eigen::Ref<Eigen::MatrixXd> B) noexcept;
  /// C_PP - C_Pc B, [3p x 3p]: how P yields while the connection nodes are held.
  void yield_held(std::span<const SurfaceId> nodes, const Eigen::Ref<const Eigen::MatrixXd>& B,
                  Eigen::Ref<Eigen::MatrixXd> yield) noexcept;

 private:
  bool sags(Sag sag) const { return sag == Sag::kWith && !sag_.empty(); }

  const SurfaceCompliance& compliance_;
  std::vector<SurfaceId> connection_;
  std::vector<Vec3> sag_;
  Eigen::MatrixXd stiffness_;
  SymmetricTiles hold_;                // the same
  Eigen::VectorXd sag_force_;          // [3c] S sag_c
  Eigen::VectorXd lifted_, reaction_;  // [3c]
  std::vector<SurfaceId> pushed_;      // A, then c
  std::vector<Vec3> pushes_;
  std::vector<float> tiled_;  // as superpose_surface writes it
};

}  // namespace omentum::physics
