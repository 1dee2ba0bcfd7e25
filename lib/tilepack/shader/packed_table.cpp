#include "tilepack/error/error.h"
#include "tilepack/shader/lookup_description.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <utility>

namespace tilepack {

std::uint32_t bits_for(std::uint32_t largest) {
  std::uint32_t bits = 1;
  while (bits < 16 && largest >> bits != 0) bits *= 2;
  return bits;
}

PackedTable add_table(LookupProgram& program, const std::string& name, const std::string& comment,
                      const std::vector<std::uint32_t>& entries, const std::string& instead) {
  const PackedTable table{name, bits_for(*std::max_element(entries.begin(), entries.end()))};
  const std::uint32_t in_word = 32 / table.bits;
  LookupTable words{name, comment, {}};
  words.words.resize((entries.size() + in_word - 1) / in_word);
  if (words.words.size() > most_table_words)
    throw Error(ErrorKind::invalid_content, "shader",
                fmt::format("{} needs {} entries, {} words of constants; a shader holds {}: {}", comment,
                            entries.size(), words.words.size(), most_table_words, instead));
  for (std::size_t i = 0; i < entries.size(); ++i)
    words.words[i / in_word] |= entries[i] << (i % in_word * table.bits);
  program.tables.push_back(std::move(words));
  return table;
}

Expression entry_of(const PackedTable& table, Expression index) {
  const std::uint32_t in_word = 32 / table.bits;
  if (in_word == 1) return table_word(table.name, std::move(index));
  const std::uint32_t shift = static_cast<std::uint32_t>(std::countr_zero(in_word));
  const std::uint32_t bits_shift = static_cast<std::uint32_t>(std::countr_zero(table.bits));
  Expression bit = index & word(in_word - 1);
  if (bits_shift > 0) bit = bit << word(bits_shift);
  return (table_word(table.name, index >> word(shift)) >> bit) & word((1u << table.bits) - 1);
}

} // namespace tilepack
