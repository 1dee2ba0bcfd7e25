#pragma once

#include "tilepack/numeric/enum_names.h"
#include "tilepack/pattern/cell_hash.h"
#include "tilepack/pattern/pattern_choice.h"
#include "tilepack/pattern/pattern_source.h"
#include "tilepack/pattern/pixel_map.h"
#include "tilepack/pattern/sprite_map.h"
#include "tilepack/pattern/stored_map.h"
#include "tilepack/pattern/tile_transform.h"

#include <memory>
#include <variant>
#include <vector>

namespace tilepack {

/// The nodes of a PatternGraph. Each is a block of [LN03, section 3] with its parameters; its inputs are numbers of
/// nodes that stand before it. A node gives one of three kinds of value:
///
///   index     an integer: a pattern, a material, a frame; -1: none
///   number    a double
///   texture   a color (or normal, height, …) for each map of the graph: linear, alpha not multiplied into it
///
/// An index or number is a function of the place and the time. Where its node has a grid it is constant in each cell;
/// a node that needs it for a cell of its own grid (a pattern for each tile, say) asks at that cell's centre. So the
/// grid of an input should be as coarse as that of its user, or coarser: of a finer one only what is at centres counts.
using NodeId = int;
inline constexpr NodeId no_node = -1;

// Nodes that give an index -----------------------------------------------------------------------------------------

struct ConstantIndex {
  std::int64_t value = 0;
};

/// Explicit indirection map, and explicit areas map: the map's own grid, whose values are indices (rounded down), or -1.
struct StoredIndex {
  std::shared_ptr<const StoredMap> map;
};

/// Virtual indirection map (and virtual areas map, with a coarse grid): 0..values-1, equally often.
struct RandomIndex {
  PatternGrid grid;
  int values = 1; ///< 1..65536
  std::uint64_t seed = 0;
  int stream = 0; ///< other streams are uncorrelated: 0..1023
  HashKind hash = HashKind::mix;
};

/// Probability map, animation sequence, any table: entries[index modulo their number]. -1 in, -1 out; entries of -1 are
/// blank. Where `index` is a RandomIndex, its `values` must be a multiple of the number of entries (no bias).
struct TableIndex {
  NodeId index = no_node;
  std::vector<int> entries;
};

/// Materials map: the table of material `material`, at `index`. As TableIndex for each table.
struct MaterialIndex {
  NodeId material = no_node; ///< index
  NodeId index = no_node;    ///< index
  MaterialsMap table;
};

/// Dithered areas map: `areas`, an index that is constant in the cells of `coarse`, dithered between the centres of
/// these: for each cell of the finer `grid` (a multiple of `coarse`) one of the four materials round its centre, with
/// the probabilities of bilinear interpolation.
struct DitheredIndex {
  NodeId areas = no_node; ///< index
  PatternGrid coarse;     ///< the grid of `areas`
  PatternGrid grid;       ///< of the tiles
  std::uint64_t seed = 0;
  int stream = 0;
  HashKind hash = HashKind::mix;
};

/// Pixel map: the material at the place itself, sharp.
struct PixelIndex {
  std::shared_ptr<const PixelMap> map;
};

/// Transition tiles as indices, the way of [LN03]: the transition_code() of what `material` says at the corners of the
/// cells of `grid` (corner (i, j) has the material of cell (i, j)), 0..families⁴-1. A table after it tells the tile.
struct CornerIndex {
  NodeId material = no_node; ///< index, 0..families-1
  PatternGrid grid;
  int families = 2; ///< m, 2..16
};

/// Animation map, and temporal transition: the frame, 0..length-1 (0: at rest), of the AnimationCycle of each cell of
/// `grid` at the whole step of time at hand.
struct AnimationIndex {
  PatternGrid grid;
  int length = 1;           ///< n, 1..65536
  NodeId phase = no_node;   ///< number φ, in steps, rounded down; no_node: 0
  NodeId rest = no_node;    ///< number Z, in steps; no_node: 0
  NodeId density = no_node; ///< number a that multiplies Z; no_node: 1
  /// What was before `changed`; no change where that isn't set.
  NodeId rest_before = no_node;
  NodeId density_before = no_node;
  std::int64_t changed = 0; ///< t₀
  bool changes = false;
};

/// A number as an index: floor(number), held in 0..values-1 (a sequence by distance, say), or taken modulo `values`.
struct FlooredIndex {
  NodeId number = no_node;
  int values = 1;
  bool wrap = false;
};

// Nodes that give a number -----------------------------------------------------------------------------------------

struct ConstantNumber {
  double value = 0;
};

/// Virtual random map: low..high, equally likely. Several uncorrelated numbers a cell: several streams.
struct RandomNumber {
  PatternGrid grid;
  double low = 0, high = 1;
  std::uint64_t seed = 0;
  int stream = 0;
  HashKind hash = HashKind::mix;
};

/// Explicit map of numbers: value * scale + offset, a cell each, or bilinear between centres (`smooth`).
struct StoredNumber {
  std::shared_ptr<const StoredMap> map;
  bool smooth = false;
  double scale = 1, offset = 0;
};

/// Time, in steps; not rounded.
struct TimeNumber {};

/// The distance to the point (x, y), in units, the shortest way round.
struct DistanceNumber {
  NodeId x = no_node, y = no_node; ///< numbers, in units
};

/// An index as a number.
struct IndexedNumber {
  NodeId index = no_node;
};

enum class NumberOperation { add, subtract, multiply, divide, minimum, maximum, modulo, sine };
template <>
inline constexpr auto enum_names<NumberOperation> = std::array{
    EnumName{NumberOperation::add, "add"},           EnumName{NumberOperation::subtract, "subtract"},
    EnumName{NumberOperation::multiply, "multiply"}, EnumName{NumberOperation::divide, "divide"},
    EnumName{NumberOperation::minimum, "minimum"},   EnumName{NumberOperation::maximum, "maximum"},
    EnumName{NumberOperation::modulo, "modulo"},     EnumName{NumberOperation::sine, "sine"}};

/// a + b, …; a / 0 and a mod 0 are 0; modulo is never negative; sine is b sin(2π a) (a in turns, b the amplitude).
struct ArithmeticNumber {
  NumberOperation operation = NumberOperation::add;
  NodeId a = no_node, b = no_node;
};

// Nodes that give a texture ----------------------------------------------------------------------------------------

/// The same everywhere. A map whose values are empty is not there: clear, where it has alpha, else 0.
struct ConstantTexture {
  std::vector<std::vector<double>> values; ///< a map of the graph each, of its number of channels
};

/// A Wang pack, seamless, a tile a cell of `grid`: the cell (x, y) shows what the pack's virtual texture has there.
struct WangTexture {
  std::shared_ptr<const PatternSource> source;
  PatternGrid grid;
};

/// Reference texture with a virtual tile map, and with a tile transform: the pattern `index` in each cell of `grid`.
/// -1, and any other index the set doesn't have: blank (clear, or 0).
///
/// fit none: the pattern fills the cell. `seamless`: a filter that crosses the cell's border reads on in the neighbour's
/// pattern, exactly; else it reads the pattern's outermost texels again.
/// fit shrink, overflow: sparse convolution. x, y as in TileTransform (0..1); scale 0..1 of a cell (overflow: to 1.4),
/// rotation in turns, clockwise. What overlaps is laid over each other, cells to the east and south on top.
struct PatternsTexture {
  std::shared_ptr<const PatternSource> source;
  PatternGrid grid;
  NodeId index = no_node; ///< index
  bool seamless = true;
  TransformFit fit = TransformFit::none;
  NodeId x = no_node, y = no_node; ///< numbers; no_node: 0.5
  NodeId scale = no_node;          ///< number; no_node: 1
  NodeId rotation = no_node;       ///< number; no_node: 0
};

/// Explicit positioning: sprites of a set of patterns, clear between them.
struct SpritesTexture {
  std::shared_ptr<const PatternSource> source;
  std::shared_ptr<const SpriteMap> sprites;
};

/// One of several textures, by an index: what areas maps, dithered areas maps and pixel maps are for. An index that is
/// none of 0..textures.size()-1 is clear (or 0).
struct SelectTexture {
  NodeId index = no_node;
  std::vector<NodeId> textures; ///< textures
};

/// Transition tiles: where the four corners of a cell of `grid` are of one material, what `textures` has for it
/// (pass-through); else the tile of `source`, a set of patterns, for transition_code() of them. Corner (i, j) has the
/// material of cell (i, j) of `material`, whose grid is `grid` or coarser.
struct TransitionTexture {
  NodeId material = no_node; ///< index, 0..textures.size()-1
  PatternGrid grid;
  std::vector<NodeId> textures; ///< m = 2..16 of them
  std::shared_ptr<const PatternSource> source;
  int variants = 1; ///< tiles a code, 1..64: tile = code + variant * m⁴, the variant by hash of the cell
  std::vector<int> tiles = {}; ///< by code + variant * m⁴, the tile in the set; empty: the number itself
  std::uint64_t seed = 0;
  /// Of sets that have several corner colors a material (lookup/material_lookup.h): how many; corner (i, j) has one of
  /// those of its material by hash, and codes are of colors, m times as many, so m⁴ above is (m * this)⁴.
  int colors_of_material = 1;
  /// Plain cells are shown from the set too, which then goes on over all of the scene without a seam; `textures` are not
  /// looked at but for their number. (What they are counts for means over many cells.)
  bool plain_from_set = false;
};

/// The border of one material as tiles on clear ground (border_code(), 2⁴ tiles a variant; tile 15 isn't read, nor 0),
/// over `below`; inside it `inside`.
struct BorderTexture {
  NodeId material = no_node; ///< index
  std::int64_t family = 0;   ///< the material that has the border
  PatternGrid grid;
  std::shared_ptr<const PatternSource> source;
  int variants = 1;
  std::uint64_t seed = 0;
  NodeId inside = no_node; ///< texture
  NodeId below = no_node;  ///< texture
};

/// Height-aware blend: `areas` interpolated between the centres of its cells, and where materials meet, the map `height`
/// of the graph decides which stands out: height_weights(). Normals are blended as slopes, light weighed by alpha.
struct HeightBlendTexture {
  NodeId areas = no_node; ///< index, 0..textures.size()-1, constant in the cells of `grid`
  PatternGrid grid;
  std::vector<NodeId> textures; ///< 2..16
  int height = -1;              ///< map of the graph; -1: all are equally high
  double width = 16;   ///< of the border where heights are equal, in texels of the scene (PatternGraph::unit)
  double relief = 0.5; ///< how far heights bend it, 0..1 of the distance between two centres
};

/// Textures over each other, the first at the bottom; a map without alpha shows the topmost that isn't clear in the
/// graph's first map with alpha (all if there is none: the last).
struct LayersTexture {
  std::vector<NodeId> textures;
};

/// A texture moved by (x, y) units: scrolling, with numbers that depend on time. Numbers that differ from place to place
/// are for small shifts.
struct MovedTexture {
  NodeId texture = no_node;
  NodeId x = no_node, y = no_node; ///< numbers, units; no_node: 0
};

using PatternBlock =
    std::variant<ConstantIndex, StoredIndex, RandomIndex, TableIndex, MaterialIndex, DitheredIndex,
                 PixelIndex, CornerIndex, AnimationIndex, FlooredIndex, ConstantNumber, RandomNumber,
                 StoredNumber, TimeNumber, DistanceNumber, IndexedNumber, ArithmeticNumber, ConstantTexture,
                 WangTexture, PatternsTexture, SpritesTexture, SelectTexture, TransitionTexture,
                 BorderTexture, HeightBlendTexture, LayersTexture, MovedTexture>;

enum class ValueKind { index, number, texture };
template <>
inline constexpr auto enum_names<ValueKind> =
    std::array{EnumName{ValueKind::index, "index"}, EnumName{ValueKind::number, "number"},
               EnumName{ValueKind::texture, "texture"}};

/// What a block gives.
ValueKind kind_of(const PatternBlock& block);

} // namespace tilepack
