#pragma once

#include "tilepack/pack/pack.h"
#include "tilepack/sampler/fast_sampler.h"

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace tilepack {

/// What is known of a pack without its images.
struct PackFacts {
  std::string name; ///< for messages: the folder, or what it is called in the scene
  Size tile_size;   ///< texels of level 0
  int tiles = 0;    ///< 1..65536
  int levels = 0;   ///< of each tile
  std::vector<int>
      map_of; ///< by map of the graph (PatternGraph::maps): its number in the pack, -1: the pack has none
  /// The map of the graph that has alpha in this pack (its last channel), -1: none has. It is the coverage of all maps:
  /// where it is 0, height and normal of a pattern aren't there either. A map of the graph without alpha may have it here.
  int alpha_map = -1;
};

/// The levels of a map that are asked for.
struct PackRequest {
  int map = 0;         ///< in the pack
  int first_level = 0; ///< the finest one needed; with all coarser ones
};

/// A pack as a scene uses it, read when a texel of it is first needed: map by map, and from the finest level that is
/// looked at. What no visible texel uses is never asked for.
///
/// A *Wang pack* is looked up by its own mapping. A *set of patterns* is looked up by tile: tile p stands for pattern p
/// wherever it is asked for, whatever mapping and layout the pack has; its tiles end at their borders (the texels beyond are the
/// outermost ones again), so nothing of a neighbour in the stored texture shows: [LN03, section 5.2]'s "sub-textures".
class PatternSource {
public:
  /// Called for a map and levels that nothing was read of so far, or only coarser ones; by one thread at a time. Gives a
  /// pack of one map (maps[0]) with levels request.first_level and up: tile_size and tile_levels as if the first of
  /// these were level 0 (from_level() makes one such of a whole pack). What it throws is thrown to who asked.
  using Open = std::function<Pack(const PackRequest&)>;

  PatternSource(PackFacts facts, Open open);
  ~PatternSource();
  PatternSource(const PatternSource&) = delete;
  PatternSource& operator=(const PatternSource&) = delete;

  const PackFacts& facts() const { return about; }

  /// Whether it has map `map` of the graph.
  bool has(int map) const { return about.map_of[static_cast<std::size_t>(map)] >= 0; }

  /// The levels of a map (of the graph) that are ready, `first_level` the finest of them.
  struct Levels {
    int first_level = 0;
    const FastSampler* wang = nullptr;       ///< by the pack's mapping
    const FastSampler* patterns = nullptr;   ///< tile_x = pattern, tile_y = 0
    std::vector<std::array<float, 4>> means; ///< by tile: linear, color not multiplied by alpha
    std::array<double, 4> mean{};            ///< of all tiles alike
    std::array<double, 4> deviation{}; ///< of the tiles' means round it: standard deviation, a channel each
  };
  /// As wang or patterns asks, with level `level` (clamped to those there are) and all coarser ones. Reads what isn't
  /// there yet.
  enum class Use { wang, patterns };
  const Levels& levels(int map, Use use, int level) const;

  /// Map `map` of the graph with level `first_level` and all coarser ones, read anew, as its sampler has it: of `patterns`
  /// a layer a tile.
  Pack stored_pack(int map, Use use, int first_level = 0) const;

  /// What was read so far.
  int openings() const { return opened.load(); }    ///< calls of `open`
  int finest_level(int map) const;                  ///< -1: nothing of that map (of the graph)
  std::size_t bytes() const { return held.load(); } ///< that samplers hold

private:
  struct Stored;
  Pack opened_pack(int map, int first_level) const;
  PackFacts about;
  Open opener;
  mutable std::mutex opening;
  mutable std::atomic<int> opened{0};
  mutable std::atomic<std::size_t> held{0};
  std::unique_ptr<Stored> stored;
};

/// Map `map` of a whole pack from level `first_level` on, as PatternSource::Open is to give it.
Pack from_level(const Pack& pack, const PackRequest& request);

/// A source that has a whole pack in memory. `map_of` as in PackFacts; empty: map i of the graph is map i of the pack.
std::shared_ptr<const PatternSource> source_of(std::shared_ptr<const Pack> pack, std::string name,
                                               std::vector<int> map_of = {});

/// A set of patterns from images of one size, one a pattern, with as many levels as their sides allow (down to one texel
/// on the shorter side): the reference texture of [LN03] as a pack. Levels are means of 2 x 2 texels.
Pack pattern_pack(const std::vector<Image>& patterns, const MapFormat& format);

} // namespace tilepack
