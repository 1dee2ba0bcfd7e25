#include "tilepack/measure/mapping_survey.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <catch2/catch.hpp>

using namespace tilepack;

TEST_CASE("a survey compares a mapping with tables of 8 to 4096 entries and with mix") {
  const ColorCounts colors{2, 2, 0};
  const auto survey = mapping_survey(mix_mapping({1 << 20, 64}, 4), colors, 4, 64);
  REQUIRE(survey.size() == 12);
  CHECK(survey.front().name == "mix");
  CHECK(survey[1].name == "permutation 8");
  CHECK(survey[5].name == "permutation 65"); // odd, between 64 and 128
  CHECK(survey[11].name == "permutation 4096");
  CHECK(survey.back().name == "permutation 4096"); // mix is the given one
  CHECK(survey.front().statistics.faults.empty());
  CHECK_FALSE(survey[1].statistics.faults.empty());

  const auto json = nlohmann::json::parse(survey_json(survey));
  CHECK(json["window"] == nlohmann::json{64, 64});
  CHECK(json["mappings"].size() == 12);
  CHECK(json["mappings"][1]["table_size"] == 8);
  const int period = json["mappings"][1]["families"][0]["period"]["columns"];
  CHECK((period > 0 && 8 % period == 0)); // of eight entries
  const std::string text = survey_text(survey);
  CHECK(text.find("no fault found") != std::string::npos);
  CHECK(text.find("permutation 4096") != std::string::npos);

  const SurveySheet sheet = survey_sheet(survey, colors, 32, 64);
  REQUIRE(sheet.panels.size() == 12);
  for (std::size_t i = 0; i < sheet.panels.size();
       ++i) { // each panel begins with the color of its cell (0, 0)
    const auto shown = sheet.picture.texel(sheet.panels[i].x, sheet.panels[i].y);
    const Image cells = mapping_picture(survey[i].mapping, colors, 1);
    CHECK(std::equal(shown.begin(), shown.end(), cells.texel(0, 0).begin()));
  }
}

TEST_CASE("a survey of an index map and of a texture of one cell") {
  const ColorCounts colors{0, 0, 2};
  const auto survey = mapping_survey(index_mapping(mix_mapping({20, 20}, 4), colors), colors, 4);
  CHECK(survey.front().name == "index");
  CHECK(survey.front().statistics.families.size() == 1);
  CHECK(survey.back().name == "mix");
  CHECK(mapping_survey(mix_mapping({20, 20}, 5), colors, 4).back().name == "mix"); // of another seed
  CHECK_FALSE(survey_text(mapping_survey(mix_mapping({1, 1}, 0), colors, 0)).empty());
}
