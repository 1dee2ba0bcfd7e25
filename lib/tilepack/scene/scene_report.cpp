#include "tilepack/scene/scene_report.h"

#include "tilepack/json/json_value.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

namespace tilepack {
namespace {

std::string megabytes(std::size_t bytes) {
  if (bytes < 1'000'000) return fmt::format("{:.0f} kB", static_cast<double>(bytes) / 1e3);
  return fmt::format("{:.1f} MB", static_cast<double>(bytes) / 1e6);
}

std::string listed(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text.empty() ? "none" : text;
}

} // namespace

std::size_t SceneReport::held_bytes() const {
  return std::accumulate(files.begin(), files.end(), texture_bytes + band_bytes,
                         [](std::size_t sum, const SceneFileUse& use) { return sum + use.bytes; });
}

std::vector<SceneReport::Node> scene_report_nodes(const SceneFile& scene, const SceneGraph& made,
                                                  const std::vector<bool>& used) {
  std::vector<SceneReport::Node> nodes;
  for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
    const NodeId node = made.node_of[i];
    nodes.push_back({scene.nodes[i].name, scene.nodes[i].block->name,
                     node != no_node && static_cast<std::size_t>(node) < used.size() &&
                         used[static_cast<std::size_t>(node)]});
  }
  // Users stand behind what they use, and grids and places are no values of their own.
  for (std::size_t i = scene.nodes.size(); i-- > 0;) {
    if (!nodes[i].is_used) continue;
    for (const auto& [name, value] : scene.nodes[i].inputs) {
      if (value.node < 0) continue;
      const SceneKind kind = scene.nodes[static_cast<std::size_t>(value.node)].gives;
      if (kind == SceneKind::grid || kind == SceneKind::place)
        nodes[static_cast<std::size_t>(value.node)].is_used = true;
    }
  }
  std::sort(nodes.begin(), nodes.end(), [](const auto& a, const auto& b) { return a.name < b.name; });
  return nodes;
}

std::string scene_report_text(const SceneReport& report) {
  std::vector<std::string> used, skipped, read, left;
  for (const SceneReport::Node& node : report.nodes) (node.is_used ? used : skipped).push_back(node.name);
  for (const SceneFileUse& use : report.files)
    if (use.openings > 0)
      read.push_back(fmt::format("{} ({}{})", use.file, megabytes(use.bytes),
                                 use.openings > 1 ? fmt::format(", opened {} times", use.openings) : ""));
    else
      left.push_back(use.file);
  std::string text =
      fmt::format("{}: {} x {} pixels of {}{}\n", report.scene, report.picture.width, report.picture.height,
                  report.map, report.frames > 1 ? fmt::format(", {} frames", report.frames) : "");
  text += fmt::format("  nodes used     {}\n  nodes skipped  {}\n", listed(used), listed(skipped));
  text += fmt::format("  files read     {}\n  files skipped  {}\n", listed(read), listed(left));
  text += fmt::format("  memory held    {} ({} of them for rows of the picture)\n",
                      megabytes(report.held_bytes()), megabytes(report.band_bytes));
  return text;
}

std::string scene_report_json(const SceneReport& report) {
  JsonValue nodes = JsonValue::array();
  for (const SceneReport::Node& node : report.nodes)
    nodes.push_back({{"name", node.name}, {"block", node.block}, {"used", node.is_used}});
  JsonValue files = JsonValue::array();
  for (const SceneFileUse& use : report.files)
    files.push_back(
        {{"file", use.file}, {"kind", use.kind}, {"openings", use.openings}, {"bytes", use.bytes}});
  return json_text(
      {{"scene", report.scene},
       {"map", report.map},
       {"picture", JsonValue::array({report.picture.width, report.picture.height})},
       {"frames", report.frames},
       {"nodes", std::move(nodes)},
       {"files", std::move(files)},
       {"bytes",
        {{"held", report.held_bytes()}, {"texture", report.texture_bytes}, {"rows", report.band_bytes}}}});
}

} // namespace tilepack
