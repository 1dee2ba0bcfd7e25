#include "tilepack/report/vector_drawing.h"

#include <catch2/catch.hpp>

using namespace tilepack;

namespace {

constexpr Paint red{1, 0, 0, 1};

VectorDrawing blank(int width, int height) {
  return {Image(width, height, 3), {}, {}};
}

double sum_of_red(const Image& image) {
  double sum = 0;
  for (int y = 0; y < image.height(); ++y)
    for (int x = 0; x < image.width(); ++x) sum += static_cast<double>(image.texel(x, y)[0]);
  return sum;
}

} // namespace

TEST_CASE("a shape covers the pixels inside it, whole ones wholly and cut ones in part") {
  VectorDrawing drawing = blank(6, 6);
  drawing.shapes.push_back({{{1, 1}, {3.5, 1}, {3.5, 3}, {1, 3}}, red});
  const Image image = rasterised(drawing);
  CHECK(image.texel(0, 1)[0] == 0);
  CHECK(image.texel(1, 1)[0] == Approx(1));
  CHECK(image.texel(2, 2)[0] == Approx(1));
  CHECK(image.texel(3, 2)[0] == Approx(0.5));
  CHECK(image.texel(1, 3)[0] == 0);
  CHECK(image.texel(1, 1)[1] == 0);
}

TEST_CASE("a shape's coverage adds up to its area, and touching shapes leave no gap") {
  VectorDrawing drawing = blank(16, 16);
  drawing.shapes.push_back({{{2, 3}, {13, 5}, {7, 14}}, red});
  CHECK(sum_of_red(rasterised(drawing)) == Approx(0.5 * (11 * 11 - 2 * 5)).epsilon(0.01));
}

TEST_CASE("shapes may reach out of the drawing") {
  VectorDrawing drawing = blank(4, 4);
  drawing.shapes.push_back({{{-10, -10}, {20, -10}, {20, 20}, {-10, 20}}, red});
  drawing.shapes.push_back({{{-9, 1}, {-5, 1}, {-5, 2}}, red});
  drawing.shapes.push_back({{{1, 90}, {2, 95}, {3, 99}}, red});
  drawing.numbers.push_back({{0, 0}, 40, 1234567890, red});
  CHECK(sum_of_red(rasterised(drawing)) == Approx(16));
}

TEST_CASE("paint is laid over what is there by its opacity") {
  VectorDrawing drawing{Image(1, 1, 3, 0.5f), {}, {}};
  drawing.shapes.push_back({{{0, 0}, {1, 0}, {1, 1}, {0, 1}}, {1, 0, 0, 0.5}});
  CHECK(rasterised(drawing).texel(0, 0)[0] == Approx(0.75));
  CHECK(rasterised(drawing).texel(0, 0)[1] == Approx(0.25));
}

TEST_CASE("each digit has its own look, and stands in the middle") {
  std::vector<Image> seen;
  for (int digit = 0; digit < 10; ++digit) {
    VectorDrawing drawing = blank(9, 9);
    drawing.numbers.push_back({{4.5, 4.5}, 7, digit, red});
    seen.push_back(rasterised(drawing));
    for (int other = 0; other < digit; ++other) CHECK(seen[digit] != seen[other]);
    for (int i = 0; i < 9; ++i) {
      CHECK(seen[digit].texel(0, i)[0] == 0);
      CHECK(seen[digit].texel(1, i)[0] == 0);
      CHECK(seen[digit].texel(8, i)[0] == 0);
      CHECK(seen[digit].texel(i, 0)[0] == 0);
      CHECK(seen[digit].texel(i, 8)[0] == 0);
    }
  }
}

TEST_CASE("words are written in letters that differ, and what has no letter is a box") {
  const auto written = [](const std::string& word) {
    VectorDrawing drawing = blank(9, 9);
    drawing.words.push_back({{4.5, 4.5}, 7, word, red});
    return rasterised(drawing);
  };
  const std::string letters(drawn_characters);
  for (const char letter : letters) {
    CHECK(sum_of_red(written({letter})) >= 5); // a dash is five dots
    for (const char other : letters)
      if (letter != other) CHECK(written({letter}) != written({other}));
  }
  CHECK(sum_of_red(written("?")) == 2 * 5 + 2 * 5);
  CHECK(written("?") == written("Z"));
  VectorDrawing drawing = blank(2, 2);
  drawing.words.push_back({{1, 1}, 7, "mix", red});
  CHECK(svg(drawing).find(">mix</text>") != std::string::npos);
}

TEST_CASE("an SVG holds the picture and every shape and number") {
  VectorDrawing drawing = blank(2, 3);
  drawing.shapes.push_back({{{0, 0}, {1, 0}, {0, 1.5}}, {1, 0.5, 0, 0.25}});
  drawing.numbers.push_back({{1, 1}, 7, 42, red});
  const std::string text = svg(drawing);
  CHECK(text.starts_with("<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"2\" height=\"3\""));
  CHECK(text.find("href=\"data:image/png;base64,iVBORw0KGgo") != std::string::npos);
  CHECK(text.find("<polygon points=\"0,0 1,0 0,1.5\" fill=\"#ff8000\" fill-opacity=\"0.25\"/>") !=
        std::string::npos);
  CHECK(text.find(">42</text>") != std::string::npos);
}
