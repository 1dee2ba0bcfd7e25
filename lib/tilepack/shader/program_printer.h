#pragma once

#include "tilepack/shader/lookup_program.h"

#include <memory>
#include <string>
#include <vector>

namespace tilepack {

/// What the printers of all languages need to know beside the program.
struct PrintSettings {
  std::string prefix;  ///< before every name that the text defines, with its underscore
  bool layers = false; ///< textures are arrays
  bool wraps = true;   ///< textures repeat; arrays of layers do not
};

/// What a language calls the types of values.
struct TypeNames {
  std::string word, whole, real, flag, texel;
};

/// Writes a program in one language. The class itself writes what C, GLSL, HLSL and Godot have in common; each
/// language overrides where it differs.
class ProgramPrinter {
public:
  explicit ProgramPrinter(PrintSettings settings) : to(std::move(settings)) {}
  virtual ~ProgramPrinter() = default;

  /// Tables and functions, in order.
  std::string text(const LookupProgram& program);

protected:
  virtual TypeNames types() const = 0;
  std::string type(ValueType type) const;
  /// Parameters for the textures that `function` reads, and what stands for them in a call.
  virtual std::vector<std::string> texture_parameters(const LookupFunction& function) const = 0;
  virtual std::vector<std::string> texture_arguments(const LookupFunction& function) const;
  virtual std::string fetch(const ExpressionNode& node) const = 0;

  virtual std::string prologue() const { return {}; }
  virtual std::string epilogue(const LookupProgram& program) const;
  virtual std::string comment(const std::string& line) const {
    return std::string("// ").append(line).append("\n");
  }
  virtual std::string table(const LookupTable& table) const = 0;
  virtual std::string head(const LookupFunction& function) const;
  virtual std::string tail(const LookupFunction& function) const;
  virtual std::string parameter(const FunctionParameter& parameter) const;
  virtual std::string statement(const Statement& statement, const std::string& indent) const;
  virtual std::string literal(const ExpressionNode& node) const;
  virtual std::string conversion(const ExpressionNode& node) const;
  virtual std::string choice(const ExpressionNode& node) const;
  virtual std::string binary(const ExpressionNode& node) const;
  virtual std::string special_function(const std::string& name, const std::vector<std::string>& arguments,
                                       ValueType type) const;
  virtual std::string expression(const Expression& expression) const;

  /// The expression as it stands beside an operator.
  std::string operand(const ExpressionNode& parent, const Expression& expression) const;
  std::string statements(const std::vector<Statement>& statements, const std::string& indent) const;
  std::string slot_name(const ExpressionNode& node) const;
  std::string name(const std::string& rest) const { return to.prefix + rest; }

  PrintSettings to;
  const LookupProgram* of = nullptr;
};

/// "a, b, c".
std::string listed(const std::vector<std::string>& parts);

/// Words of a table as literals of eight a line; `suffix`: "u".
std::string table_lines(const LookupTable& table, const std::string& suffix);

std::unique_ptr<ProgramPrinter> c_printer(PrintSettings settings);
std::unique_ptr<ProgramPrinter> glsl_printer(PrintSettings settings, bool godot);
std::unique_ptr<ProgramPrinter> hlsl_printer(PrintSettings settings);
std::unique_ptr<ProgramPrinter> wgsl_printer(PrintSettings settings);
std::unique_ptr<ProgramPrinter> osl_printer(PrintSettings settings);
std::unique_ptr<ProgramPrinter> tsl_printer(PrintSettings settings);

} // namespace tilepack
