#include "tilepack/shader/program_printer.h"

#include <fmt/format.h>

namespace tilepack {
namespace {

// Expressions are calls of methods, from which three.js makes GLSL or WGSL.
class TslPrinter : public ProgramPrinter {
public:
  using ProgramPrinter::ProgramPrinter;

protected:
  TypeNames types() const override { return {"uint", "int", "float", "bool", "vec4"}; }

  std::string prologue() const override {
    return "import { Fn, If, array, bool, dFdx, dFdy, float, floor, int, ivec2, select, texture, "
           "textureLoad, uint, vec2,\n"
           "  vec4 } from 'three/tsl';\n\n";
  }

  std::vector<std::string> texture_parameters(const LookupFunction& function) const override {
    return texture_arguments(function);
  }

  std::string literal(const ExpressionNode& node) const override {
    if (node.operation == Operation::word_literal)
      return node.word > 0xffff ? fmt::format("uint({:#010x})", node.word)
                                : fmt::format("uint({})", node.word);
    return type(node.type) + "(" + ProgramPrinter::literal(node) + ")";
  }

  std::string table(const LookupTable& table) const override {
    std::string text = fmt::format("const {} = () => array([", name(table.name));
    for (std::size_t i = 0; i < table.words.size(); ++i)
      text += fmt::format("{}{:#010x}{}", i % 8 == 0 ? "\n  " : " ", table.words[i],
                          i + 1 < table.words.size() ? "," : "");
    return text + "\n].map((w) => uint(w)));\n";
  }

  std::string parameter(const FunctionParameter& p) const override { return p.name; }

  std::string head(const LookupFunction& function) const override {
    std::vector<std::string> parameters = texture_parameters(function);
    for (const FunctionParameter& p : function.parameters) parameters.push_back(parameter(p));
    return fmt::format("export const {} = ({}) => Fn(() => {{\n", name(function.name), listed(parameters));
  }

  std::string tail(const LookupFunction&) const override { return "})();\n"; }

  std::string statement(const Statement& s, const std::string& indent) const override {
    switch (s.kind) {
    case Statement::Kind::declare:
      return fmt::format("{}const {} = {}.toVar();\n", indent, s.name, expression(s.value));
    case Statement::Kind::assign:
      return fmt::format("{}{}.assign({});\n", indent, s.name, expression(s.value));
    case Statement::Kind::branch: {
      std::string text = fmt::format("{}If({}, () => {{\n{}{}}})", indent, expression(s.value),
                                     statements(s.when_true, indent + "  "), indent);
      if (!s.when_false.empty())
        text += fmt::format(".Else(() => {{\n{}{}}})", statements(s.when_false, indent + "  "), indent);
      return text + ";\n";
    }
    default:
      break;
    }
    return ProgramPrinter::statement(s, indent);
  }

  std::string choice(const ExpressionNode& node) const override {
    return fmt::format("select({}, {}, {})", expression(node.operands[0]), expression(node.operands[1]),
                       expression(node.operands[2]));
  }

  static const char* method_of(Operation operation) {
    switch (operation) {
    case Operation::add:
      return "add";
    case Operation::subtract:
      return "sub";
    case Operation::multiply:
      return "mul";
    case Operation::divide:
      return "div";
    case Operation::remainder:
      return "mod";
    case Operation::bit_and:
      return "bitAnd";
    case Operation::bit_or:
      return "bitOr";
    case Operation::bit_xor:
      return "bitXor";
    case Operation::shift_left:
      return "shiftLeft";
    case Operation::shift_right:
      return "shiftRight";
    case Operation::equal:
      return "equal";
    case Operation::less:
      return "lessThan";
    case Operation::less_equal:
      return "lessThanEqual";
    case Operation::both:
      return "and";
    default:
      break;
    }
    return "or";
  }

  std::string binary(const ExpressionNode& node) const override {
    return fmt::format("{}.{}({})", expression(node.operands[0]), method_of(node.operation),
                       expression(node.operands[1]));
  }

  std::string special_function(const std::string& function, const std::vector<std::string>& arguments,
                               ValueType) const override {
    if (arguments.size() == 2) return arguments[0] + "." + function + "(" + arguments[1] + ")";
    return arguments[0] + "." + function + "()";
  }

  std::string expression(const Expression& e) const override {
    if (e.node->operation == Operation::table_word)
      return fmt::format("{}().element({})", name(e.node->name), expression(e.node->operands[0]));
    if (e.node->operation == Operation::invert) return expression(e.node->operands[0]) + ".bitNot()";
    if (e.node->operation == Operation::no_texel) return "vec4(0, 0, 0, 0)";
    return ProgramPrinter::expression(e);
  }

  std::string fetch(const ExpressionNode& node) const override {
    const auto at = [&](std::size_t i) { return expression(node.operands[i]); };
    const std::string layer =
        to.layers && node.slot == PackTextureSlot::tiles ? fmt::format(".depth({})", at(2)) : std::string();
    const std::string map = slot_name(node);
    switch (node.operation) {
    case Operation::fetch_id:
      return fmt::format("textureLoad(ids, ivec2(int({}), int({}))).x", at(0), at(1));
    case Operation::fetch_texel:
      return fmt::format("textureLoad({}, ivec2({}, {}), {}){}", map, at(0), at(1), at(3), layer);
    case Operation::fetch_level:
      return fmt::format("texture({}, vec2({}, {})).level({}){}", map, at(0), at(1), at(3), layer);
    default:
      break;
    }
    return fmt::format("texture({}, vec2({}, {})).grad(vec2({}, {}), vec2({}, {})){}", map, at(0), at(1),
                       at(3), at(4), at(5), at(6), layer);
  }

  std::string epilogue(const LookupProgram& program) const override {
    const LookupFunction* grad = program.function("grad");
    if (grad == nullptr) return {};
    return comment("At `place`, a vec2 in tiles, anywhere; for fragment nodes, within some 10^5 tiles of the "
                   "origin.") +
           fmt::format("export const {} = ({}, place) => {{\n"
                       "  const cell = floor(place), fraction = place.sub(cell).min(0.99999994);\n"
                       "  const dx = dFdx(place), dy = dFdy(place);\n"
                       "  return {}({}, int(cell.x), int(cell.y), fraction.x, fraction.y, dx.x, dx.y, dy.x, "
                       "dy.y);\n}};\n",
                       name("sample"), listed(texture_parameters(*grad)), name("grad"),
                       listed(texture_arguments(*grad)));
  }
};

} // namespace

std::unique_ptr<ProgramPrinter> tsl_printer(PrintSettings settings) {
  return std::make_unique<TslPrinter>(std::move(settings));
}

} // namespace tilepack
