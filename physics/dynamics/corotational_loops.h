// What the co-rotational kernels of all vector units are made of. Nothing but loops on raw pointers, and no
// library header with inline functions: what the linker keeps of those may be of any instruction set.
#pragma once

#include "physics/dynamics/lanes.h"
#include "physics/dynamics/law_kernels.h"

namespace omentum::physics::kernels {

namespace {

static_assert(kTetLanes == kPack);

// Newton's steps until the trace of the stretch is exact: 2 to 5, where tissue is.
inline constexpr int kMostSteps = 60;
// The last step, relative; what is left then is its square.
inline constexpr double kLastStep = 1e-9;
// (s2 + s3)(s1 + s3)(s1 + s2) over their size, below which the rotation is found otherwise: it is (nearly)
// not unique, and the formula would lose more than four of its sixteen digits.
inline constexpr double kNearlyAmbiguous = 1e-4;

struct Matrix {
  Lanes m[3][3];
};

// F = R S: a rotation and a symmetric stretch with the trace `trace`.
struct Polar {
  Matrix F, R;
  Lanes trace;
  Lanes gap;           // (s2 + s3)(s1 + s3)(s1 + s2) of the stretch's eigenvalues
  LaneMask ambiguous;  // there is another rotation as near, or nearly so
};

// sum_c (w_c - w_0) gradient_c^T
OMENTUM_LANES_INLINE void gradient_of(const TetPack& pack, const PaddedNode* w, Matrix& G) {
  const LaneVectors origin = gather(w, pack.node[0]);
  for (auto& row : G.m) row[0] = row[1] = row[2] = Lanes{};
  for (int c = 0; c < 3; ++c) {
    const LaneVectors end = gather(w, pack.node[c + 1]);
    const Lanes along[3] = {end.x - origin.x, end.y - origin.y, end.z - origin.z};
    for (int a = 0; a < 3; ++a) {
      for (int b = 0; b < 3; ++b) G.m[a][b] += along[a] * lanes_at(pack.gradient[c][b]);
    }
  }
}

OMENTUM_LANES_INLINE Lanes dot(const Matrix& A, const Matrix& B) {
  Lanes sum{};
  for (int a = 0; a < 3; ++a) {
    for (int b = 0; b < 3; ++b) sum += A.m[a][b] * B.m[a][b];
  }
  return sum;
}

// A B^T
OMENTUM_LANES_INLINE void times_transposed(const Matrix& A, const Matrix& B, Matrix& C) {
  for (int a = 0; a < 3; ++a) {
    for (int b = 0; b < 3; ++b) {
      C.m[a][b] = A.m[a][0] * B.m[b][0] + A.m[a][1] * B.m[b][1] + A.m[a][2] * B.m[b][2];
    }
  }
}

// A B
OMENTUM_LANES_INLINE void times(const Matrix& A, const Matrix& B, Matrix& C) {
  for (int a = 0; a < 3; ++a) {
    for (int b = 0; b < 3; ++b) {
      C.m[a][b] = A.m[a][0] * B.m[0][b] + A.m[a][1] * B.m[1][b] + A.m[a][2] * B.m[2][b];
    }
  }
}

// A^T B
OMENTUM_LANES_INLINE void transposed_times(const Matrix& A, const Matrix& B, Matrix& C) {
  for (int a = 0; a < 3; ++a) {
    for (int b = 0; b < 3; ++b) {
      C.m[a][b] = A.m[0][a] * B.m[0][b] + A.m[1][a] * B.m[1][b] + A.m[2][a] * B.m[2][b];
    }
  }
}

// det(A) A^-T: of each row the cross product of the two others
OMENTUM_LANES_INLINE void cofactors(const Matrix& A, Matrix& C) {
  for (int a = 0; a < 3; ++a) {
    const Lanes* p = A.m[(a + 1) % 3];
    const Lanes* q = A.m[(a + 2) % 3];
    for (int b = 0; b < 3; ++b) {
      const int i = (b + 1) % 3, j = (b + 2) % 3;
      C.m[a][b] = p[i] * q[j] - p[j] * q[i];
    }
  }
}

// The largest root of l^4 - 2 |F|^2 l^2 - 8 det(F) l + |F|^4 - 4 |cof F|^2, which is the trace of S (Higham
// and Noferini 2016: the largest eigenvalue of Horn's matrix). All roots are real, so that Newton's method
// comes down to it from the bound sqrt(3) |F| without passing it.
OMENTUM_LANES_INLINE void find_trace(const Lanes& norm2, const Lanes& det, const Lanes& cofactor2, Polar& p) {
  const Lanes constant = norm2 * norm2 - 4.0 * cofactor2;
  Lanes l = square_root(3.0 * norm2);
  for (int step = 0; step < kMostSteps; ++step) {
    const Lanes l2 = l * l;
    p.gap = 0.5 * l * (l2 - norm2) - det;
    p.ambiguous = ~(p.gap > kNearlyAmbiguous * l * norm2);
    const Lanes value = l2 * (l2 - 2.0 * norm2) - 8.0 * det * l + constant;
    const Lanes change = p.ambiguous ? Lanes{} : value / (8.0 * p.gap);
    l -= change;
    if (!any(absolute(change) > kLastStep * l)) break;
  }
  p.trace = l;
  p.gap = 0.5 * l * (l * l - norm2) - det;
}

inline void resolve_ambiguous(Polar& p) noexcept {
  for (int l = 0; l < kPack; ++l) {
    if (p.ambiguous[l] == 0) continue;
    double F[9], R[9];
    for (int i = 0; i < 9; ++i) F[i] = p.F.m[i / 3][i % 3][l];
    nearest_rotation(F, R);
    p.trace[l] = 0;
    for (int i = 0; i < 9; ++i) {
      p.R.m[i / 3][i % 3][l] = R[i];
      p.trace[l] += R[i] * F[i];
    }
  }
}

// R is the trace's derivative by F, by the polynomial above: no inverse, so that a flat element has one as
// well.
OMENTUM_LANES_INLINE void decompose(const TetPack& pack, const PaddedNode* u, Polar& p) {
  gradient_of(pack, u, p.F);
  for (int a = 0; a < 3; ++a) p.F.m[a][a] += 1.0;
  Matrix cof, FFt, FFtF;
  cofactors(p.F, cof);
  times_transposed(p.F, p.F, FFt);
  times(FFt, p.F, FFtF);
  const Lanes norm2 = dot(p.F, p.F);
  const Lanes det = p.F.m[0][0] * cof.m[0][0] + p.F.m[0][1] * cof.m[0][1] + p.F.m[0][2] * cof.m[0][2];
  find_trace(norm2, det, dot(cof, cof), p);
  const Lanes of_F = 0.5 * (p.trace * p.trace + norm2), inverse_gap = 1.0 / p.gap;
  for (int a = 0; a < 3; ++a) {
    for (int b = 0; b < 3; ++b) {
      p.R.m[a][b] = inverse_gap * (of_F * p.F.m[a][b] + p.trace * cof.m[a][b] - FFtF.m[a][b]);
    }
  }
  if (any(p.ambiguous)) resolve_ambiguous(p);
}

// P gradient_corner, of stiff lanes
OMENTUM_LANES_INLINE LaneVectors share_of(const TetPack& pack, const Matrix& P, int c) {
  const LaneMask stiff = lanes_at(pack.two_mu_volume) > 0;
  Lanes share[3];
  for (int a = 0; a < 3; ++a) {
    const Lanes all = P.m[a][0] * lanes_at(pack.gradient[c][0]) + P.m[a][1] * lanes_at(pack.gradient[c][1]) +
                      P.m[a][2] * lanes_at(pack.gradient[c][2]);
    share[a] = stiff ? all : Lanes{};
  }
  return {share[0], share[1], share[2]};
}

// f[corner] += P gradient_corner; the corners' shares add up to zero.
OMENTUM_LANES_INLINE void scatter(const TetPack& pack, const Matrix& P, PaddedNode* f) {
  NodeLanes share[3][kPack];
  for (int c = 0; c < 3; ++c) lane_by_lane(share_of(pack, P, c), share[c]);
  // lane after lane: two of them may share a node
  for (int l = 0; l < kPack; ++l) {
    lanes_of(f[pack.node[0][l]]) -= share[0][l] + share[1][l] + share[2][l];
    for (int c = 0; c < 3; ++c) lanes_of(f[pack.node[c + 1][l]]) += share[c][l];
  }
}

// A V = mu V I + (lambda V (trace - 3) - 2 mu V) (trace I - S)^-1; without the second derivative's part where
// there is no derivative.
OMENTUM_LANES_INLINE void exact_skew(const TetPack& pack, const Polar& p, double skew[6][kTetLanes]) {
  const Lanes two_mu = lanes_at(pack.two_mu_volume);
  const Lanes c = lanes_at(pack.lambda_volume) * (p.trace - 3.0) - two_mu;
  Matrix S, X, adjugate;
  transposed_times(p.R, p.F, S);
  for (int a = 0; a < 3; ++a) {
    for (int b = 0; b < 3; ++b) X.m[a][b] = (a == b ? p.trace : Lanes{}) - 0.5 * (S.m[a][b] + S.m[b][a]);
  }
  cofactors(X, adjugate);
  const Lanes factor = p.ambiguous ? Lanes{} : c / p.gap;
  int i = 0;
  for (int a = 0; a < 3; ++a) {
    for (int b = a; b < 3; ++b, ++i) {
      const Lanes rest = factor * adjugate.m[a][b];
      lanes_at(skew[i]) = p.ambiguous ? Lanes{} : (a == b ? 0.5 * two_mu + rest : rest);
    }
  }
}

OMENTUM_LANES_INLINE void linearize(const TetPack& pack, const PaddedNode* u, bool exact,
                                    TetTangent& tangent) {
  Polar p;
  decompose(pack, u, p);
  for (int a = 0; a < 3; ++a) {
    for (int b = 0; b < 3; ++b) lanes_at(tangent.rotation[a][b]) = p.R.m[a][b];
  }
  for (auto& component : tangent.skew) lanes_at(component) = Lanes{};
  if (exact) exact_skew(pack, p, tangent.skew);
}

// P = R (2 mu V sym(W) + lambda V tr(W) I + [A V a]x), W = R^T G, [a]x = W - W^T
OMENTUM_LANES_INLINE void tangent_stress(const TetPack& pack, const TetTangent& tangent, const PaddedNode* v,
                                         Matrix& P) {
  Matrix R, G, W, Q;
  for (int a = 0; a < 3; ++a) {
    for (int b = 0; b < 3; ++b) R.m[a][b] = lanes_at(tangent.rotation[a][b]);
  }
  gradient_of(pack, v, G);
  transposed_times(R, G, W);
  const Lanes two_mu = lanes_at(pack.two_mu_volume);
  const Lanes pressure = lanes_at(pack.lambda_volume) * (W.m[0][0] + W.m[1][1] + W.m[2][2]);
  const Lanes x = W.m[2][1] - W.m[1][2], y = W.m[0][2] - W.m[2][0], z = W.m[1][0] - W.m[0][1];
  const auto& A = tangent.skew;
  const Lanes turn[3] = {lanes_at(A[0]) * x + lanes_at(A[1]) * y + lanes_at(A[2]) * z,
                         lanes_at(A[1]) * x + lanes_at(A[3]) * y + lanes_at(A[4]) * z,
                         lanes_at(A[2]) * x + lanes_at(A[4]) * y + lanes_at(A[5]) * z};
  for (int a = 0; a < 3; ++a) {
    const int b = (a + 1) % 3, c = (a + 2) % 3;
    const Lanes shear = 0.5 * two_mu * (W.m[a][b] + W.m[b][a]);
    Q.m[a][a] = two_mu * W.m[a][a] + pressure;
    Q.m[a][b] = shear - turn[c];
    Q.m[b][a] = shear + turn[c];
  }
  times(R, Q, P);
}

inline void add_corotational_forces(const TetPack* packs, int count, const PaddedNode* u,
                                    PaddedNode* f) noexcept {
  for (int i = 0; i < count; ++i) {
    const TetPack& pack = packs[i];
    if (pack.stiff_count == 0) continue;
    Polar p;
    decompose(pack, u, p);
    const Lanes two_mu = lanes_at(pack.two_mu_volume);
    const Lanes of_R = lanes_at(pack.lambda_volume) * (p.trace - 3.0);
    Matrix P;
    for (int a = 0; a < 3; ++a) {
      for (int b = 0; b < 3; ++b) P.m[a][b] = two_mu * (p.R.m[a][b] - p.F.m[a][b]) - of_R * p.R.m[a][b];
    }
    scatter(pack, P, f);
  }
}

inline double corotational_energy(const TetPack* packs, int count, const PaddedNode* u) noexcept {
  Lanes sum{};
  for (int i = 0; i < count; ++i) {
    const TetPack& pack = packs[i];
    if (pack.stiff_count == 0) continue;
    Polar p;
    decompose(pack, u, p);
    Matrix off;
    for (int a = 0; a < 3; ++a) {
      for (int b = 0; b < 3; ++b) off.m[a][b] = p.F.m[a][b] - p.R.m[a][b];
    }
    const Lanes swelling = p.trace - 3.0, two_mu = lanes_at(pack.two_mu_volume);
    const Lanes energy = 0.5 * (two_mu * dot(off, off) + lanes_at(pack.lambda_volume) * swelling * swelling);
    sum += two_mu > 0 ? energy : Lanes{};
  }
  double total = 0;
  for (int l = 0; l < kPack; ++l) total += sum[l];
  return total;
}

inline void linearize_corotational(const TetPack* packs, int count, const PaddedNode* u, bool exact,
                                   TetTangent* tangents) noexcept {
  for (int i = 0; i < count; ++i) linearize(packs[i], u, exact, tangents[i]);
}

inline void add_corotational_product(const TetPack* packs, const TetTangent* tangents, int count,
                                     const PaddedNode* v, PaddedNode* f) noexcept {
  for (int i = 0; i < count; ++i) {
    if (packs[i].stiff_count == 0) continue;
    Matrix P;
    tangent_stress(packs[i], tangents[i], v, P);
    scatter(packs[i], P, f);
  }
}

}  // namespace

}  // namespace omentum::physics::kernels
