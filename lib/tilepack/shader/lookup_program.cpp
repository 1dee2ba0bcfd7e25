#include "tilepack/shader/lookup_program.h"

#include "tilepack/error/error.h"

#include <utility>

namespace tilepack {
namespace {

Expression made(ExpressionNode node) {
  return {std::make_shared<const ExpressionNode>(std::move(node))};
}

Expression arithmetic(Operation operation, Expression a, Expression b) {
  const ValueType type = a.node->type;
  return binary(operation, type, std::move(a), std::move(b));
}

Expression comparison(Operation operation, Expression a, Expression b) {
  return binary(operation, ValueType::flag, std::move(a), std::move(b));
}

} // namespace

const LookupFunction* LookupProgram::function(const std::string& name) const {
  for (const LookupFunction& f : functions)
    if (f.name == name) return &f;
  return nullptr;
}

Expression word(std::uint32_t value) {
  return made({Operation::word_literal, ValueType::word, value, 0, {}, {}});
}

Expression whole(std::int32_t value) {
  return made({Operation::whole_literal, ValueType::whole, static_cast<std::uint32_t>(value), 0, {}, {}});
}

Expression real(double value) {
  return made({Operation::real_literal, ValueType::real, 0, value, {}, {}});
}

Expression no_texel() {
  return made({Operation::no_texel, ValueType::texel, 0, 0, {}, {}});
}

Expression variable(const std::string& name, ValueType type) {
  return made({Operation::variable, type, 0, 0, name, {}});
}

Expression table_word(const std::string& table, Expression index) {
  return made({Operation::table_word, ValueType::word, 0, 0, table, {std::move(index)}});
}

Expression unary(Operation operation, ValueType type, Expression operand) {
  return made({operation, type, 0, 0, {}, {std::move(operand)}});
}

Expression binary(Operation operation, ValueType type, Expression a, Expression b) {
  return made({operation, type, 0, 0, {}, {std::move(a), std::move(b)}});
}

Expression select(Expression flag, Expression a, Expression b) {
  const ValueType type = a.node->type;
  return made({Operation::select, type, 0, 0, {}, {std::move(flag), std::move(a), std::move(b)}});
}

Expression fetch(Operation operation, PackTextureSlot slot, std::vector<Expression> operands) {
  const ValueType type = operation == Operation::fetch_id ? ValueType::word : ValueType::texel;
  return made({operation, type, 0, 0, {}, std::move(operands), slot});
}

Expression operator+(Expression a, Expression b) {
  return arithmetic(Operation::add, std::move(a), std::move(b));
}
Expression operator-(Expression a, Expression b) {
  return arithmetic(Operation::subtract, std::move(a), std::move(b));
}
Expression operator*(Expression a, Expression b) {
  return arithmetic(Operation::multiply, std::move(a), std::move(b));
}
Expression operator/(Expression a, Expression b) {
  return arithmetic(Operation::divide, std::move(a), std::move(b));
}
Expression operator%(Expression a, Expression b) {
  return arithmetic(Operation::remainder, std::move(a), std::move(b));
}
Expression operator&(Expression a, Expression b) {
  return arithmetic(Operation::bit_and, std::move(a), std::move(b));
}
Expression operator|(Expression a, Expression b) {
  return arithmetic(Operation::bit_or, std::move(a), std::move(b));
}
Expression operator^(Expression a, Expression b) {
  return arithmetic(Operation::bit_xor, std::move(a), std::move(b));
}
Expression operator<<(Expression a, Expression b) {
  return arithmetic(Operation::shift_left, std::move(a), std::move(b));
}
Expression operator>>(Expression a, Expression b) {
  return arithmetic(Operation::shift_right, std::move(a), std::move(b));
}
Expression operator~(Expression a) {
  return unary(Operation::invert, ValueType::word, std::move(a));
}
Expression operator<(Expression a, Expression b) {
  return comparison(Operation::less, std::move(a), std::move(b));
}
Expression operator<=(Expression a, Expression b) {
  return comparison(Operation::less_equal, std::move(a), std::move(b));
}
Expression operator==(Expression a, Expression b) {
  return comparison(Operation::equal, std::move(a), std::move(b));
}
Expression operator&&(Expression a, Expression b) {
  return comparison(Operation::both, std::move(a), std::move(b));
}
Expression operator||(Expression a, Expression b) {
  return comparison(Operation::either, std::move(a), std::move(b));
}
Expression minimum(Expression a, Expression b) {
  return arithmetic(Operation::minimum, std::move(a), std::move(b));
}
Expression maximum(Expression a, Expression b) {
  return arithmetic(Operation::maximum, std::move(a), std::move(b));
}
Expression floor(Expression a) {
  return unary(Operation::floor, ValueType::real, std::move(a));
}
Expression to_word(Expression a) {
  return unary(Operation::to_word, ValueType::word, std::move(a));
}
Expression to_whole(Expression a) {
  return unary(Operation::to_whole, ValueType::whole, std::move(a));
}
Expression to_real(Expression a) {
  return unary(Operation::to_real, ValueType::real, std::move(a));
}

FunctionWriter::FunctionWriter(LookupProgram& of_program, const std::string& name, ValueType type,
                               std::vector<std::string> comment)
    : program(of_program) {
  function.name = name;
  function.type = type;
  function.comment = std::move(comment);
  open.push_back(&function.body);
}

Expression FunctionWriter::parameter(const std::string& name, ValueType type) {
  function.parameters.push_back({name, type});
  return variable(name, type);
}

void FunctionWriter::note_reads(const Expression& expression) {
  const ExpressionNode& node = *expression.node;
  switch (node.operation) {
  case Operation::fetch_id:
    function.reads_ids = true;
    break;
  case Operation::fetch_texel:
  case Operation::fetch_level:
  case Operation::fetch_grad:
    (node.slot == PackTextureSlot::tiles ? function.reads_tiles : function.reads_corners) = true;
    break;
  case Operation::call: {
    const LookupFunction& called = *program.function(node.name);
    function.reads_tiles |= called.reads_tiles;
    function.reads_corners |= called.reads_corners;
    function.reads_ids |= called.reads_ids;
    break;
  }
  default:
    break;
  }
  for (const Expression& operand : node.operands) note_reads(operand);
}

Expression FunctionWriter::declare(const std::string& name, Expression value) {
  note_reads(value);
  const ValueType type = value.node->type;
  open.back()->push_back({Statement::Kind::declare, name, std::move(value), {}, {}});
  return variable(name, type);
}

void FunctionWriter::assign(const Expression& to, Expression value) {
  note_reads(value);
  open.back()->push_back({Statement::Kind::assign, to.node->name, std::move(value), {}, {}});
}

void FunctionWriter::branch(Expression condition, const std::function<void()>& when_true,
                            const std::function<void()>& when_false) {
  note_reads(condition);
  Statement statement{Statement::Kind::branch, {}, std::move(condition), {}, {}};
  open.push_back(&statement.when_true);
  when_true();
  if (when_false) {
    open.back() = &statement.when_false;
    when_false();
  }
  open.pop_back();
  open.back()->push_back(std::move(statement));
}

void FunctionWriter::remark(const std::string& comment) {
  open.back()->push_back({Statement::Kind::comment, comment, {}, {}, {}});
}

Expression FunctionWriter::call(const std::string& name, std::vector<Expression> arguments) {
  const LookupFunction* called = program.function(name);
  if (called == nullptr) throw Error(ErrorKind::internal, "lookup program", "no function " + name);
  return made({Operation::call, called->type, 0, 0, name, std::move(arguments)});
}

void FunctionWriter::result(Expression value) {
  note_reads(value);
  open.back()->push_back({Statement::Kind::result, {}, std::move(value), {}, {}});
  program.functions.push_back(std::move(function));
}

} // namespace tilepack
