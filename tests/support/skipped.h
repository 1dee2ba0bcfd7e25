#pragma once

#include <catch2/catch.hpp>
#include <cstdlib>
#include <string>

namespace tilepack::test {

/// For what this machine does not let be tested: says so, and fails where CI=true promises that all is tested.
inline void skipped(const std::string& why) {
  const char* ci = std::getenv("CI");
  if (ci != nullptr && std::string(ci) == "true") FAIL("not tested, which CI has to: " << why);
  WARN("not tested: " << why);
}

} // namespace tilepack::test
