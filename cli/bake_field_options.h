#pragma once

#include "options.h"

#include "tilepack/bake/bake_fields.h"

#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tilepack::cli {

/// The heading of the help below which what most people need stands.
inline constexpr const char* most_used = "Most used";

/// Options and flags for `fields`, whose values as text go into `values` under the fields' names; they are
/// checked by bake_options, later. In the help the fields of `first` stand below most_used, in that order, the
/// others below a heading a scope; each with its default. `values` must outlive the parsing.
void add_field_options(Options& options, std::span<const BakeField> fields,
                       std::span<const std::string_view> first, std::map<std::string, std::string>& values);

/// The --format of verbs that also write images: what is printed, text or json. It once named the images, and
/// still does where it is given one of their formats; so does --report-format what it named.
struct PrintedFormat {
  std::vector<std::string> given; ///< as on the command line
  std::string old_name;           ///< of --report-format

  bool json() const;

  /// Whether text is printed even if all should be quiet: it was asked for by name.
  bool asked_for() const;

  /// Hands a format of images on to `values`, and returns what a user should write now; empty if nothing is
  /// out of date. After parsing.
  std::string settle(std::map<std::string, std::string>& values);
};

void add_printed_format(Options& options, PrintedFormat& format);

} // namespace tilepack::cli
