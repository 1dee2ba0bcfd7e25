#include "tilepack/bench/stress_lookups.h"

#include <algorithm>
#include <catch2/catch.hpp>

using namespace tilepack;

TEST_CASE("every hard case comes out as promised, in both samplers") {
  const std::vector<HardLookup> cases = stress_lookups();
  for (const HardLookup& c : cases) {
    INFO(c.input << ": " << c.promise);
    CHECK(c.reference <= HardLookup::reference_limit);
    if (c.fast) CHECK(*c.fast <= HardLookup::fast_limit);
    CHECK(c.kept());
  }
  for (const char* word :
       {"corner", "border", "NaN", "infinite", "2^24", "2^31", "one texel", "prime", "K = 1", "past the last",
        "larger than the texture", "negative", "zero", "clamp", "mirror"})
    CHECK(std::any_of(cases.begin(), cases.end(),
                      [&](const HardLookup& c) { return c.input.find(word) != std::string::npos; }));
}

TEST_CASE("a broken promise is told") {
  HardLookup c{"input", "promise", 0, 0.0};
  CHECK(c.kept());
  CHECK(hard_lookups_text({c}).find("BROKEN") == std::string::npos);
  c.fast = 1.0;
  CHECK_FALSE(c.kept());
  CHECK(hard_lookups_text({c}).find("BROKEN") != std::string::npos);
  c.fast.reset();
  c.reference = 1.0;
  CHECK_FALSE(c.kept());
}
