#pragma once

#include "tilepack/pattern/grid_walk.h"
#include "tilepack/pattern/pattern_graph.h"
#include "tilepack/sampler/texture.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace tilepack {

/// How a pixel of a scene is filtered.   [LN03, section 5]
enum class PatternFilter {
  nearest,     ///< the texel that holds the place, of the level next to the pixel's size
  bilinear,    ///< in that level
  trilinear,   ///< in the two levels next to the size of the footprint's longer half axis
  anisotropic, ///< up to 16 of these along the longer axis
  supersampled, ///< the mean of many bilinear samples of level 0 all over the footprint: slow, what the rest is held against
};
template <>
inline constexpr auto enum_names<PatternFilter> =
    std::array{EnumName{PatternFilter::nearest, "nearest"}, EnumName{PatternFilter::bilinear, "bilinear"},
               EnumName{PatternFilter::trilinear, "trilinear"},
               EnumName{PatternFilter::anisotropic, "anisotropic"},
               EnumName{PatternFilter::supersampled, "supersampled"}};

struct PatternOptions {
  PatternFilter filter = PatternFilter::trilinear;
  double time = 0; ///< in steps; |time| up to 2^40
  /// supersampled: samples a side of the pixel's parallelogram, 1..64.
  int samples = 16;
  /// The longest side of an explicit coarse map, in cells of one texel each, 0..8192: where the scene has no more (units),
  /// pixels that cover several are filtered from such a map; 0: never.
  int coarse_map = 1024;
};

/// One map of a pattern graph, looked at. Units are those of the scene.
///
/// Levels are chosen by the footprint: down to one texel a tile from the tiles' own levels. Beyond, where one pixel covers
/// several tiles: a few samples all over it (up to 4 x 4 cells of the finest grid), then an explicit coarse map, if the
/// scene is small enough for one, or the mean that the probabilities of the place give (the law of large numbers); one
/// fades into the other over an octave, so no step shows. mean_error() says what the last costs.
///
/// Values are floats computed with the vector units at hand: the same for any number of threads and any cutting of a
/// picture into runs that start where the picture does; last bits may differ between kinds of processors, as those of
/// FastSampler.
class PatternTexture final : public Texture {
public:
  /// `graph` is copied. map: of graph.maps. Throws what check_pattern_graph() does, and Error (usage) for a map that isn't
  /// there or options out of range. Opens nothing.
  PatternTexture(const PatternGraph& graph, int map, const PatternOptions& options = {});
  ~PatternTexture() override;

  int channels() const override;
  void sample(TileCoordinate u, TileCoordinate v, const Footprint& footprint,
              std::span<double> out) const override;

  /// The same for the pixels of a row, whose footprints are all alike: many at once, the fast way. out[c][i] for pixel i,
  /// channels() arrays of run.count entries.
  void sample_run(const PatternRun& run, const Footprint& footprint, std::span<float* const> out) const;

  /// The nodes that were evaluated so far, by number.
  std::vector<bool> used_nodes() const;
  /// What this holds itself: the coarse map and tables of shares. Sources and stored maps tell theirs.
  std::size_t bytes() const;

  /// The mean of the map round a place over a footprint that covers many cells, by the probabilities there, and its
  /// expected error (standard deviation, the largest of all channels): the tiles' deviation from their mean over the
  /// square root of how many the footprint covers.
  struct Mean {
    std::vector<double> value;
    double error = 0;
  };
  Mean mean_error(const PatternPlace& place, const Footprint& footprint) const;

private:
  struct State;
  std::unique_ptr<State> state;
};

/// The index and the number that a node has at a place and time, for reports, pictures of maps and tests. Error (usage)
/// if the node is of another kind.
std::int64_t index_at(const PatternGraph& graph, NodeId node, const PatternPlace& place, double time = 0);
double number_at(const PatternGraph& graph, NodeId node, const PatternPlace& place, double time = 0);

} // namespace tilepack
