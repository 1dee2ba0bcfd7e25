#include "tilepack/error/printable.h"

#include <catch2/catch.hpp>

using tilepack::printable;

TEST_CASE("what would move a terminal's cursor is spelled") {
  CHECK(printable("a\x1b[31mb") == "a\\x1b[31mb");
  CHECK(printable("two\nlines\r\tand") == "two\\nlines\\r\\tand");
  CHECK(printable(std::string_view("a\0b", 3)) == "a\\x00b");
  CHECK(printable("\x7f") == "\\x7f");
  CHECK(printable("\xC2\x9B") == "\\x9b"); // a control sequence in one character
  CHECK(printable("a\xE2\x80\xAE"
                  "b") == "a\\u202eb"); // reverses the line
}

TEST_CASE("bytes that are no UTF-8 are spelled, and UTF-8 stays") {
  CHECK(printable("höhe 高さ 🎨") == "höhe 高さ 🎨");
  CHECK(printable("a\\n") == "a\\n");
  CHECK(printable("\xFF\xFE") == "\\xff\\xfe");
  CHECK(printable("\xC3") == "\\xc3");
  CHECK(printable("\xC0\xAF") == "\\xc0\\xaf");          // overlong
  CHECK(printable("\xED\xA0\x80") == "\\xed\\xa0\\x80"); // a surrogate
  CHECK(printable("\xE2\x82x") == "\\xe2\\x82x");
  CHECK(printable("") == "");
}
