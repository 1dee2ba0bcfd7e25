#include "tilepack/shader/program_printer.h"

#include <fmt/format.h>

namespace tilepack {
namespace {

// GLSL 3.30, GLSL ES 3.00; and the language of Godot 4, which has other array constants and no names of its own for
// sampled derivatives in functions.
class GlslPrinter : public ProgramPrinter {
public:
  GlslPrinter(PrintSettings settings, bool for_godot)
      : ProgramPrinter(std::move(settings)), godot(for_godot) {}

protected:
  TypeNames types() const override { return {"uint", "int", "float", "bool", "vec4"}; }

  std::vector<std::string> texture_parameters(const LookupFunction& function) const override {
    std::vector<std::string> texts;
    if (function.reads_tiles) texts.emplace_back(to.layers ? "sampler2DArray tiles" : "sampler2D tiles");
    if (function.reads_corners) texts.emplace_back("sampler2D corners");
    if (function.reads_ids) texts.emplace_back("usampler2D ids");
    return texts;
  }

  std::string table(const LookupTable& table) const override {
    const std::string lines = table_lines(table, "u");
    const std::size_t count = table.words.size();
    return fmt::format("const uint {}[{}] = {};\n", name(table.name), count,
                       godot ? "{" + lines + "}" : fmt::format("uint[{}]({})", count, lines));
  }

  std::string fetch(const ExpressionNode& node) const override {
    const auto at = [&](std::size_t i) { return expression(node.operands[i]); };
    const bool layers = to.layers && node.slot == PackTextureSlot::tiles;
    const std::string map = slot_name(node);
    switch (node.operation) {
    case Operation::fetch_id:
      return fmt::format("texelFetch(ids, ivec2(int({}), int({})), 0).x", at(0), at(1));
    case Operation::fetch_texel:
      return layers ? fmt::format("texelFetch({}, ivec3({}, {}, {}), {})", map, at(0), at(1), at(2), at(3))
                    : fmt::format("texelFetch({}, ivec2({}, {}), {})", map, at(0), at(1), at(3));
    case Operation::fetch_level:
      return fmt::format("textureLod({}, {}, {})", map, place(node, layers), at(3));
    default:
      break;
    }
    return fmt::format("textureGrad({}, {}, vec2({}, {}), vec2({}, {}))", map, place(node, layers), at(3),
                       at(4), at(5), at(6));
  }

  std::string epilogue(const LookupProgram& program) const override {
    const LookupFunction* grad = program.function("grad");
    if (grad == nullptr) return {};
    // What a fragment program calls.
    return two_comments(
               "At `place`, in tiles, anywhere; for the fragment stage, and within some 10^5 tiles of the "
               "origin: farther",
               "out hand the tile and the fraction to the functions above, and derivatives of your own.") +
           fmt::format("vec4 {}({}, vec2 place) {{\n"
                       "  vec2 cell = floor(place), dx = dFdx(place), dy = dFdy(place);\n"
                       "  vec2 fraction = min(place - cell, vec2(0.99999994));\n"
                       "  return {}({}, int(cell.x), int(cell.y), fraction.x, fraction.y, dx.x, dx.y, dy.x, "
                       "dy.y);\n}}\n",
                       name("sample"), listed(texture_parameters(*grad)), name("grad"),
                       listed(texture_arguments(*grad)));
  }

private:
  std::string two_comments(const std::string& first, const std::string& second) const {
    return ProgramPrinter::comment(first) + ProgramPrinter::comment(second);
  }

  std::string place(const ExpressionNode& node, bool layers) const {
    const std::string u = expression(node.operands[0]), v = expression(node.operands[1]);
    if (layers) return fmt::format("vec3({}, {}, float({}))", u, v, expression(node.operands[2]));
    return fmt::format("vec2({}, {})", u, v);
  }

  bool godot;
};

} // namespace

std::unique_ptr<ProgramPrinter> glsl_printer(PrintSettings settings, bool godot) {
  return std::make_unique<GlslPrinter>(std::move(settings), godot);
}

} // namespace tilepack
