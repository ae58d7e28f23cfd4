// The check of text that a user typed. Ambiguous or invisible text is rejected, with the reason in one sentence.
#include "app/lessons/history/user_text.h"

#include <stdexcept>
#include <string>

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

std::string comment_problem(const std::string& text) {
  return user_text_problem(UserText::comment, "a comment", text);
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

TEST_CASE("an empty text, or one with any kind of blank at either end, is rejected") {
  for (const unsigned blank : {0x20u, 0xa0u, 0x1680u, 0x2003u, 0x202fu, 0x205fu, 0x3000u}) {
    CAPTURE(blank);
    const std::string b = utf8(blank);
    for (const std::string& text : {b, b + b, b + "Ada", "Ada" + b}) {
      CHECK(is_sentence(name_problem(text)));
      CHECK(is_sentence(comment_problem(text)));
    }
    CHECK(name_problem("Ada" + b + "L").empty());
  }
  CHECK(is_sentence(name_problem("")));
  CHECK(is_sentence(comment_problem("")));
}

TEST_CASE("a line break is allowed inside a comment, and never in a name") {
  CHECK(comment_problem("Calmer.\n\nAnd slower.").empty());
  for (const char* text : {"\n", "Calmer.\n", "\nCalmer."}) CHECK(is_sentence(comment_problem(text)));
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

TEST_CASE("a name has at most 100 bytes, a comment 4000") {
  CHECK(name_problem(std::string(100, 'x')).empty());
  CHECK(name_problem(std::string(101, 'x')) == "a name must have at most 100 bytes in UTF-8, but has 101");
  CHECK(comment_problem(std::string(4000, 'x')).empty());
  CHECK(is_sentence(comment_problem(std::string(4001, 'x'))));
}

TEST_CASE("the history also rejects such names and comments, for any caller") {
  const TempFolder folder;
  History history(folder / "history.db");
  const std::int64_t run =
      history.begin_run(history.begin_session(history.find_or_add_learner("Ada"), "1.0"), some_result(0), "");
  for (const std::string bad : {"", " ", "Ada ",
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
