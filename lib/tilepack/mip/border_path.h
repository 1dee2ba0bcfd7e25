#pragma once

#include "tilepack/image/image.h"
#include "tilepack/layout/layout.h"

#include <array>
#include <vector>

namespace tilepack {

/// The tiles around each tile in a packed texture, which is what a filter reads across a tile's border.
///
///   0 1 2
///   3 · 4        the order of the eight
///   5 6 7
struct PackNeighbours {
  /// id → the eight ids; empty: there are none, the filter clamps to the tile itself (texture arrays).
  std::vector<std::array<int, 8>> around;
};

/// From a layout on a grid, which wraps; none for an array.
PackNeighbours pack_neighbours(const Layout& layout);

/// What the bilinear filter can see around the border of one tile: its own outermost texels, the *ring*, and
/// the texels one further out, the *pad*, which belong to neighbours. Everything inside is left out.
///
///      pad   p p p p p p
///            p r r r r p      nodes (x, y), -1 <= x <= width, -1 <= y <= height,
///            p r · · r p      in rows from the north-west
///            p r r r r p
///            p p p p p p
///
/// A bilinear field over the tile is Σ v_i φ_i with one hat function φ_i = φ(x) φ(y) a node. Its square
/// integrated over the tile is v·Gv with G_ij = ∫ φ_i φ_j = m(x_i, x_j) m(y_i, y_j), where m is the product
/// integrated along one axis from border to border. The pad's centres lie half a texel outside, so of the
/// cell between pad and ring only the half next to the ring counts: with w the distance from the ring's
/// centre, 0 to 1/2,
///   ∫ (1-w)² = 7/24 (ring, ring),   ∫ w(1-w) = 1/12 (ring, pad),   ∫ w² = 1/24 (pad, pad);
/// a whole cell gives 1/3, 1/6, 1/3.
class BorderPath {
public:
  explicit BorderPath(Size size);

  struct Node {
    int x = 0;
    int y = 0;
  };
  struct Product { ///< a neighbour of a node and the integral of their hats
    int node = 0;
    double integral = 0;
  };
  /// Two nodes whose mean is the value on the border between them.
  struct Crossing {
    int inside = 0;
    int outside = 0;
  };
  enum Side { north, east, south, west };

  Size tile_size() const { return size; }
  const std::vector<Node>& nodes() const { return all_nodes; }
  bool in_ring(Node node) const {
    return node.x >= 0 && node.x < size.width && node.y >= 0 && node.y < size.height;
  }
  const std::vector<Product>& products(int node) const {
    return node_products[static_cast<std::size_t>(node)];
  }

  /// Along one side, from the pad before its first texel to the pad after its last.
  const std::vector<Crossing>& crossings(Side side) const { return side_crossings[side]; }

  /// The square integral along a side: out = M values, M_ij = m(i, j). Same length.
  static void integrate(const std::vector<double>& values, std::vector<double>& out);

  /// The index of a ring texel among the ring texels of its tile, and how many those are.
  int ring_index(int x, int y) const;
  int ring_count() const { return ring_texels; }

private:
  int node_at(int x, int y) const;

  Size size;
  int ring_texels = 0;
  std::vector<Node> all_nodes;
  std::vector<int> index_of_node; // (width + 2) × (height + 2), -1 for what is left out
  std::vector<int> index_in_ring; // width × height, -1 for what is left out
  std::vector<std::vector<Product>> node_products;
  std::array<std::vector<Crossing>, 4> side_crossings;
};

} // namespace tilepack
