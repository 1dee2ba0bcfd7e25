#include "tilepack/scene/scene_file.h"

#include "tilepack/bake/text_file.h"
#include "tilepack/error/nearest_name.h"
#include "tilepack/json/json_cursor.h"
#include "tilepack/json/json_line.h"
#include "tilepack/scene/scene_limits.h"
#include "tilepack/scene/scene_values.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <optional>

namespace tilepack {
namespace {

std::string words_of(const std::vector<SceneKind>& kinds) {
  std::string words;
  for (const SceneKind kind : kinds) {
    if (!words.empty()) words += " or ";
    words += kind == SceneKind::index ? "an " : "a ";
    words += name_of(kind);
  }
  return words;
}

class SceneReader {
public:
  SceneReader(std::string text, const std::string& file) {
    scene.file = file;
    scene.text = std::move(text);
  }

  SceneReading read() {
    try {
      const JsonCursor root = JsonCursor::parse(scene.text, scene.file);
      is_parsed = true;
      read_root(root);
    } catch (const Error& error) {
      // A document that can't be parsed has no places.
      note(is_parsed ? SceneFault::field : SceneFault::not_json, error);
    }
    return {std::move(scene), std::move(problems)};
  }

private:
  void read_root(const JsonCursor& root) {
    attempt([&] { root.only({"format", "version", "size", "seed", "maps", "nodes", "output"}); });
    attempt([&] { root.member("format").one_of({"tilepack-scene"}); });
    attempt([&] { root.member("version").integer(1, 1); });
    attempt([&] {
      const JsonCursor size = root.member("size");
      size.array(2, 2);
      for (std::size_t i = 0; i < 2; ++i)
        scene.size[i] = size.item(i).integer(1, static_cast<std::int64_t>(scene_limits::most_texels));
    });
    attempt([&] {
      if (const auto seed = root.find("seed"))
        scene.seed = static_cast<std::uint64_t>(seed->integer(0, std::int64_t{1} << 53));
    });
    attempt([&] { scene.maps = scene_maps(root.find("maps")); });
    std::optional<JsonCursor> list;
    attempt([&] { list = root.member("nodes"); });
    if (!list) return;
    attempt([&] {
      node_names = list->names();
      if (node_names.empty()) list->fail("holds no node; name at least the one to show");
      if (node_names.size() > scene_limits::most_nodes)
        list->fail(
            fmt::format("holds {} nodes; the most are {}", node_names.size(), scene_limits::most_nodes));
    });
    if (node_names.size() > scene_limits::most_nodes) return;
    for (const std::string& name : node_names) {
      SceneNode node;
      node.name = name;
      if (!is_plain(name)) {
        add(SceneFault::field, "nodes",
            "a node's name is 1 to 64 letters, digits, - and _; rename the one that isn't");
        scene.nodes.push_back(std::move(node));
        continue;
      }
      attempt([&] { read_block(list->member(name), node); });
      scene.nodes.push_back(std::move(node));
    }
    for (std::size_t i = 0; i < node_names.size(); ++i)
      if (scene.nodes[i].block != nullptr) read_inputs(list->member(node_names[i]), scene.nodes[i]);
    attempt([&] { scene.output = node_called(root.member("output")); });
    check_kinds();
    if (scene.output >= 0) check_output();
    find_order();
  }

  // So that places in messages can be read and be found again.
  static bool is_plain(const std::string& name) {
    return !name.empty() && name.size() <= scene_limits::longest_name &&
           std::all_of(name.begin(), name.end(), [](char c) {
             return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' ||
                    c == '_';
           });
  }

  void read_block(const JsonCursor& at, SceneNode& node) {
    const JsonCursor block = at.member("block");
    const std::string name = block.text();
    node.block = scene_block_called(name);
    if (node.block == nullptr) {
      const std::vector<std::string> known = scene_block_names();
      const std::string nearest = nearest_name(name, known);
      add(SceneFault::unknown_block, place_of(node, "block"),
          nearest.empty() ? fmt::format("{} is no block; there are {}", block.shown(), fmt::join(known, ", "))
                          : fmt::format("{} is no block; did you mean \"{}\"?", block.shown(), nearest));
      return;
    }
    node.gives = node.block->gives;
  }

  void read_inputs(const JsonCursor& at, SceneNode& node) {
    std::vector<std::string> known{"block"};
    for (const SceneInput& input : node.block->inputs) known.emplace_back(input.name);
    attempt([&] { at.only(known); });
    for (const SceneInput& input : node.block->inputs) {
      const auto given = at.find(input.name);
      if (!given) {
        if (input.is_required)
          add(SceneFault::field, place_of(node, ""),
              fmt::format("the input \"{}\" is missing: {}", input.name, input.what));
        continue;
      }
      attempt([&] { node.inputs[std::string(input.name)] = read_value(*given, input); });
    }
  }

  SceneValue read_value(const JsonCursor& at, const SceneInput& input) {
    SceneValue value;
    if (input.form == SceneForm::nodes) {
      const std::size_t count = at.array(1, scene_limits::most_nodes);
      for (std::size_t i = 0; i < count; ++i) value.nodes.push_back(node_called(at.item(i)));
    } else if (input.form == SceneForm::node && at.is_text()) {
      value.node = node_called(at);
    } else {
      value = scene_constant(at, input);
    }
    return value;
  }

  // -1, and a problem more, if there is none.
  int node_called(const JsonCursor& at) {
    const std::string name = at.text();
    const auto found = std::lower_bound(node_names.begin(), node_names.end(), name);
    if (found != node_names.end() && *found == name) return static_cast<int>(found - node_names.begin());
    const std::string nearest = nearest_name(name, node_names);
    try {
      at.fail(nearest.empty()
                  ? fmt::format("{} is no node of the scene", at.shown())
                  : fmt::format("{} is no node of the scene; did you mean \"{}\"?", at.shown(), nearest));
    } catch (const Error& error) {
      note(SceneFault::unknown_node, error);
    }
    return -1;
  }

  void check_kinds() {
    for (const SceneNode& node : scene.nodes) {
      for (const auto& [name, value] : node.inputs) {
        const SceneInput& input = *node.block->find(name);
        if (value.node >= 0) check_kind(input, value.node, place_of(node, name));
        for (std::size_t i = 0; i < value.nodes.size(); ++i)
          if (value.nodes[i] >= 0)
            check_kind(input, value.nodes[i], fmt::format("{}[{}]", place_of(node, name), i));
      }
    }
  }

  void check_kind(const SceneInput& input, int given, const std::string& place) {
    const SceneNode& node = scene.nodes[static_cast<std::size_t>(given)];
    if (node.block == nullptr) return; // told of already
    if (contains(input.kinds, node.gives)) return;
    add(SceneFault::wrong_kind, place,
        fmt::format("takes {}, and \"{}\" ({}) gives {}", words_of(input.kinds), node.name, node.block->name,
                    words_of({node.gives})));
  }

  static bool contains(const std::vector<SceneKind>& kinds, SceneKind kind) {
    return std::find(kinds.begin(), kinds.end(), kind) != kinds.end();
  }

  void check_output() {
    const SceneNode& node = scene.nodes[static_cast<std::size_t>(scene.output)];
    if (node.block != nullptr && node.gives != SceneKind::texture)
      add(SceneFault::wrong_kind, "output",
          fmt::format("takes a texture, and \"{}\" ({}) gives {}", node.name, node.block->name,
                      words_of({node.gives})));
  }

  // Whoever is left when all whose inputs are there have been taken away is made from itself.
  void find_order() {
    const std::size_t count = scene.nodes.size();
    std::vector<std::vector<int>> uses(count);
    for (std::size_t i = 0; i < count; ++i)
      for (const auto& [name, value] : scene.nodes[i].inputs) {
        if (value.node >= 0) uses[i].push_back(value.node);
        for (const int node : value.nodes)
          if (node >= 0) uses[i].push_back(node);
      }
    std::vector<std::vector<int>> users(count);
    std::vector<std::size_t> waits(count);
    std::vector<int> order;
    for (std::size_t i = 0; i < count; ++i) {
      waits[i] = uses[i].size();
      for (const int used : uses[i]) users[static_cast<std::size_t>(used)].push_back(static_cast<int>(i));
      if (waits[i] == 0) order.push_back(static_cast<int>(i));
    }
    for (std::size_t done = 0; done < order.size(); ++done)
      for (const int user : users[static_cast<std::size_t>(order[done])])
        if (--waits[static_cast<std::size_t>(user)] == 0) order.push_back(user);
    if (order.size() < count) {
      add_circle(uses, waits);
      return;
    }
    note_unused(uses);
    put_in(order);
  }

  void add_circle(const std::vector<std::vector<int>>& uses, const std::vector<std::size_t>& waits) {
    std::size_t at = 0;
    while (waits[at] == 0) ++at;
    // From one that waits to one that it waits for, until one comes again.
    std::vector<std::size_t> way;
    while (std::find(way.begin(), way.end(), at) == way.end()) {
      way.push_back(at);
      at = static_cast<std::size_t>(*std::find_if(uses[at].begin(), uses[at].end(), [&](int used) {
        return waits[static_cast<std::size_t>(used)] != 0;
      }));
    }
    way.erase(way.begin(), std::find(way.begin(), way.end(), at));
    std::string path;
    for (const std::size_t step : way) path += fmt::format("\"{}\" from ", scene.nodes[step].name);
    add(SceneFault::circle, place_of(scene.nodes[at], ""),
        fmt::format("is made from itself: {}\"{}\"", path, scene.nodes[at].name));
  }

  void note_unused(const std::vector<std::vector<int>>& uses) {
    // What a name that leads nowhere was to show can't be told.
    const auto cuts = [](const SceneProblem& problem) {
      return problem.fault == SceneFault::unknown_node || problem.fault == SceneFault::unknown_block ||
             problem.fault == SceneFault::field;
    };
    if (scene.output < 0 || std::any_of(problems.begin(), problems.end(), cuts)) return;
    std::vector<char> is_used(uses.size(), 0);
    std::vector<int> open{scene.output};
    while (!open.empty()) {
      const auto at = static_cast<std::size_t>(open.back());
      open.pop_back();
      if (is_used[at] != 0) continue;
      is_used[at] = 1;
      open.insert(open.end(), uses[at].begin(), uses[at].end());
    }
    for (std::size_t i = 0; i < uses.size(); ++i)
      if (is_used[i] == 0)
        add(SceneFault::unused, place_of(scene.nodes[i], ""), "nothing that is shown is made from it");
  }

  void put_in(const std::vector<int>& order) {
    std::vector<int> now(order.size());
    for (std::size_t i = 0; i < order.size(); ++i)
      now[static_cast<std::size_t>(order[i])] = static_cast<int>(i);
    std::vector<SceneNode> nodes;
    for (const int old : order) nodes.push_back(std::move(scene.nodes[static_cast<std::size_t>(old)]));
    for (SceneNode& node : nodes)
      for (auto& [name, value] : node.inputs) {
        if (value.node >= 0) value.node = now[static_cast<std::size_t>(value.node)];
        for (int& listed : value.nodes)
          if (listed >= 0) listed = now[static_cast<std::size_t>(listed)];
      }
    scene.nodes = std::move(nodes);
    if (scene.output >= 0) scene.output = now[static_cast<std::size_t>(scene.output)];
  }

  template <class Work>
  void attempt(Work work) {
    try {
      work();
    } catch (const Error& error) {
      note(SceneFault::field, error);
    }
  }

  void note(SceneFault fault, const Error& error) {
    const std::string prefix = scene.file + ": ";
    const std::string place = error.where().starts_with(prefix) ? error.where().substr(prefix.size()) : "";
    add(fault, place, error.what_happened());
  }

  void add(SceneFault fault, const std::string& place, const std::string& what) {
    if (problems.size() >= most_problems) return;
    problems.push_back({fault, place, place.empty() ? 1 : json_line(scene.text, place), what});
  }

  static std::string place_of(const SceneNode& node, std::string_view input) {
    return input.empty() ? fmt::format("nodes.{}", node.name) : fmt::format("nodes.{}.{}", node.name, input);
  }

  static constexpr std::size_t most_problems = 100;

  SceneFile scene;
  std::vector<SceneProblem> problems;
  std::vector<std::string> node_names; // in order, as scene.nodes until they are put in theirs
  bool is_parsed = false;
};

} // namespace

const SceneValue* SceneNode::find(std::string_view input) const {
  const auto found = inputs.find(input);
  return found == inputs.end() ? nullptr : &found->second;
}

int SceneNode::node_at(std::string_view input) const {
  const SceneValue* value = find(input);
  return value == nullptr ? -1 : value->node;
}

double SceneNode::number(std::string_view input) const {
  const SceneValue* value = find(input);
  return value == nullptr || value->numbers.empty() ? block->find(input)->fallback : value->numbers.front();
}

std::string_view SceneNode::word(std::string_view input) const {
  if (const SceneValue* value = find(input)) return value->texts.front();
  const auto& choices = block->find(input)->choices;
  return choices.empty() ? std::string_view() : choices.front();
}

std::string SceneFile::resolved(const std::string& path) const {
  return (std::filesystem::path(file).parent_path() / path).lexically_normal().string();
}

std::string SceneFile::place(const SceneNode& node, std::string_view input) const {
  const std::string at =
      input.empty() ? fmt::format("nodes.{}", node.name) : fmt::format("nodes.{}.{}", node.name, input);
  return fmt::format("{}:{}: {}", file, json_line(text, at), at);
}

SceneReading scene_reading(std::string text, const std::string& file) {
  return SceneReader(std::move(text), file).read();
}

SceneFile parsed_scene(std::string text, const std::string& file) {
  SceneReading reading = scene_reading(std::move(text), file);
  for (const SceneProblem& problem : reading.problems)
    if (problem.fault != SceneFault::unused) throw error_of(problem, file);
  return std::move(reading.scene);
}

bool is_scene_file(const std::string& file) {
  std::error_code fault;
  if (!std::filesystem::is_regular_file(file, fault) || std::filesystem::path(file).filename() == "pack.json")
    return false;
  std::ifstream stream(file, std::ios::binary);
  std::string head(65536, ' '); // before it stand white space and other fields
  stream.read(head.data(), static_cast<std::streamsize>(head.size()));
  return head.find("tilepack-scene") != head.npos;
}

SceneFile read_scene(const std::string& file) {
  std::error_code fault;
  if (std::filesystem::is_directory(file, fault) || std::filesystem::path(file).filename() == "pack.json")
    throw Error(ErrorKind::invalid_content, file, "is no scene but a folder or a pack; render shows packs");
  return parsed_scene(read_text_file(file, "the scene"), file);
}

} // namespace tilepack
