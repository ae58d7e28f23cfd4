#include "app/lessons/history/user_text.h"

#include <unicase.h>
#include <unictype.h>
#include <unigbrk.h>
#include <uninorm.h>
#include <unistr.h>
#include <uniwidth.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <iterator>
#include <memory>
#include <new>
#include <stdexcept>
#include <type_traits>
#include <vector>

#include <fmt/format.h>

namespace gearshift::lessons {
namespace {

constexpr char32_t kLineBreak = U'\n', kNonJoiner = U'\u200c', kJoiner = U'\u200d', kDotAbove = U'\u0307';
constexpr std::size_t kMaxMarks = 4;  // nonspacing marks in a row: UTS #39, 5.4

const std::uint8_t* bytes_of(std::string_view text) {
  return reinterpret_cast<const std::uint8_t*>(text.data());
}

// Takes over what libunistring has allocated: `size` units.
template <class Unit>
std::basic_string<Unit> take(auto* units, std::size_t size) {
  const std::unique_ptr<std::remove_pointer_t<decltype(units)>, decltype(&std::free)> owner(units, &std::free);
  if (units == nullptr) throw std::bad_alloc();
  return {units, units + size};
}

bool is_utf8(std::string_view text) {
  return u8_check(bytes_of(text), text.size()) == nullptr;
}

std::u32string points_of(std::string_view text) {
  std::size_t size = 0;
  std::uint32_t* points = u8_to_u32(bytes_of(text), text.size(), nullptr, &size);
  return take<char32_t>(points, size);
}

std::string utf8_of(const std::u32string& points) {
  const std::vector<std::uint32_t> units(points.begin(), points.end());
  std::size_t size = 0;
  std::uint8_t* bytes = u32_to_u8(units.data(), units.size(), nullptr, &size);
  return take<char>(bytes, size);
}

std::string normalised(std::string_view text) {
  std::size_t size = 0;
  std::uint8_t* bytes = u8_normalize(UNINORM_NFC, bytes_of(text), text.size(), nullptr, &size);
  return take<char>(bytes, size);
}

bool is_blank(char32_t point) {
  return point == kLineBreak || uc_is_general_category(point, UC_SPACE_SEPARATOR);
}

bool is_control(char32_t point) {
  return uc_is_general_category_withtable(point, UC_CATEGORY_MASK_Cc | UC_CATEGORY_MASK_Zl | UC_CATEGORY_MASK_Zp);
}

bool is_mark(char32_t point) {
  return uc_is_general_category_withtable(point, UC_CATEGORY_MASK_Mn | UC_CATEGORY_MASK_Me);
}

// Ignored when text is drawn, or drawn as nothing: the braille blank, and the marks of annotated text.
bool is_invisible(char32_t point) {
  return uc_is_property_default_ignorable_code_point(point) || point == 0x2800 || (point >= 0xfff9 && point <= 0xfffb);
}

bool is_of_script(char32_t point, const char* script) {
  const uc_script_t* of = uc_script(point);
  return of != nullptr && std::string_view(of->name) == script;
}

// The type of the nearest character at or after `at` (step +1) or before (-1) that is not transparent to joining.
int joining_type(const std::u32string& points, std::size_t at, int step) {
  while (at < points.size() && uc_joining_type(points[at]) == UC_JOINING_TYPE_T) at += static_cast<std::size_t>(step);
  return at < points.size() ? uc_joining_type(points[at]) : UC_JOINING_TYPE_U;
}

// RFC 5892, appendix A.1 and A.2: after a virama, which then also needs a letter behind it; ZWNJ between letters that
// would join otherwise. UTS #51: ZWJ between emoji.
bool is_visible_joiner(const std::u32string& points, std::size_t at) {
  if (at == 0 || at + 1 == points.size()) return false;
  const char32_t next = points[at + 1];
  if (uc_combining_class(points[at - 1]) == UC_CCC_VR) return uc_is_general_category(next, UC_LETTER);
  if (points[at] == kNonJoiner) {
    const int left = joining_type(points, at - 1, -1), right = joining_type(points, at + 1, 1);
    return (left == UC_JOINING_TYPE_L || left == UC_JOINING_TYPE_D) &&
           (right == UC_JOINING_TYPE_R || right == UC_JOINING_TYPE_D);
  }
  std::size_t before = at - 1;
  while (before > 0 && (points[before] == 0xfe0f || uc_is_property_emoji_modifier(points[before]))) --before;
  return uc_is_property_extended_pictographic(points[before]) && uc_is_property_extended_pictographic(next);
}

// Variation selectors: forms of ideographs (UTS #37), of Mongolian letters, and text or emoji style (UTS #51).
bool is_visible_selector(const std::u32string& points, std::size_t at) {
  if (at == 0) return false;
  const char32_t point = points[at], base = points[at - 1];
  if (point >= 0x180b && point <= 0x180f && point != 0x180e) return is_of_script(base, "Mongolian");
  if (point == 0xfe0e || point == 0xfe0f) return uc_is_property_extended_pictographic(base);
  const bool selects = (point >= 0xfe00 && point <= 0xfe02) || (point >= 0xe0100 && point <= 0xe01ef);
  return selects && uc_is_property_ideographic(base);
}

bool is_visible(const std::u32string& points, std::size_t at) {
  if (!is_invisible(points[at])) return true;
  const bool joins = points[at] == kNonJoiner || points[at] == kJoiner;
  return joins ? is_visible_joiner(points, at) : is_visible_selector(points, at);
}

bool has_stacked_marks(const std::u32string& points) {
  std::size_t marks = 0;
  for (std::size_t at = 0; at < points.size(); ++at) {
    marks = is_mark(points[at]) ? marks + 1 : 0;
    if (marks > kMaxMarks || (marks > 1 && points[at] == points[at - 1])) return true;
  }
  return false;
}

// The script whose letters look like those of the others here: "Latin", "Greek" or "Cyrillic"; null for other
// characters.
const char* lookalike_script(char32_t point) {
  for (const char* script : {"Latin", "Greek", "Cyrillic"})
    if (uc_is_general_category(point, UC_LETTER) && is_of_script(point, script)) return script;
  return nullptr;
}

std::string mixed_scripts_problem(const std::u32string& points) {
  const char* script = nullptr;
  for (const char32_t point : points) {
    if (is_blank(point)) script = nullptr;
    const char* other = lookalike_script(point);
    if (script != nullptr && other != nullptr && std::string_view(other) != script)
      return fmt::format("must not mix {} and {} letters, which look alike, in one word", script, other);
    if (other != nullptr) script = other;
  }
  return {};
}

// Removes blanks at both ends and, in a name, makes every run of blanks one space.
std::u32string trimmed(UserText kind, const std::u32string& points) {
  const auto first = std::find_if_not(points.begin(), points.end(), is_blank);
  const auto last = std::find_if_not(points.rbegin(), std::make_reverse_iterator(first), is_blank).base();
  std::u32string text;
  for (auto at = first; at != last; ++at) {
    const bool is_space = kind == UserText::name && *at != kLineBreak && is_blank(*at);
    if (!is_space)
      text += *at;
    else if (text.back() != U' ')
      text += U' ';
  }
  return text;
}

// The stored form of valid UTF-8.
std::string stored_text(UserText kind, std::string_view text) {
  return utf8_of(trimmed(kind, points_of(normalised(text))));
}

// Names with the same folded form are taken for each other when they are typed. An i with a dot above looks like an i.
std::string folded(std::string_view name) {
  if (!is_utf8(name)) return std::string(name);
  std::size_t size = 0;
  std::uint8_t* bytes = u8_casefold(bytes_of(name), name.size(), nullptr, UNINORM_NFKC, nullptr, &size);
  std::u32string points = points_of(take<char>(bytes, size)), kept;
  for (const char32_t point : points) {
    const bool is_second_dot = point == kDotAbove && !kept.empty() && uc_is_property_soft_dotted(kept.back());
    if (!is_invisible(point) && !is_second_dot) kept += point;
  }
  return utf8_of(trimmed(UserText::name, kept));
}

std::size_t length_of(std::string_view text) {
  std::vector<char> breaks(text.size());
  u8_grapheme_breaks(bytes_of(text), text.size(), breaks.data());
  return static_cast<std::size_t>(std::count(breaks.begin(), breaks.end(), 1));
}

// Returns the problem as the predicate of a sentence, for example "must not be blank"; empty: no problem. `text` is in
// its stored form.
std::string problem_of(UserText kind, std::string_view text) {
  const std::u32string points = points_of(text);
  if (points.empty()) return "must not be blank";
  for (std::size_t at = 0; at < points.size(); ++at) {
    const auto found = static_cast<std::uint32_t>(points[at]);
    if (is_control(points[at]) && !(kind == UserText::comment && points[at] == kLineBreak))
      return fmt::format("must not contain control characters (found U+{:04X})", found);
    if (!is_visible(points, at))
      return fmt::format("must not contain invisible characters where they change nothing (found U+{:04X})", found);
  }
  if (has_stacked_marks(points))
    return fmt::format("must not have more than {} marks on one letter, or one mark twice", kMaxMarks);
  if (kind == UserText::name) {
    if (std::string mixed = mixed_scripts_problem(points); !mixed.empty()) return mixed;
  }
  const std::size_t max = kind == UserText::name ? kMaxNameLength : kMaxCommentLength, length = length_of(text);
  if (length > max) return fmt::format("must have at most {} characters, but has {}", max, length);
  return {};
}

std::string text_problem(UserText kind, std::string_view text) {
  const std::size_t max_bytes = kind == UserText::name ? kMaxNameBytes : kMaxCommentBytes;
  if (text.empty()) return "must not be empty";
  if (text.size() > max_bytes)
    return fmt::format("must have at most {} bytes in UTF-8, but has {}", max_bytes, text.size());
  return is_utf8(text) ? problem_of(kind, stored_text(kind, text)) : "must be valid UTF-8 text";
}

}  // namespace

std::string user_text_problem(UserText kind, std::string_view label, std::string_view text) {
  const std::string problem = text_problem(kind, text);
  return problem.empty() ? problem : fmt::format("{} {}", label, problem);
}

std::string checked_text(UserText kind, std::string_view label, std::string_view text) {
  if (const std::string problem = user_text_problem(kind, label, text); !problem.empty())
    throw std::invalid_argument(problem);
  return stored_text(kind, text);
}

std::string checked_learner_name(std::string_view name) {
  return checked_text(UserText::name, "a learner's name", name);
}

std::string stored_name(std::string_view name) {
  return is_utf8(name) ? stored_text(UserText::name, name) : std::string(name);
}

std::optional<std::size_t> find_name(std::span<const std::string> names, std::string_view typed) {
  const std::string stored = stored_name(typed), wanted = folded(typed);
  std::optional<std::size_t> similar;
  bool is_ambiguous = false;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (stored_name(names[i]) == stored) return i;
    if (folded(names[i]) != wanted) continue;
    is_ambiguous = similar.has_value();
    similar = i;
  }
  return is_ambiguous ? std::nullopt : similar;
}

std::size_t text_columns(std::string_view text) {
  return static_cast<std::size_t>(std::max(0, u8_width(bytes_of(text), text.size(), "UTF-8")));
}

}  // namespace gearshift::lessons
