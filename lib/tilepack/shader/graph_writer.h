#pragma once

#include "tilepack/pattern/pattern_values.h"
#include "tilepack/shader/graph_program.h"

#include <initializer_list>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace tilepack {

/// Writes a GraphProgram: graph_program() drives it.
class GraphWriter {
public:
  explicit GraphWriter(const PatternGraph& of_graph) : graph(of_graph), values(of_graph, 0) {}

  GraphProgram write();

private:
  friend struct ValueText;
  friend struct TextureText;

  /// `text` with every $NAME in it replaced.
  static std::string filled(std::string_view text,
                            std::initializer_list<std::pair<std::string_view, std::string>> names);
  static std::string real(double value); ///< a literal
  [[noreturn]] void refuse(NodeId node, const std::string& what) const;

  /// What is known of a pack whose lookup is in `common`.
  struct WangFacts {
    int any = 0; ///< a map of the graph that it has
    bool layers = false, ids = false, corners = false;
  };

  std::string value_text(NodeId node); ///< of an index or number: index_N(Place p), number_N(Place p)
  std::string texture_text(NodeId node, int map); ///< texture_N_M(Place p, vec4 d)

  static std::string divided(const std::string& word, std::int64_t by); ///< word / by
  static std::string rest(const std::string& word, std::int64_t by);    ///< word % by
  std::string grid(PatternGrid of); ///< N of in_grid_N() and centre_N(), which are made for it
  /// The cell `by` (an ivec2, two cells at most) from `cell`.
  std::string neighbour(std::string_view cell, std::string_view by, PatternGrid grid) const;
  std::string cell_count(PatternGrid grid) const;   ///< "uvec2(w, h)"
  std::string cells_a_unit(PatternGrid grid) const; ///< "vec4(…)", for derivatives
  /// By a hash of the node, of a uvec2; the number is 0 to below 1.
  std::string hashed_index(const CellHash& hash, std::string_view cell, NodeId node);
  std::string hashed_number(const CellHash& hash, std::string_view cell, NodeId node);
  std::string number_or(NodeId node, std::string_view place, double otherwise) const;

  // In `tables`; the first word's number. What is stored for every map of the graph lies there once, known by where its
  // `words` are in the graph.
  void make_room(std::size_t more, NodeId node) const; ///< refuses what is beyond a program
  std::string table(const std::vector<std::int32_t>& words, NodeId node);
  template <class Words>
  std::string table_once(const Words& words, NodeId node);
  std::string stored_map(const StoredMap& map, bool is_whole, NodeId node);

  /// Functions that read a source, made once a source, map and use; their names.
  std::string pattern_reader(NodeId node, const std::shared_ptr<const PatternSource>& source, int map);
  std::string wang_reader(NodeId node, const WangTexture& block, int map);
  const WangFacts& wang_facts(NodeId node, const PatternSource& source, int number);
  int sampler(GraphSampler::Kind kind, const std::shared_ptr<const PatternSource>& source, int map,
              bool is_array);
  int source_number(const std::shared_ptr<const PatternSource>& source);
  bool is_vector_map(int map) const;

  const PatternGraph& graph;
  PatternValues values;
  GraphProgram program;
  GraphMapText* part = nullptr; ///< the text of a map that is being written
  std::vector<std::shared_ptr<const PatternSource>> sources;
  std::vector<std::string> readers;                        ///< names of functions that the part has
  std::vector<std::pair<const void*, std::string>> placed; ///< what lies in the tables already
  std::vector<PatternGrid> grids;
  std::map<int, WangFacts> wangs; ///< by number of the source
};

template <class Words>
std::string GraphWriter::table_once(const Words& words, NodeId node) {
  for (const auto& [known, where] : placed)
    if (known == &words) return where;
  placed.emplace_back(&words, table({words.begin(), words.end()}, node));
  return placed.back().second;
}

} // namespace tilepack
