#include "tilepack/shader/program_printer.h"

#include <fmt/format.h>

namespace tilepack {
namespace {

class HlslPrinter : public ProgramPrinter {
public:
  using ProgramPrinter::ProgramPrinter;

protected:
  TypeNames types() const override { return {"uint", "int", "float", "bool", "float4"}; }

  std::vector<std::string> texture_parameters(const LookupFunction& function) const override {
    std::vector<std::string> texts;
    if (function.reads_tiles) texts.emplace_back(to.layers ? "Texture2DArray tiles" : "Texture2D tiles");
    if (function.reads_corners) texts.emplace_back("Texture2D corners");
    if (function.reads_ids) texts.emplace_back("Texture2D<uint> ids");
    if (function.reads_tiles) texts.emplace_back("SamplerState state");
    return texts;
  }

  std::vector<std::string> texture_arguments(const LookupFunction& function) const override {
    std::vector<std::string> texts = ProgramPrinter::texture_arguments(function);
    if (function.reads_tiles) texts.emplace_back("state");
    return texts;
  }

  std::string table(const LookupTable& table) const override {
    return fmt::format("static const uint {}[{}] = {{{}}};\n", name(table.name), table.words.size(),
                       table_lines(table, "u"));
  }

  std::string fetch(const ExpressionNode& node) const override {
    const auto at = [&](std::size_t i) { return expression(node.operands[i]); };
    const bool layers = to.layers && node.slot == PackTextureSlot::tiles;
    const std::string map = slot_name(node);
    switch (node.operation) {
    case Operation::fetch_id:
      return fmt::format("ids.Load(int3(int({}), int({}), 0))", at(0), at(1));
    case Operation::fetch_texel:
      return layers ? fmt::format("{}.Load(int4({}, {}, {}, {}))", map, at(0), at(1), at(2), at(3))
                    : fmt::format("{}.Load(int3({}, {}, {}))", map, at(0), at(1), at(3));
    case Operation::fetch_level:
      return fmt::format("{}.SampleLevel(state, {}, {})", map, place(node, layers), at(3));
    default:
      break;
    }
    return fmt::format("{}.SampleGrad(state, {}, float2({}, {}), float2({}, {}))", map, place(node, layers),
                       at(3), at(4), at(5), at(6));
  }

  std::string epilogue(const LookupProgram& program) const override {
    const LookupFunction* grad = program.function("grad");
    if (grad == nullptr) return {};
    return comment("At `place`, in tiles, anywhere; for pixel shaders, and within some 10^5 tiles of the "
                   "origin: farther") +
           comment(
               "out hand the tile and the fraction to the functions above, and derivatives of your own.") +
           fmt::format("float4 {}({}, float2 place) {{\n"
                       "  float2 cell = floor(place), dx = ddx(place), dy = ddy(place);\n"
                       "  float2 fraction = min(place - cell, float2(0.99999994, 0.99999994));\n"
                       "  return {}({}, int(cell.x), int(cell.y), fraction.x, fraction.y, dx.x, dx.y, dy.x, "
                       "dy.y);\n}}\n",
                       name("sample"), listed(texture_parameters(*grad)), name("grad"),
                       listed(texture_arguments(*grad)));
  }

private:
  std::string place(const ExpressionNode& node, bool layers) const {
    const std::string u = expression(node.operands[0]), v = expression(node.operands[1]);
    if (layers) return fmt::format("float3({}, {}, float({}))", u, v, expression(node.operands[2]));
    return fmt::format("float2({}, {})", u, v);
  }
};

} // namespace

std::unique_ptr<ProgramPrinter> hlsl_printer(PrintSettings settings) {
  return std::make_unique<HlslPrinter>(std::move(settings));
}

} // namespace tilepack
