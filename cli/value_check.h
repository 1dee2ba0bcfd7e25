#pragma once

#include <cstdint>
#include <functional>
#include <string>

namespace tilepack::cli {

/// Nothing if the text is allowed, else why not.
using Check = std::function<std::string(const std::string& text)>;

/// Checks of option values in place of CLI11's: they name value and range as all messages do ("'-1' is not
/// allowed; it must be a whole number of 0 to 9"), add nothing to the help, and take decimal numbers only,
/// where CLI11 reads 0x10 and 010 as well. `note` follows the range.

/// Digits alone, after a minus where `lowest` is negative.
Check whole_number(std::int64_t lowest, std::int64_t highest, const std::string& note = "");

/// Also fractions and exponents; nan and inf are in no range.
Check number(double lowest, double highest, const std::string& note = "");

/// The same, above 0.
Check positive_number(double highest, const std::string& note = "");

/// `words`: "text|json", as in the help.
Check one_of(const std::string& words);

} // namespace tilepack::cli
