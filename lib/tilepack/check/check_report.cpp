#include "tilepack/check/check_report.h"

#include "tilepack/json/json_value.h"

#include <fmt/format.h>

#include <map>

namespace tilepack {
namespace {

constexpr int shown_of_a_rule = 8; // a broken set breaks a rule a hundred times, and eight tell the story

std::string counted(int number, std::string_view noun) {
  return fmt::format("{} {}{}", number, noun, number == 1 ? "" : "s");
}

std::string severity_counts(const IssueCounts& counts) {
  return fmt::format("{}, {}, {}", counted(counts.errors, "error"), counted(counts.warnings, "warning"),
                     counted(counts.notes, "note"));
}

} // namespace

bool passed(const Report& report) {
  return count(report.issues).errors == 0;
}

std::string report_text(const Report& report, FieldSpelling spelling) {
  std::string text;
  std::map<Rule, int> seen;
  for (const Issue& issue : report.issues) {
    if (++seen[issue.rule] > shown_of_a_rule) continue;
    const RuleText& rule = text_of(issue.rule);
    text += fmt::format("{} {}: {}\n", name_of(rule.severity), code_of(issue.rule), rule.summary);
    if (!issue.where.empty()) text += fmt::format("  where     {}\n", issue.where);
    if (!issue.found.empty()) text += fmt::format("  found     {}\n", issue.found);
    if (!issue.expected.empty()) text += fmt::format("  expected  {}\n", issue.expected);
    text += fmt::format("  effect    {}\n  fix       {}\n\n", rule.why, spelled(rule.remedy, spelling));
  }
  for (const auto& [rule, number] : seen)
    if (number > shown_of_a_rule)
      text +=
          fmt::format("{} {}: {} more of these; {} lists all\n\n", name_of(text_of(rule).severity),
                      code_of(rule), number - shown_of_a_rule, spelled(field("format", "json"), spelling));
  text +=
      fmt::format("{}: {}. {} ({}, {}, {} looked at)\n", report.subject, passed(report) ? "passed" : "FAILED",
                  severity_counts(count(report.issues)), counted(report.tiles, "tile"),
                  counted(report.maps, "map"), counted(report.levels, "image"));
  return text;
}

std::string report_json(const Report& report, FieldSpelling spelling) {
  const IssueCounts counts = count(report.issues);
  JsonValue issues = JsonValue::array();
  for (const Issue& issue : report.issues) {
    const RuleText& rule = text_of(issue.rule);
    issues.push_back({{"rule", code_of(issue.rule)},
                      {"severity", name_of(rule.severity)},
                      {"summary", rule.summary},
                      {"where", issue.where},
                      {"found", issue.found},
                      {"expected", issue.expected},
                      {"effect", rule.why},
                      {"remedy", spelled(rule.remedy, spelling)}});
  }
  return json_text(
      {{"pack", report.subject},
       {"passed", passed(report)},
       {"counts", {{"errors", counts.errors}, {"warnings", counts.warnings}, {"notes", counts.notes}}},
       {"looked_at", {{"tiles", report.tiles}, {"maps", report.maps}, {"images", report.levels}}},
       {"issues", std::move(issues)}});
}

std::string rules_text(FieldSpelling spelling) {
  std::string text;
  for (const RuleText& rule : rules())
    text += fmt::format("{} {:<7} {}\n              {}\n              {}\n", code_of(rule.rule),
                        name_of(rule.severity), rule.summary, rule.why, spelled(rule.remedy, spelling));
  return text;
}

std::string rules_json(FieldSpelling spelling) {
  JsonValue list = JsonValue::array();
  for (const RuleText& rule : rules())
    list.push_back({{"rule", code_of(rule.rule)},
                    {"severity", name_of(rule.severity)},
                    {"summary", rule.summary},
                    {"effect", rule.why},
                    {"remedy", spelled(rule.remedy, spelling)}});
  return json_text({{"rules", std::move(list)}});
}

} // namespace tilepack
