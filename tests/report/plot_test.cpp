#include "tilepack/report/html_page.h"
#include "tilepack/report/plot.h"

#include <catch2/catch.hpp>
#include <cmath>

using namespace tilepack;

namespace {

int count_of(const std::string& text, const std::string& part) {
  int count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

} // namespace

TEST_CASE("plots of nothing, of one point and of zeros on a logarithm are drawn") {
  for (const bool log : {false, true}) {
    Plot plot{"empty", "x", "y", log, log, {{"a", {}, {}, true}}};
    CHECK(svg(plot).find("nan") == std::string::npos);
    plot.series[0].points = {{3, 0}};
    CHECK(svg(plot).find("nan") == std::string::npos);
    CHECK(svg(plot).find("inf") == std::string::npos);
  }
}

TEST_CASE("a value that isn't finite is left out and breaks the line") {
  const Plot plot{"broken", "x", "y", false, false, {{"a", {{0, 1}, {1, 2}, {2, NAN}, {3, 4}, {4, 5}}, {}}}};
  const std::string text = svg(plot);
  CHECK(count_of(text, "<title>") == 4);
  const std::size_t end = text.find("fill=\"none\"");
  REQUIRE(end != std::string::npos);
  CHECK(count_of(text.substr(0, end).substr(text.rfind("<path", end)), "M") == 2);
}

TEST_CASE("series are told apart by color, dashes and marks, and each has its name below the plot") {
  Plot plot{"lines & <dots>", "x", "y", false, false, {}};
  plot.series.push_back({"dots", {{1, 1}, {2, 2}}, {"first"}, false});
  plot.series.push_back({"bound", {{1, 1}, {2, 2}}, {}, true, false, true, 0});
  const std::string text = svg(plot);
  CHECK(count_of(text, "stroke-dasharray") == 2); // the line, and its sample in the legend
  CHECK(count_of(text, "<circle") == 3);
  CHECK(count_of(text, "#d55e00") == 0); // the second was given the first's color
  CHECK(text.find("dots: first") != std::string::npos);
  CHECK(text.find("lines &amp; &lt;dots&gt;") != std::string::npos);
  CHECK(text.find(">bound</text>") != std::string::npos);
}

TEST_CASE("a page stands alone, and its pictures and tables fit a narrow screen") {
  const std::string page = html_page("a & b", "<p>body</p>");
  CHECK(page.find("<title>a &amp; b</title>") != std::string::npos);
  CHECK(page.find("width=device-width") != std::string::npos);
  CHECK(page.find("img { max-width: 100%; height: auto") != std::string::npos);
  CHECK(page.find("overflow-x: auto") != std::string::npos);
  CHECK(page.find("http") == std::string::npos);
  CHECK(page.substr(page.size() - 26) == "<p>body</p></body></html>\n");
  CHECK(escaped("<a href=\"x\">&") == "&lt;a href=&quot;x&quot;&gt;&amp;");
}
