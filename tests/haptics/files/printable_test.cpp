#include "haptics/files/printable.h"

#include <string>

#include <doctest/doctest.h>

#include "haptics/files/file_error.h"

using namespace gearshift::haptics;

TEST_CASE("control characters are replaced by visible ones") {
  CHECK(printable("plain 12 mm") == "plain 12 mm");
  CHECK(printable("two\r\nlines\tand") == "two  lines and");
  CHECK(printable("\x1b[31mred\x1b[0m") == "?[31mred?[0m");
  CHECK(printable(std::string("a\0b", 3)) == "a?b");
  CHECK(printable("del\x7f") == "del?");
  CHECK(printable("c1 \xc2\x9b"
                  "31m \xc2\x80\xc2\x9f") == "c1 ?31m ??");
}

// The nine characters of CVE-2021-42574, and Unicode's line and paragraph separators; the neighbours are left alone.
TEST_CASE("characters that change the direction of writing or end a line are replaced") {
  for (const char* text : {"\u202a", "\u202b", "\u202c", "\u202d", "\u202e", "\u2066", "\u2067", "\u2068", "\u2069"})
    CHECK(printable(std::string("a") + text + "b") == "a?b");
  CHECK(printable("a\u2028b\u2029c") == "a b c");
  for (const char* text : {"\u2027", "\u202f", "\u2065", "\u206a", "\u2014", "\xe2\x80", "\u05d0\u0628"})
    CHECK(printable(text) == text);
}

TEST_CASE("lines are kept where they are wanted") {
  CHECK(printable_lines("two\nlines\r\n\u202eand a\ttab\n") == "two\nlines \n?and a tab\n");
  CHECK(printable_lines("") == "");
}

TEST_CASE("letters of other alphabets are not control characters") {
  for (const char* text : {"\xc2\xa0", "\xc3\x9b", "\xc3\x84ra", "\xe6\x9b\xb4", "\xff", "\xc2", ""}) {
    CHECK(printable(text) == text);
    CHECK(is_printable(text));
  }
  CHECK_FALSE(is_printable("a\nb"));
  CHECK_FALSE(is_printable("\xc2\x9b"));
}

TEST_CASE("a FileError never contains a control character, whatever the file's name and content") {
  const std::string sentence = FileError("odd\nname\x1b[2J.toml", 3, "x = \"\x1b[31m\n\": no").what();
  CHECK(sentence == "odd name?[2J.toml:3: x = \"?[31m \": no");
}
