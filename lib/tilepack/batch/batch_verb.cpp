#include "tilepack/batch/batch_verb.h"

#include <algorithm>
#include <array>

namespace tilepack {

std::span<const BatchVerb> batch_verbs() {
  constexpr BatchSource pack{"pack", "packs", true, false};
  static const std::vector<BatchVerb> verbs{
      {"bake", BatchOutput::pack, {{"sample", "samples"}}, {}, {"report"}},
      {"pack", BatchOutput::pack, {{"tiles", "", false, true}}, {"colors"}},
      {"render", BatchOutput::file, {pack}, {"mesh"}},
      {"compose", BatchOutput::file, {{"scene", "scenes"}}, {"mesh"}},
      {"shader", BatchOutput::file, {pack}},
      {"view", BatchOutput::file, {pack}},
      {"inspect", BatchOutput::printed, {pack}, {}, {"picture"}},
      {"validate", BatchOutput::printed, {pack}},
      {"compare", BatchOutput::printed, {{"a", "", true}, {"b", "", true}}},
  };
  return verbs;
}

const BatchVerb* batch_verb_called(std::string_view name) {
  const auto verbs = batch_verbs();
  const auto found =
      std::find_if(verbs.begin(), verbs.end(), [&](const BatchVerb& v) { return v.name == name; });
  return found == verbs.end() ? nullptr : &*found;
}

std::vector<std::string> batch_verb_names() {
  std::vector<std::string> names;
  for (const BatchVerb& verb : batch_verbs()) names.emplace_back(verb.name);
  return names;
}

bool is_beside_the_output(std::string_view option) {
  static constexpr std::array beside{std::string_view("jobs"), std::string_view("report"),
                                     std::string_view("quiet"), std::string_view("max-texels")};
  return std::find(beside.begin(), beside.end(), option) != beside.end();
}

} // namespace tilepack
