// The innermost loops over the panels of a kept factor, on raw pointers: compiled for this machine's vector
// unit. A strip is up to 16 columns of a supernode, cut into tiles of 16 rows; a tile is [width][16], one
// column after the other, and the first tile of a strip is the one on the diagonal.
#pragma once

namespace omentum::physics::kernels {

/// Rows of a tile, and the most columns of a strip.
inline constexpr int kTileRows = 16;
/// Floats of a full square tile.
inline constexpr int kSquare = kTileRows * kTileRows;
/// Rank of a tetrahedron's stiffness: what one removal takes away.
inline constexpr int kRank = 6;
/// What must be left of a rank's alpha: with 48 bits in an entry, six digits of A are still right there.
inline constexpr double kLeastAlpha = 1e-8;
/// Right-hand sides that are taken through a strip together: their sums fit into AVX2's registers.
inline constexpr int kTogether = 6;

/// A panel's entry is the sum of two floats, `high` the nearest to it: 48 bits of it are kept, and a solve
/// reads the high ones only.
struct SplitColumns {
  float* high;
  float* low;
};

/// What one removal does to the columns of a strip: [column][rank].
struct Rotations {
  double pivot[kTileRows][kRank];
  double gain[kTileRows][kRank];
};

/// v[0] = L_ss^-1 v[0], then v[t] -= L_t v[0] for the tiles below; v is [tiles][16], 64-byte aligned.
/// `inverse`: of the unit lower triangle of the diagonal tile, by columns.
void forward_strip(const float* high, const float* inverse, int width, int tiles, float* v) noexcept;

/// The same for kTogether right-hand sides, which begin `stride` floats after one another.
void forward_strip_together(const float* high, const float* inverse, int width, int tiles, float* v,
                            long stride) noexcept;

/// v[0] = L_ss^-T (v[0] - sum_t L_t^T v[t]); `inverse_transposed` by columns.
void backward_strip(const float* high, const float* inverse_transposed, int width, int tiles,
                    float* v) noexcept;

/// Both inverses of the unit lower triangle in a diagonal tile, [16][16] each by columns; columns from
/// `width` on are those of the identity.
void invert_diagonal(const float* high, const float* low, int width, float* inverse,
                     float* inverse_transposed) noexcept;

/// Splits `count` doubles.
void split(const double* values, int count, SplitColumns into) noexcept;

/// Takes w w^T, w [16][6], off L D L^T within the diagonal tile of a strip (Gill, Golub, Murray and Saunders
/// 1974, method C1, six ranks in turn in each column as Davis and Hager 2001). `w` is [6][16]; `pivots` D of
/// the strip's columns; `alpha` [6], what is left of each rank's 1 - w^T A^-1 w so far. Where alpha begins at
/// -1 instead of 1 the rank is added, and falls from there. Returns whether each stays at least kLeastAlpha,
/// or at most -1; where one does not (a NaN never does), the matrix does not stay positive definite, or only
/// within rounding: then nothing of it may be used.
bool downdate_diagonal(SplitColumns tile, int width, double* pivots, double* w, double* alpha,
                       Rotations& rotations) noexcept;

/// The same rotations on a tile below; `w`: [6][16] of the tile's rows.
void rotate_tile(SplitColumns tile, int width, const Rotations& rotations, double* w) noexcept;

/// sum a_i b_i over `count` floats.
float column_dot(const float* a, const float* b, int count) noexcept;

/// f = K u over `rows` rows of 3x3 blocks (physics::Stiffness); a block's columns one after the other.
void multiply_block_rows(const int* start, const int* neighbour, const double* block, int rows,
                         const double* u, double* f) noexcept;

}  // namespace omentum::physics::kernels
