// The check of text that a user typed. Ambiguous or invisible text is rejected, with the reason in one sentence.
#include "app/lessons/history/user_text.h"

#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "app/lessons/history/history.h"
#include "haptics/files/printable.h"
#include "tests/app/lessons/history/sample_result.h"
#include "tests/support/temp_folder.h"

using namespace gearshift::haptics;
using namespace gearshift::lessons;
using namespace gearshift::test;

namespace {

std::string name_problem(const std::string& name) {
  return user_text_problem(UserText::name, "a name", name);
}

std::string stored(const std::string& name) {
  return checked_text(UserText::name, "a name", name);
}

std::string comment_problem(const std::string& text) {
  return user_text_problem(UserText::comment, "a comment", text);
}

std::string repeated(const std::string& text, int times) {
  std::string all;
  for (int i = 0; i < times; ++i) all += text;
  return all;
}

// A UTF-8 encoder written from table 3-6 of the Unicode standard.
std::string utf8(unsigned point) {
  const auto tail = [&](unsigned shift) { return static_cast<char>(0x80 | ((point >> shift) & 0x3f)); };
  if (point < 0x80) return {static_cast<char>(point)};
  if (point < 0x800) return {static_cast<char>(0xc0 | (point >> 6)), tail(0)};
  if (point < 0x10000) return {static_cast<char>(0xe0 | (point >> 12)), tail(6), tail(0)};
  return {static_cast<char>(0xf0 | (point >> 18)), tail(12), tail(6), tail(0)};
}

bool is_sentence(const std::string& problem) {
  return problem.starts_with("a ") && is_printable(problem);
}

}  // namespace

TEST_CASE("common names are accepted") {
  for (const char* name : {"Ada", "Ada Löwe", "O'Neil-Śmith, jr.", "李小龍", "Владимир", "بسام", "Zoë \xf0\x9f\x9a\x97",
                           "x", "<b>&\"'", "=1+1", "..", "a/b"}) {
    CAPTURE(name);
    CHECK(name_problem(name).empty());
    CHECK(comment_problem(name).empty());
  }
}

TEST_CASE("an empty or blank text is rejected; blanks at either end are left out, several in a name become one") {
  for (const unsigned blank : {0x20u, 0xa0u, 0x1680u, 0x2003u, 0x202fu, 0x205fu, 0x3000u}) {
    CAPTURE(blank);
    const std::string b = utf8(blank);
    for (const std::string& text : {b, b + b}) {
      CHECK(is_sentence(name_problem(text)));
      CHECK(is_sentence(comment_problem(text)));
    }
    CHECK(stored(b + "Ada" + b + b + "L" + b) == "Ada L");
    CHECK(checked_text(UserText::comment, "a comment", b + "Calm." + b) == "Calm.");
  }
  CHECK(is_sentence(name_problem("")));
  CHECK(is_sentence(comment_problem("")));
}

TEST_CASE("a line break is allowed inside a comment, and never in a name") {
  CHECK(comment_problem("Calmer.\n\nAnd slower.").empty());
  CHECK(checked_text(UserText::comment, "a comment", "\nCalmer.\n\nAnd slower.\n") == "Calmer.\n\nAnd slower.");
  CHECK(is_sentence(comment_problem("\n")));
  CHECK(is_sentence(name_problem("A\nda")));
}

TEST_CASE("control, invisible and direction-changing characters are rejected") {
  const auto refused = [](unsigned first, unsigned last) {
    for (unsigned point = first; point <= last; ++point) {
      CAPTURE(point);
      CHECK(is_sentence(name_problem("A" + utf8(point) + "da")));
      if (point != '\n') CHECK(is_sentence(comment_problem("A" + utf8(point) + "da")));
    }
  };
  refused(0x00, 0x1f);
  refused(0x7f, 0x9f);
  refused(0x200b, 0x200f);
  refused(0x2028, 0x202e);
  refused(0x2060, 0x2069);
  refused(0xfeff, 0xfeff);
  for (const unsigned other : {0xadu, 0x61cu, 0x3164u, 0xe0041u}) refused(other, other);
  CHECK(name_problem("A" + utf8(0x200b) + "da").find("U+200B") != std::string::npos);
  for (const unsigned printable : {0x2010u, 0x2026u, 0x2030u, 0x20acu, 0xfefcu})
    CHECK(name_problem(utf8(printable)).empty());
}

// RFC 3629 forbids overlong forms, surrogates, values above U+10FFFF and truncated sequences.
TEST_CASE("invalid UTF-8 is rejected") {
  for (const char* bytes :
       {"\x80", "\xbf", "\xc0\xaf", "\xc1\xbf", "\xc3", "\xc3(", "\xe0\x80\xaf", "\xe0\x9f\xbf", "\xe2\x82",
        "\xe2(\xa1", "\xed\xa0\x80", "\xed\xbf\xbf", "\xf0\x80\x80\xaf", "\xf0\x8f\xbf\xbf", "\xf4\x90\x80\x80",
        "\xf0\x9f\x9a", "\xf5\x80\x80\x80", "\xfe", "\xff"}) {
    CAPTURE(printable(bytes));
    for (const std::string& text : {std::string(bytes), "Ada" + std::string(bytes), std::string(bytes) + "Ada"}) {
      CHECK(name_problem(text).find("UTF-8") != std::string::npos);
      CHECK(comment_problem(text).find("UTF-8") != std::string::npos);
    }
  }
  for (const unsigned point : {0x7eu, 0xa1u, 0x7feu, 0x801u, 0xd7ffu, 0xe000u, 0xfffdu, 0x10000u, 0x10ffffu})
    CHECK(name_problem(utf8(point)).empty());
}

// Lengths count what a reader sees as one character, so a name in any script may be as long as in another.
TEST_CASE("a name has at most 100 characters, a comment 4000, in any script") {
  const std::string thai = "ประสิทธิ์ศักดิ์ วงศ์สุวรรณกุลพัฒนานันท์";  // 35 letters and marks: 115 bytes
  CHECK(thai.size() > 100);
  CHECK(name_problem(thai).empty());
  const std::string family = "👨\u200d👩\u200d👧";  // one character of 18 bytes
  for (const std::string character : {"x", "é", "e\u0301", "ที่", "각", "🇩🇪"}) {
    CAPTURE(character);
    CHECK(name_problem(repeated(character, 100)).empty());
    CHECK(name_problem(repeated(character, 101)) == "a name must have at most 100 characters, but has 101");
  }
  CHECK(name_problem(repeated(family, 50)).empty());
  CHECK(name_problem(repeated(family, 56)) == "a name must have at most 1000 bytes in UTF-8, but has 1008");
  CHECK(comment_problem(std::string(4000, 'x')).empty());
  CHECK(is_sentence(comment_problem(std::string(4001, 'x'))));
}

// Canonically equivalent strings look the same (UAX #15, figures 3 and 4).
TEST_CASE("a text is stored composed, whichever form was typed") {
  CHECK(stored("Zoe\u0308") == "Zo\u00eb");
  CHECK(stored("\u212bsa") == "\u00c5sa");     // the Angstrom sign
  CHECK(stored("s\u0307\u0323") == "\u1e69");  // marks in either order
  CHECK(stored("s\u0323\u0307") == "\u1e69");
  CHECK(stored("\u1112\u1161\u11ab") == "\ud55c");  // Hangul
  CHECK(stored_name("Zoe\u0308  L") == stored_name(" Zo\u00eb\u00a0L"));
  CHECK(stored_name("Zoe") != stored_name("Zo\u00eb"));
  CHECK(checked_text(UserText::comment, "a comment", "Zoe\u0308\n\nCalm.") == "Zo\u00eb\n\nCalm.");
}

TEST_CASE("a typed name means the one that looks equal, else the only one that differs in case, width or joiners") {
  const std::vector<std::string> names{"Ada", "Zo\u00eb", "Ada L",
                                       "bo",  "Bo",       "\u0639\u0644\u06cc\u200c\u0631\u0636\u0627"};
  const auto meant = [&](const std::string& typed) {
    const std::optional<std::size_t> found = find_name(names, typed);
    return found ? names[*found] : std::string();
  };
  CHECK(meant("Ada") == "Ada");
  CHECK(meant(" ada ") == "Ada");
  CHECK(meant("ADA  L") == "Ada L");
  CHECK(meant("ZOE\u0308") == "Zo\u00eb");
  CHECK(meant("\uff21\uff44\uff41") == "Ada");  // full width, from a Japanese keyboard
  CHECK(meant("\u0639\u0644\u06cc\u0631\u0636\u0627") == names[5]);
  CHECK(meant("Bo") == "Bo");
  CHECK(meant("bo") == "bo");
  CHECK(meant("BO").empty());  // either of the two
  for (const char* other : {"Adah", "Zoe", "Ada M", "A da", ""}) CHECK(meant(other).empty());
}

// The examples of RFC 5892, appendix A, UTS #51 and UTS #37, and the same characters where they are invisible.
TEST_CASE("joiners and variation selectors are accepted where a script needs them, and rejected where they hide") {
  for (const char* name :
       {"\u0639\u0644\u06cc\u200c\u0631\u0636\u0627",              // Persian Ali-Reza: ZWNJ between joining letters
        "\u0dc1\u0dca\u200d\u0dbb\u0dd3",                          // Sinhala Sri: virama, ZWJ, letter
        "\u0915\u094d\u200d\u0937",                                // Devanagari half form
        "\u0915\u094d\u200c\u0937",                                // visible virama
        "\u8fbb\U000e0100", "\u795e\ufe00",                        // ideographs with a variation
        "\u2764\ufe0f", "\U0001f469\U0001f3fd\u200d\u2695\ufe0f",  // emoji: style, woman health worker
        "\u1820\u180b"}) {                                         // Mongolian
    CAPTURE(name);
    CHECK(name_problem(name).empty());
    CHECK(comment_problem(name).empty());
  }
  for (const char* name : {"A\u200cda", "A\u200dda", "\u200cAda", "Ada\u200d", "\u0628\u200c",
                           "\u0645\u062d\u0645\u062f\u200c\u0639\u0644\u06cc",  // dal never joins to the next letter
                           "\u0915\u094d\u200d", "\u0915\u094d\u200d\u200d\u0937", "A\ufe0f", "1\ufe0f", "A\ufe00",
                           "\u8fbb\U000e0100\U000e0100", "\u2764\u200dA", "A\u180b"}) {
    CAPTURE(name);
    CHECK(is_sentence(name_problem(name)));
    CHECK(is_sentence(comment_problem(name)));
  }
}

TEST_CASE("a name whose letters mix scripts that look alike, or whose marks pile up, is rejected") {
  CHECK(name_problem("\u0410da") == "a name must not mix Cyrillic and Latin letters, which look alike, in one word");
  CHECK(name_problem("\u0410\u0434\u0430 Smith").empty());  // two words
  CHECK(name_problem("\u0391da").find("Greek") != std::string::npos);
  CHECK(name_problem("\u6797Ada").empty());  // no look-alikes
  CHECK(comment_problem("\u0394rpm").empty());
  CHECK(name_problem("a" + repeated("\u0316\u0317", 2)).empty());
  CHECK(is_sentence(name_problem("a" + repeated("\u0316\u0317", 3))));
  CHECK(is_sentence(name_problem("a\u0316\u0316")));
}

TEST_CASE("the history also rejects such names and comments, for any caller") {
  const TempFolder folder;
  History history(folder / "history.db");
  const std::int64_t run =
      history.begin_run(history.begin_session(history.find_or_add_learner("Ada"), "1.0"), some_result(0), "");
  for (const std::string bad : {"", " ",
                                "A\xff"
                                "da",
                                "A\xe2\x80\x8b"
                                "da",
                                "A\tda"}) {
    CAPTURE(bad);
    CHECK_THROWS_AS(history.find_or_add_learner(bad), std::invalid_argument);
    CHECK_THROWS_AS(history.add_comment(run, bad, "Calmer."), std::invalid_argument);
    CHECK_THROWS_AS(history.add_comment(run, "Bo", bad), std::invalid_argument);
  }
  CHECK(history.learners().size() == 1);
  CHECK(comments_of(history, run).empty());
}
