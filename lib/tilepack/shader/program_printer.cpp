#include "tilepack/shader/program_printer.h"

#include <fmt/format.h>

#include <iterator>

namespace tilepack {
namespace {

const char* sign_of(Operation operation) {
  switch (operation) {
  case Operation::add:
    return "+";
  case Operation::subtract:
    return "-";
  case Operation::multiply:
    return "*";
  case Operation::divide:
    return "/";
  case Operation::remainder:
    return "%";
  case Operation::bit_and:
    return "&";
  case Operation::bit_or:
    return "|";
  case Operation::bit_xor:
    return "^";
  case Operation::shift_left:
    return "<<";
  case Operation::shift_right:
    return ">>";
  case Operation::equal:
    return "==";
  case Operation::less:
    return "<";
  case Operation::less_equal:
    return "<=";
  case Operation::both:
    return "&&";
  case Operation::either:
    return "||";
  default:
    return nullptr;
  }
}

const char* function_of(Operation operation) {
  switch (operation) {
  case Operation::minimum:
    return "min";
  case Operation::maximum:
    return "max";
  case Operation::floor:
    return "floor";
  case Operation::log2:
    return "log2";
  case Operation::exp2:
    return "exp2";
  case Operation::sqrt:
    return "sqrt";
  default:
    return nullptr;
  }
}

bool chains(Operation operation) {
  switch (operation) {
  case Operation::add:
  case Operation::multiply:
  case Operation::bit_and:
  case Operation::bit_or:
  case Operation::bit_xor:
  case Operation::both:
  case Operation::either:
    return true;
  default:
    return false;
  }
}

bool compares(Operation operation) {
  return operation == Operation::less || operation == Operation::less_equal || operation == Operation::equal;
}

bool sums(Operation operation) {
  return operation == Operation::add || operation == Operation::subtract;
}

bool products(Operation operation) {
  return operation == Operation::multiply || operation == Operation::divide;
}

} // namespace

std::string listed(const std::vector<std::string>& parts) {
  return fmt::format("{}", fmt::join(parts, ", "));
}

std::string table_lines(const LookupTable& table, const std::string& suffix) {
  std::string text;
  for (std::size_t i = 0; i < table.words.size(); ++i)
    text += fmt::format("{}{:#010x}{}{}", i % 8 == 0 ? "\n  " : " ", table.words[i], suffix,
                        i + 1 < table.words.size() ? "," : "");
  return text + "\n";
}

std::string ProgramPrinter::type(ValueType type) const {
  const TypeNames names = types();
  switch (type) {
  case ValueType::word:
    return names.word;
  case ValueType::whole:
    return names.whole;
  case ValueType::real:
    return names.real;
  case ValueType::flag:
    return names.flag;
  case ValueType::texel:
    break;
  }
  return names.texel;
}

std::string ProgramPrinter::text(const LookupProgram& program) {
  of = &program;
  std::string result = prologue();
  for (const LookupTable& t : program.tables) result += comment(t.comment) + table(t) + "\n";
  for (const LookupFunction& f : program.functions) {
    for (const std::string& line : f.comment) result += comment(line);
    result += head(f) + statements(f.body, "  ") + tail(f) + "\n";
  }
  result += epilogue(program);
  while (result.ends_with("\n\n")) result.pop_back();
  return result;
}

std::string ProgramPrinter::epilogue(const LookupProgram&) const {
  return {};
}

std::vector<std::string> ProgramPrinter::texture_arguments(const LookupFunction& function) const {
  std::vector<std::string> names;
  if (function.reads_tiles) names.emplace_back("tiles");
  if (function.reads_corners) names.emplace_back("corners");
  if (function.reads_ids) names.emplace_back("ids");
  return names;
}

std::string ProgramPrinter::parameter(const FunctionParameter& p) const {
  return type(p.type) + " " + p.name;
}

std::string ProgramPrinter::head(const LookupFunction& function) const {
  std::vector<std::string> parameters = texture_parameters(function);
  for (const FunctionParameter& p : function.parameters) parameters.push_back(parameter(p));
  return fmt::format("{} {}({}) {{\n", type(function.type), name(function.name), listed(parameters));
}

std::string ProgramPrinter::tail(const LookupFunction&) const {
  return "}\n";
}

std::string ProgramPrinter::statements(const std::vector<Statement>& all, const std::string& indent) const {
  std::string text;
  for (const Statement& s : all) text += statement(s, indent);
  return text;
}

std::string ProgramPrinter::statement(const Statement& s, const std::string& indent) const {
  switch (s.kind) {
  case Statement::Kind::declare:
    return fmt::format("{}{} {} = {};\n", indent, type(s.value.node->type), s.name, expression(s.value));
  case Statement::Kind::assign:
    return fmt::format("{}{} = {};\n", indent, s.name, expression(s.value));
  case Statement::Kind::result:
    return fmt::format("{}return {};\n", indent, expression(s.value));
  case Statement::Kind::comment:
    return indent + comment(s.name);
  case Statement::Kind::branch:
    break;
  }
  std::string text =
      fmt::format("{}if ({}) {{\n{}", indent, expression(s.value), statements(s.when_true, indent + "  "));
  if (!s.when_false.empty()) text += indent + "} else {\n" + statements(s.when_false, indent + "  ");
  return text + indent + "}\n";
}

std::string ProgramPrinter::literal(const ExpressionNode& node) const {
  switch (node.operation) {
  case Operation::word_literal:
    return node.word > 0xffff ? fmt::format("{:#010x}u", node.word) : fmt::format("{}u", node.word);
  case Operation::whole_literal:
    return fmt::format("{}", static_cast<std::int32_t>(node.word));
  default:
    break;
  }
  const std::string text = fmt::format("{:.9g}", static_cast<double>(static_cast<float>(node.real)));
  return text.find_first_of(".e") == std::string::npos ? text + ".0" : text;
}

std::string ProgramPrinter::conversion(const ExpressionNode& node) const {
  return fmt::format("{}({})", type(node.type), expression(node.operands[0]));
}

std::string ProgramPrinter::choice(const ExpressionNode& node) const {
  return fmt::format("{} ? {} : {}", operand(node, node.operands[0]), operand(node, node.operands[1]),
                     operand(node, node.operands[2]));
}

std::string ProgramPrinter::operand(const ExpressionNode& parent, const Expression& e) const {
  const Operation inner = e.node->operation, outer = parent.operation;
  const std::string text = expression(e);
  const bool compound = sign_of(inner) != nullptr || inner == Operation::select;
  const bool chained = inner == outer && chains(inner) && e.node == parent.operands[0].node;
  const bool by_rank = (sums(outer) && products(inner)) || (outer == Operation::both && compares(inner)) ||
                       (sums(outer) && sums(inner) && e.node == parent.operands[0].node);
  return compound && !chained && !by_rank ? fmt::format("({})", text) : text;
}

std::string ProgramPrinter::binary(const ExpressionNode& node) const {
  return fmt::format("{} {} {}", operand(node, node.operands[0]), sign_of(node.operation),
                     operand(node, node.operands[1]));
}

std::string ProgramPrinter::special_function(const std::string& function,
                                             const std::vector<std::string>& arguments, ValueType) const {
  return fmt::format("{}({})", function, listed(arguments));
}

std::string ProgramPrinter::slot_name(const ExpressionNode& node) const {
  return node.slot == PackTextureSlot::tiles ? "tiles" : "corners";
}

std::string ProgramPrinter::expression(const Expression& e) const {
  const ExpressionNode& node = *e.node;
  const auto all = [&] {
    std::vector<std::string> texts;
    for (const Expression& o : node.operands) texts.push_back(expression(o));
    return texts;
  };
  switch (node.operation) {
  case Operation::word_literal:
  case Operation::whole_literal:
  case Operation::real_literal:
    return literal(node);
  case Operation::no_texel:
    return fmt::format("{}(0.0, 0.0, 0.0, 0.0)", type(ValueType::texel));
  case Operation::variable:
    return node.name;
  case Operation::table_word:
    return fmt::format("{}[{}]", name(node.name), expression(node.operands[0]));
  case Operation::invert:
    return fmt::format("~{}", operand(node, node.operands[0]));
  case Operation::to_word:
  case Operation::to_whole:
  case Operation::to_real:
    return node.operands[0].node->type == node.type ? expression(node.operands[0]) : conversion(node);
  case Operation::select:
    return choice(node);
  case Operation::call: {
    std::vector<std::string> arguments = texture_arguments(*of->function(node.name));
    for (const std::string& text : all()) arguments.push_back(text);
    return fmt::format("{}({})", name(node.name), listed(arguments));
  }
  case Operation::fetch_id:
  case Operation::fetch_texel:
  case Operation::fetch_level:
  case Operation::fetch_grad:
    return fetch(node);
  default:
    break;
  }
  if (const char* function = function_of(node.operation)) return special_function(function, all(), node.type);
  return binary(node);
}

} // namespace tilepack
