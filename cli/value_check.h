#pragma once

#include <CLI/CLI.hpp>

#include <string>

namespace tilepack::cli {

/// Checks of option values in place of CLI11's: they name value and range as all messages do ("'-1' is not
/// allowed; it must be a whole number of 0 to 9"), add nothing to the help, and take decimal numbers only,
/// where CLI11 reads 0x10 and 010 as well. `note` follows the range.

/// Digits alone, after a minus where `lowest` is negative.
CLI::Validator whole_number(int lowest, int highest, const std::string& note = "");

/// Also fractions and exponents; nan and inf are in no range.
CLI::Validator number(double lowest, double highest, const std::string& note = "");

/// The same, above 0.
CLI::Validator positive_number(double highest, const std::string& note = "");

/// `words`: "text|json", as in the help.
CLI::Validator one_of(const std::string& words);

} // namespace tilepack::cli
