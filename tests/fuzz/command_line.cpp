// A command line, one word a line: every verb takes it, shows its help, or says what is wrong. Nothing is run.

#include "verb.h"

#include "tilepack/error/error.h"

#include <cstdint>
#include <sstream>
#include <string>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  using namespace tilepack::cli;
  const auto verbs = verb_table();
  const Verb& verb = verbs[data[0] % verbs.size()];
  std::istringstream text(std::string(reinterpret_cast<const char*>(data) + 1, size - 1));
  std::vector<std::string> words;
  for (std::string word; std::getline(text, word);) words.push_back(word);
  try {
    Options options({"tilepack " + verb.name, verb.summary, verb.example, verb.more});
    bool quiet = false;
    options.flag("-q,--quiet", quiet, "");
    const Action action = verb.declare(options);
    options.parse(words);
  } catch (const tilepack::Error&) {
  }
  return 0;
}
