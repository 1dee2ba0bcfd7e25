#pragma once

#include "tilepack/image/image.h"
#include "tilepack/mip/border_path.h"
#include "tilepack/mip/downsample.h"
#include "tilepack/tileset/tile_colors.h"

#include <vector>

namespace tilepack {

/// Replaces the outermost texels of the tiles of one level by those that make bilinear filtering through the
/// pack as good as it can be, over a plane in which every legal neighbour is equally likely.
///
/// Let B be the true (box) texels of the tiles, P those stored; P = B but for the outermost ring. A filter
/// standing in tile A reads, inside and half a texel beyond A's border, the ring of A and the pad around it
/// (see BorderPath): F_A(P), with the pad taken from A's neighbours *in the pack*. The true value there is
/// T_A, with the pad from A's neighbours *in the plane*, which are random. Sought is the P that minimises
///
///   Σ_A E ∫ |F_A(P) - T_A|² dx dy  +  w Σ_edges E ∫ |F_A(P) - F_B(P)|² ds
///
/// where the first integral runs over A, the second along the edge between a random A and a random B that
/// can share it: its jump. Texels are the unit of length, and w the weight of the jump.
///
/// *Error.* T_A is independent of P, so E |F_A - T_A|² = |F_A - E T_A|² + Var T_A, and the variance, which no
/// choice of P changes, drops out. E T_A has A's own ring and, in the pad, the mean over all tiles that may
/// lie there: of the color of the edge for a side, of the corner (all tiles under edge coloring) for a
/// corner. Both are bilinear, so with e_A the nodal values of F_A - E T_A the term is e_A·G e_A.
///
/// *Jump.* Let u_A be the values along A's south border as read from A, means of ring and pad, and l_B those
/// along B's north border as read from B. Over the independent A with south color c and B with north color c
/// the term is the mean over all pairs (u_A - l_B)·M(u_A - l_B), once for each A; its derivative by u_A is
/// 2 M (u_A - mean l), by l_B likewise. Columns in the same way.
///
/// *Normal equations.* F, u and l are linear in P, so the gradient is affine in the ring texels: it is
/// assembled tile by tile, as in finite elements, and its zero is found by conjugate gradients in double
/// precision, every sum in a fixed order. Channels are independent.
///
/// The pack's own layout matters: continuity does not need equal rows in all tiles of a color (compare
/// shared_border), only that a + b' be the same for all pairs of rows (a, b') that meet in the pack, which
/// leaves the difference a - b' to the texture. That is why this beats averaging.
///
/// *What is left.* However the texels of a pack are chosen, ring or further in, a lookup in A gives a value
/// that depends on A alone, so no mode comes below Var T_A: the spread, over all tiles that may lie beyond
/// the border, of what the filter sees of them. Weight 0 comes near; to remove jumps costs more. Figures in
/// the README.
///
/// The values found stay within the range that the level's box texels span, channel by channel. Weighted by
/// alpha, it is the products of color and alpha that are fitted, and alpha itself.
void fit_borders(const TileColors& colors, const PackNeighbours& neighbours, double jump_weight,
                 Weighting weighting, std::vector<Image>& tiles);

} // namespace tilepack
