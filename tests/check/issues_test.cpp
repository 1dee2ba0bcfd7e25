#include "tilepack/check/check_report.h"
#include "tilepack/check/issues.h"

#include <nlohmann/json.hpp>

#include <catch2/catch.hpp>
#include <set>

using namespace tilepack;

TEST_CASE("rules are numbered upwards, and each says what, why and what to do") {
  int last = 100;
  std::set<std::string_view> summaries;
  for (const RuleText& rule : rules()) {
    CHECK(static_cast<int>(rule.rule) > last);
    last = static_cast<int>(rule.rule);
    CHECK(&text_of(rule.rule) == &rule);
    CHECK(summaries.insert(rule.summary).second);
    CHECK_FALSE(rule.why.empty());
    CHECK(rule.remedy.ends_with("."));
  }
}

TEST_CASE("numbers once given stay what they were") {
  CHECK(code_of(Rule::not_json) == "TP101");
  CHECK(code_of(Rule::file_missing) == "TP201");
  CHECK(code_of(Rule::border_colors) == "TP308");
  CHECK(code_of(Rule::edge_texels) == "TP403");
  CHECK(code_of(Rule::table_not_permutation) == "TP501");
  CHECK(code_of(Rule::levels_missing) == "TP601");
}

TEST_CASE("a report passes with warnings and fails with errors") {
  Report report{
      "pack", 16, 1, 5, {{Rule::table_repeats_rows, "a", "b", "c"}, {Rule::file_stray, "d", "", ""}}};
  CHECK(passed(report));
  CHECK(report_text(report).ends_with(
      "pack: passed. 0 errors, 1 warning, 1 note (16 tiles, 1 map, 5 images looked at)\n"));
  report.issues.push_back({Rule::not_finite, "map color", "nan", "a finite number"});
  CHECK_FALSE(passed(report));
  const std::string text = report_text(report);
  CHECK(text.find("error TP401: ") != std::string::npos);
  CHECK(text.find("where     map color\n") != std::string::npos);
  CHECK(text.find("pack: FAILED. 1 error, 1 warning, 1 note") != std::string::npos);
}

TEST_CASE("a text report lists a rule's first issues and counts the rest, a JSON report lists all") {
  Report report{"pack", 16, 1, 5, {}};
  for (int i = 0; i < 50; ++i)
    report.issues.push_back({Rule::edge_texels, "tile " + std::to_string(i), "", ""});
  const std::string text = report_text(report);
  CHECK(text.find("tile 0\n") != std::string::npos);
  CHECK(text.find("tile 49\n") == std::string::npos);
  CHECK(text.find("TP403: 42 more of these") != std::string::npos);
  CHECK(text.find("50 errors") != std::string::npos);
  CHECK(nlohmann::json::parse(report_json(report))["issues"].size() == 50);
}

TEST_CASE("bytes that are no UTF-8 do not break a JSON report") {
  const Report report{"p\xff", 0, 0, 0, {{Rule::field_unknown, "\xc3(", "\x80", ""}}};
  CHECK(nlohmann::json::parse(report_json(report))["issues"].size() == 1);
}

TEST_CASE("the table of rules can be listed for people and programs") {
  CHECK(rules_text().find("TP208 note") != std::string::npos);
  CHECK(nlohmann::json::parse(rules_json())["rules"].size() == rules().size());
}
