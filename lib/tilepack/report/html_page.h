#pragma once

#include <string>
#include <string_view>

/// What all pages share: they stand alone (nothing fetched, no scripts) and can be read on a screen of 400
/// pixels: pictures keep their shape, tables scroll sideways on their own.
namespace tilepack {

/// `text` with &, <, > and " as entities, for HTML and SVG.
std::string escaped(std::string_view text);

/// A whole page. `title` is plain text; `body` is HTML. Classes that the one style sheet knows:
///   div.row: figures and plots side by side, as many as fit · div.verdict, div.advice: a box with a bar
///   .good .fair .poor .bad .best: how a word or a figure is judged · td.bad: a marked cell
///   tables have numbers to the right and the first column to the left; .told: two, .costs: five columns to
///   the left, .words: all but the second · .swatch, .bar: a color, a length · figure > img or svg
std::string html_page(std::string_view title, std::string_view body);

} // namespace tilepack
