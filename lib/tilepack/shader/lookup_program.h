#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace tilepack {

/// The values that a lookup is computed with. Shading languages have all of them but OSL, where a word is an int.
enum class ValueType {
  word,  ///< 32 bits, unsigned; goes round
  whole, ///< 32 bits, signed: cells of the virtual texture, texels of a tile
  real,  ///< 32-bit float
  flag,  ///< true or false
  texel, ///< four reals
};

enum class Operation {
  // leaves
  word_literal,
  whole_literal,
  real_literal,
  no_texel, ///< four zeros
  variable,
  table_word, ///< word `index` of a table
  // two operands of one type
  add,
  subtract,
  multiply,  ///< of a texel and a real also
  divide,    ///< reals alone
  remainder, ///< words, the divisor a literal; left operand below 2^31, so that a language without words can
  bit_and,
  bit_or,
  bit_xor,
  shift_left,
  shift_right, ///< words; zeros come in
  minimum,
  maximum,
  equal,
  less,
  less_equal,
  both,   ///< of flags
  either, ///< of flags
  // one operand
  invert, ///< all bits of a word
  to_word,
  to_whole, ///< a real is a whole number already
  to_real,
  floor,
  log2,
  exp2,
  sqrt,
  // more
  select, ///< flag ? second : third
  call,   ///< a function of the program
  // textures
  fetch_id,    ///< column, row, columns of all: a word of the index map
  fetch_texel, ///< column, row, layer, level: one texel, nothing filtered
  fetch_level, ///< u, v, layer, level: filtered as the texture is set, at a level
  fetch_grad,  ///< u, v, layer, du/dx, dv/dx, du/dy, dv/dy: likewise, at the level that fits
};

/// Which texture is read: the pack's, or that of the corner pack.
enum class PackTextureSlot { tiles, corners };

struct ExpressionNode;

/// An expression; a handle that is copied freely. Operators build larger ones (below).
struct Expression {
  std::shared_ptr<const ExpressionNode> node;
};

struct ExpressionNode {
  Operation operation = Operation::word_literal;
  ValueType type = ValueType::word;
  std::uint32_t word = 0; ///< word_literal, and the bits of a whole_literal
  double real = 0;        ///< real_literal: a float's value
  std::string name;       ///< variable, call, table_word
  std::vector<Expression> operands;
  PackTextureSlot slot = PackTextureSlot::tiles; ///< of fetches
};

/// One statement. Functions end in their only `result`, since not every language has others.
struct Statement {
  enum class Kind { declare, assign, branch, result, comment };
  Kind kind = Kind::declare;
  std::string name; ///< of the variable; text of a comment
  Expression value; ///< of a branch the condition
  std::vector<Statement> when_true, when_false;
};

struct FunctionParameter {
  std::string name;
  ValueType type = ValueType::word;
};

/// A function of the program. Its name lacks the prefix that emitters put before it.
struct LookupFunction {
  std::string name;
  std::vector<std::string> comment; ///< lines for the reader of the shader
  ValueType type = ValueType::word; ///< of the result
  std::vector<FunctionParameter> parameters;
  std::vector<Statement> body;
  bool reads_tiles = false;   ///< the textures come first among the arguments, in this order
  bool reads_corners = false; ///<
  bool reads_ids = false;     ///<
};

/// Constants, several entries a word.
struct LookupTable {
  std::string name;
  std::string comment;
  std::vector<std::uint32_t> words;
};

/// A pack's lookup, for every language: what lookup/pack_lookup.h says, with the pack's constants put in.
struct LookupProgram {
  std::vector<LookupTable> tables;
  std::vector<LookupFunction> functions; ///< each after those it calls
  const LookupFunction* function(const std::string& name) const;
};

/// Literals, and what has no operator.
Expression word(std::uint32_t value);
Expression whole(std::int32_t value);
Expression real(double value);
Expression no_texel();
Expression variable(const std::string& name, ValueType type);
Expression table_word(const std::string& table, Expression index);
Expression unary(Operation operation, ValueType type, Expression operand);
Expression binary(Operation operation, ValueType type, Expression a, Expression b);
Expression select(Expression flag, Expression a, Expression b);
Expression fetch(Operation operation, PackTextureSlot slot, std::vector<Expression> operands);

Expression operator+(Expression a, Expression b);
Expression operator-(Expression a, Expression b);
Expression operator*(Expression a, Expression b);
Expression operator/(Expression a, Expression b);
Expression operator%(Expression a, Expression b);
Expression operator&(Expression a, Expression b);
Expression operator|(Expression a, Expression b);
Expression operator^(Expression a, Expression b);
Expression operator<<(Expression a, Expression b);
Expression operator>>(Expression a, Expression b);
Expression operator~(Expression a);
Expression operator<(Expression a, Expression b);
Expression operator<=(Expression a, Expression b);
Expression operator==(Expression a, Expression b);
Expression operator&&(Expression a, Expression b);
Expression operator||(Expression a, Expression b);
Expression minimum(Expression a, Expression b);
Expression maximum(Expression a, Expression b);
Expression floor(Expression a);
Expression to_word(Expression a);
Expression to_whole(Expression a);
Expression to_real(Expression a);

/// Writes one function, statement by statement.
class FunctionWriter {
public:
  FunctionWriter(LookupProgram& program, const std::string& name, ValueType type,
                 std::vector<std::string> comment);

  Expression parameter(const std::string& name, ValueType type);
  Expression declare(const std::string& name, Expression value);
  void assign(const Expression& variable, Expression value);
  void branch(Expression condition, const std::function<void()>& when_true,
              const std::function<void()>& when_false = {});
  void remark(const std::string& comment);

  /// A call of a function of the program, which hands on the textures that it reads.
  Expression call(const std::string& function, std::vector<Expression> arguments);

  /// The end of the function, which goes into the program.
  void result(Expression value);

private:
  void note_reads(const Expression& expression);

  LookupProgram& program;
  LookupFunction function;
  std::vector<std::vector<Statement>*> open;
};

} // namespace tilepack
