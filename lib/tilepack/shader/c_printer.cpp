#include "tilepack/shader/program_printer.h"

#include <fmt/format.h>

namespace tilepack {
namespace {

// The textures of C: levels in memory, and the filter that hardware has.
constexpr const char* texture_text = R"(#include <math.h>
#include <stdint.h>

/* A value: what the texture's channels hold, 0 for those it lacks. */
typedef struct {{
  float c[4];
}} {0}value;

/* One level, row by row from the north, `channels` floats a texel. */
typedef struct {{
  const float *texels;
  int width, height; /* of an array: of a layer; layers lie one below the other */
}} {0}image;

typedef struct {{
  const {0}image *levels;
  int level_count, channels;
}} {0}texture;

static inline uint32_t {0}least(uint32_t a, uint32_t b) {{
  return a < b ? a : b;
}}

static inline uint32_t {0}most(uint32_t a, uint32_t b) {{
  return a > b ? a : b;
}}

static inline {0}value {0}sum({0}value a, {0}value b) {{
  int i;
  for (i = 0; i < 4; ++i) a.c[i] += b.c[i];
  return a;
}}

static inline {0}value {0}scaled({0}value a, float share) {{
  int i;
  for (i = 0; i < 4; ++i) a.c[i] *= share;
  return a;
}}

static inline {0}value {0}none(void) {{
  const {0}value zero = {{{{0.0f, 0.0f, 0.0f, 0.0f}}}};
  return zero;
}}

static inline {0}value {0}fetch(const {0}texture *texture, int x, int y, int layer, int level) {{
  const {0}image *image = &texture->levels[level];
  const float *from = image->texels + ((int64_t)(layer * (int64_t)image->height + y) * image->width + x) * texture->channels;
  {0}value result = {0}none();
  int i;
  for (i = 0; i < texture->channels; ++i) result.c[i] = from[i];
  return result;
}}

/* Texel i, any, of a row of `side`: {1}. */
static inline int {0}texel_at(int i, int side) {{
  {2}
}}

static inline {0}value {0}bilinear(const {0}texture *texture, float u, float v, int layer, int level) {{
  const int width = texture->levels[level].width, height = texture->levels[level].height;
  const float x = u * (float)width - 0.5f, y = v * (float)height - 0.5f;
  const float west = floorf(x), north = floorf(y), sx = x - west, sy = y - north;
  const int x0 = {0}texel_at((int)west, width), x1 = {0}texel_at((int)west + 1, width);
  const int y0 = {0}texel_at((int)north, height), y1 = {0}texel_at((int)north + 1, height);
  const {0}value upper = {0}sum({0}scaled({0}fetch(texture, x0, y0, layer, level), 1.0f - sx),
                                {0}scaled({0}fetch(texture, x1, y0, layer, level), sx));
  const {0}value lower = {0}sum({0}scaled({0}fetch(texture, x0, y1, layer, level), 1.0f - sx),
                                {0}scaled({0}fetch(texture, x1, y1, layer, level), sx));
  return {0}sum({0}scaled(upper, 1.0f - sy), {0}scaled(lower, sy));
}}

static inline {0}value {0}filtered(const {0}texture *texture, float u, float v, int layer, float level) {{
  const float last = (float)(texture->level_count - 1), at = fminf(fmaxf(level, 0.0f), last);
  const float fine = floorf(at), share = at - fine;
  const {0}value value = {0}bilinear(texture, u, v, layer, (int)fine);
  if (share == 0.0f) return value;
  return {0}sum({0}scaled(value, 1.0f - share), {0}scaled({0}bilinear(texture, u, v, layer, (int)fine + 1), share));
}}

)";

class CPrinter : public ProgramPrinter {
public:
  using ProgramPrinter::ProgramPrinter;

protected:
  TypeNames types() const override { return {"uint32_t", "int32_t", "float", "int", name("value")}; }

  std::string prologue() const override {
    return fmt::format(texture_text, to.prefix,
                       to.wraps ? "the row goes on" : "beyond its ends they are repeated",
                       to.wraps ? "const int rest = i % side;\n  return rest < 0 ? rest + side : rest;"
                                : "return i < 0 ? 0 : i < side ? i : side - 1;");
  }

  std::string comment(const std::string& line) const override { return fmt::format("/* {} */\n", line); }

  std::vector<std::string> texture_parameters(const LookupFunction& function) const override {
    std::vector<std::string> texts;
    if (function.reads_tiles) texts.push_back(fmt::format("const {} *tiles", name("texture")));
    if (function.reads_corners) texts.push_back(fmt::format("const {} *corners", name("texture")));
    if (function.reads_ids) texts.emplace_back("const uint16_t *ids");
    return texts;
  }

  std::string table(const LookupTable& table) const override {
    return fmt::format("static const uint32_t {}[{}] = {{{}}};\n", name(table.name), table.words.size(),
                       table_lines(table, "u"));
  }

  std::string head(const LookupFunction& function) const override {
    return fmt::format("static inline {}", ProgramPrinter::head(function));
  }

  std::string literal(const ExpressionNode& node) const override {
    const std::string text = ProgramPrinter::literal(node);
    return node.operation == Operation::real_literal ? text + "f" : text;
  }

  std::string conversion(const ExpressionNode& node) const override {
    return fmt::format("({})({})", type(node.type), expression(node.operands[0]));
  }

  std::string special_function(const std::string& function, const std::vector<std::string>& arguments,
                               ValueType type) const override {
    if (type == ValueType::real)
      return fmt::format("{}{}f({})", function == "min" || function == "max" ? "f" : "", function,
                         listed(arguments));
    return fmt::format("{}({})", name(function == "min" ? "least" : "most"), listed(arguments));
  }

  std::string binary(const ExpressionNode& node) const override {
    if (node.type != ValueType::texel) return ProgramPrinter::binary(node);
    return fmt::format("{}({}, {})", name(node.operation == Operation::add ? "sum" : "scaled"),
                       expression(node.operands[0]), expression(node.operands[1]));
  }

  std::string expression(const Expression& e) const override {
    if (e.node->operation == Operation::no_texel) return name("none()");
    return ProgramPrinter::expression(e);
  }

  std::string fetch(const ExpressionNode& node) const override {
    const auto at = [&](std::size_t i) { return expression(node.operands[i]); };
    if (node.operation == Operation::fetch_id)
      return fmt::format("(uint32_t)ids[(uint64_t)({}) * {} + {}]", at(1), at(2), at(0));
    return fmt::format("{}({}, {}, {}, {}, {})",
                       name(node.operation == Operation::fetch_texel ? "fetch" : "filtered"), slot_name(node),
                       at(0), at(1), at(2), at(3));
  }
};

} // namespace

std::unique_ptr<ProgramPrinter> c_printer(PrintSettings settings) {
  return std::make_unique<CPrinter>(std::move(settings));
}

} // namespace tilepack
