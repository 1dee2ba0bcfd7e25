#include "tilepack/report/html_page.h"

namespace tilepack {
namespace {

constexpr std::string_view before_title =
    R"(<!doctype html>
<html lang="en"><head><meta charset="utf-8"/><meta name="viewport" content="width=device-width"/><title>)";

constexpr std::string_view after_title = R"(</title>
<style>
body { font: 15px/1.45 sans-serif; max-width: 1320px; margin: 2em auto; padding: 0 1em; color: #222; background: #fff; overflow-wrap: break-word }
h1 { font-size: 1.5em } h2 { font-size: 1.15em; margin-top: 2em } p { max-width: 75em }
table { display: block; width: fit-content; max-width: 100%; overflow-x: auto; border-collapse: collapse; font-size: 13px; margin: 1em 0 }
td, th { padding: 2px 10px; text-align: right; border-bottom: 1px solid #e4e4e4 }
td:first-child, th:first-child { text-align: left } .words td, .words th { text-align: left; min-width: 6em }
.words td:nth-child(2) { text-align: right; white-space: nowrap }
.told td:nth-child(-n+2), .told th:nth-child(-n+2), .costs td:nth-child(-n+5), .costs th:nth-child(-n+5) { text-align: left }
.verdict, .advice { border-left: 5px solid; padding: .6em 1em; background: #f6f8fa }
.verdict ul, .advice ul { margin: .3em 0; padding-left: 1.2em } .advice { border-color: #0072b2 }
.verdict.good { border-color: #00704f } .verdict.fair { border-color: #c98500 } .verdict.poor { border-color: #b3261e }
b.good, td.good { color: #00704f } b.fair { color: #8f5f00 } b.poor { color: #b3261e }
td.bad { color: #b3261e; font-weight: bold; background: #fdeceb } .best { color: #00704f; font-weight: bold }
.row { display: flex; flex-wrap: wrap; gap: 1.5em; align-items: flex-start; margin: 1em 0 }
.plot { flex: 1 1 400px; min-width: 0; max-width: 560px; width: 100%; height: auto; border: 1px solid #ddd }
figure { margin: 0; max-width: 100% } figcaption { font-size: 13px; max-width: 60em }
img { max-width: 100%; height: auto; border: 1px solid #ddd } pre { overflow-x: auto }
.swatch { display: inline-block; width: 1.1em; height: 1.1em; vertical-align: -0.2em; margin: 0 .3em 0 .9em }
.bar { display: inline-block; height: .8em; background: #0072b2 }
</style></head><body>
)";

} // namespace

std::string escaped(std::string_view text) {
  std::string result;
  for (const char c : text) {
    if (c == '&')
      result += "&amp;";
    else if (c == '<')
      result += "&lt;";
    else if (c == '>')
      result += "&gt;";
    else if (c == '"')
      result += "&quot;";
    else
      result += c;
  }
  return result;
}

std::string html_page(std::string_view title, std::string_view body) {
  std::string page(before_title);
  page += escaped(title);
  page += after_title;
  page += body;
  return page + "</body></html>\n";
}

} // namespace tilepack
