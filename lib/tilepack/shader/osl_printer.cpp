#include "tilepack/shader/program_printer.h"

#include <fmt/format.h>

#include <set>

namespace tilepack {
namespace {

// Words are ints there, which go round as they do in hardware; a shift to the right must lose the sign.
class OslPrinter : public ProgramPrinter {
public:
  using ProgramPrinter::ProgramPrinter;

protected:
  TypeNames types() const override { return {"int", "int", "float", "int", "color"}; }

  std::vector<std::string> texture_parameters(const LookupFunction& function) const override {
    std::vector<std::string> texts;
    if (function.reads_tiles) texts.emplace_back("string tiles");
    if (function.reads_corners) texts.emplace_back("string corners");
    return texts;
  }

  std::string literal(const ExpressionNode& node) const override {
    if (node.operation != Operation::word_literal) return ProgramPrinter::literal(node);
    return fmt::format("{}", static_cast<std::int32_t>(node.word));
  }

  // There are no constants outside functions: each function has those that it reads.
  std::string table(const LookupTable&) const override { return {}; }

  std::string text_of(const LookupTable& table) const {
    std::string text = fmt::format("  int {}[{}] = {{", name(table.name), table.words.size());
    for (std::size_t i = 0; i < table.words.size(); ++i)
      text += fmt::format("{}{}{}", i % 8 == 0 ? "\n    " : " ", static_cast<std::int32_t>(table.words[i]),
                          i + 1 < table.words.size() ? "," : "");
    return text + "\n  };\n";
  }

  static void tables_read(const Expression& e, std::set<std::string>& names) {
    if (e.node->operation == Operation::table_word) names.insert(e.node->name);
    for (const Expression& o : e.node->operands) tables_read(o, names);
  }

  std::string head(const LookupFunction& function) const override {
    std::set<std::string> names;
    for (const Statement& s : function.body)
      if (s.value.node) tables_read(s.value, names);
    std::string text = ProgramPrinter::head(function);
    for (const LookupTable& t : of->tables)
      if (names.contains(t.name)) text += text_of(t);
    return text;
  }

  std::string binary(const ExpressionNode& node) const override {
    const std::string plain = ProgramPrinter::binary(node);
    const ExpressionNode& right = *node.operands.back().node;
    // Shifts by what is no literal are masked by who asks for them.
    if (node.operation != Operation::shift_right || right.operation != Operation::word_literal ||
        right.word == 0)
      return plain;
    return fmt::format("({}) & {}", plain, static_cast<std::int32_t>(0xffffffffu >> right.word));
  }

  std::string fetch(const ExpressionNode& node) const override {
    const auto at = [&](std::size_t i) { return expression(node.operands[i]); };
    return fmt::format("color(texture({}, {}, {}, {}, {}, {}, {}, \"wrap\", \"periodic\"))", slot_name(node),
                       at(0), at(1), at(3), at(4), at(5), at(6));
  }

  std::string epilogue(const LookupProgram& program) const override {
    const LookupFunction* grad = program.function("grad");
    std::string text;
    std::string files;
    for (const std::string& parameter : texture_parameters(*grad)) files += "  " + parameter + " = \"\",\n";
    return fmt::format("shader {}shader(\n{}  float tiles_a_unit = 1,\n  float s = u,\n  float t = v,\n  "
                       "output color result = 0)\n{{\n"
                       "  float x = s * tiles_a_unit, y = t * tiles_a_unit;\n"
                       "  float cell_x = floor(x), cell_y = floor(y);\n"
                       "  result = {}({}, int(cell_x), int(cell_y), min(x - cell_x, 0.99999994), min(y - "
                       "cell_y, 0.99999994),\n"
                       "    Dx(x), Dx(y), Dy(x), Dy(y));\n}}\n",
                       to.prefix, files, name("grad"), listed(texture_arguments(*grad)));
  }
};

} // namespace

std::unique_ptr<ProgramPrinter> osl_printer(PrintSettings settings) {
  return std::make_unique<OslPrinter>(std::move(settings));
}

} // namespace tilepack
