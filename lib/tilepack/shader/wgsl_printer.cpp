#include "tilepack/shader/program_printer.h"

#include <fmt/format.h>

namespace tilepack {
namespace {

class WgslPrinter : public ProgramPrinter {
public:
  using ProgramPrinter::ProgramPrinter;

protected:
  TypeNames types() const override { return {"u32", "i32", "f32", "bool", "vec4f"}; }

  std::vector<std::string> texture_parameters(const LookupFunction& function) const override {
    std::vector<std::string> texts;
    if (function.reads_tiles)
      texts.emplace_back(to.layers ? "tiles: texture_2d_array<f32>" : "tiles: texture_2d<f32>");
    if (function.reads_corners) texts.emplace_back("corners: texture_2d<f32>");
    if (function.reads_ids) texts.emplace_back("ids: texture_2d<u32>");
    if (function.reads_tiles) texts.emplace_back("state: sampler");
    return texts;
  }

  std::vector<std::string> texture_arguments(const LookupFunction& function) const override {
    std::vector<std::string> texts = ProgramPrinter::texture_arguments(function);
    if (function.reads_tiles) texts.emplace_back("state");
    return texts;
  }

  std::string table(const LookupTable& table) const override {
    return fmt::format("const {} = array<u32, {}>({});\n", name(table.name), table.words.size(),
                       table_lines(table, "u"));
  }

  std::string parameter(const FunctionParameter& p) const override { return p.name + ": " + type(p.type); }

  std::string head(const LookupFunction& function) const override {
    std::vector<std::string> parameters = texture_parameters(function);
    for (const FunctionParameter& p : function.parameters) parameters.push_back(parameter(p));
    return fmt::format("fn {}({}) -> {} {{\n", name(function.name), listed(parameters), type(function.type));
  }

  std::string statement(const Statement& s, const std::string& indent) const override {
    if (s.kind == Statement::Kind::declare)
      return fmt::format("{}var {} = {};\n", indent, s.name, expression(s.value));
    return ProgramPrinter::statement(s, indent);
  }

  std::string choice(const ExpressionNode& node) const override {
    return fmt::format("select({}, {}, {})", expression(node.operands[2]), expression(node.operands[1]),
                       expression(node.operands[0]));
  }

  std::string fetch(const ExpressionNode& node) const override {
    const auto at = [&](std::size_t i) { return expression(node.operands[i]); };
    const std::string layer = to.layers && node.slot == PackTextureSlot::tiles ? at(2) + ", " : "";
    const std::string map = slot_name(node);
    switch (node.operation) {
    case Operation::fetch_id:
      return fmt::format("textureLoad(ids, vec2u({}, {}), 0).x", at(0), at(1));
    case Operation::fetch_texel:
      return fmt::format("textureLoad({}, vec2i({}, {}), {}{})", map, at(0), at(1), layer, at(3));
    case Operation::fetch_level:
      return fmt::format("textureSampleLevel({}, state, vec2f({}, {}), {}{})", map, at(0), at(1), layer,
                         at(3));
    default:
      break;
    }
    return fmt::format("textureSampleGrad({}, state, vec2f({}, {}), {}vec2f({}, {}), vec2f({}, {}))", map,
                       at(0), at(1), layer, at(3), at(4), at(5), at(6));
  }

  std::string epilogue(const LookupProgram& program) const override {
    const LookupFunction* grad = program.function("grad");
    if (grad == nullptr) return {};
    return comment("At `place`, in tiles, anywhere; for fragment shaders in uniform control flow, and within "
                   "some 10^5 tiles") +
           comment("of the origin: else hand tile, fraction and derivatives to the functions above.") +
           fmt::format("fn {}({}, place: vec2f) -> vec4f {{\n"
                       "  let cell = floor(place);\n  let dx = dpdx(place);\n  let dy = dpdy(place);\n"
                       "  let fraction = min(place - cell, vec2f(0.99999994));\n"
                       "  return {}({}, i32(cell.x), i32(cell.y), fraction.x, fraction.y, dx.x, dx.y, dy.x, "
                       "dy.y);\n}}\n",
                       name("sample"), listed(texture_parameters(*grad)), name("grad"),
                       listed(texture_arguments(*grad)));
  }
};

} // namespace

std::unique_ptr<ProgramPrinter> wgsl_printer(PrintSettings settings) {
  return std::make_unique<WgslPrinter>(std::move(settings));
}

} // namespace tilepack
