#include "app/lessons/history/user_text.h"

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <optional>
#include <stdexcept>

#include <fmt/format.h>

namespace gearshift::lessons {
namespace {

struct Span {
  char32_t first, last;
};

constexpr char32_t kLineBreak = U'\n';

// Blanks (Unicode 15, category Zs).
constexpr Span kBlanks[] = {{0x20, 0x20},     {0xa0, 0xa0},     {0x1680, 0x1680}, {0x2000, 0x200a},
                            {0x202f, 0x202f}, {0x205f, 0x205f}, {0x3000, 0x3000}};

// Control characters: C0, DEL, C1, line and paragraph separators.
constexpr Span kControls[] = {{0x00, 0x1f}, {0x7f, 0x9f}, {0x2028, 0x2029}};

// Characters that are invisible or change the writing direction: with them, two different names can look the same.
constexpr Span kInvisible[] = {
    {0xad, 0xad},     {0x34f, 0x34f},   {0x61c, 0x61c},   {0x115f, 0x1160},   {0x17b4, 0x17b5},  {0x180b, 0x180f},
    {0x200b, 0x200f}, {0x202a, 0x202e}, {0x2060, 0x206f}, {0x2800, 0x2800},   {0x3164, 0x3164},  {0xfe00, 0xfe0f},
    {0xfeff, 0xfeff}, {0xffa0, 0xffa0}, {0xfff0, 0xfffb}, {0x1d173, 0x1d17a}, {0xe0000, 0xe0fff}};

template <std::size_t n>
bool is_in(const Span (&spans)[n], char32_t point) {
  return std::any_of(std::begin(spans), std::end(spans),
                     [point](const Span& span) { return span.first <= point && point <= span.last; });
}

bool is_blank(char32_t point) {
  return point == kLineBreak || is_in(kBlanks, point);
}

bool is_continuation(unsigned char byte) {
  return (byte & 0xc0u) == 0x80u;
}

// Length of the UTF-8 sequence that starts with this byte (RFC 3629, section 3); 0: no sequence starts with it.
std::size_t sequence_length(unsigned char byte) {
  if (byte < 0x80) return 1;
  if (byte < 0xc2) return 0;
  if (byte < 0xe0) return 2;
  if (byte < 0xf0) return 3;
  return byte < 0xf5 ? 4 : 0;
}

// Removes the first code point from the text and returns it; empty if the text does not start with a valid code point.
std::optional<char32_t> take_point(std::string_view& text) {
  const auto byte = [&](std::size_t at) { return static_cast<unsigned char>(text[at]); };
  const std::size_t length = sequence_length(byte(0));
  if (length == 0 || length > text.size()) return std::nullopt;
  char32_t point = length == 1 ? byte(0) : byte(0) & (0xffu >> (length + 1));
  for (std::size_t at = 1; at < length; ++at) {
    if (!is_continuation(byte(at))) return std::nullopt;
    point = (point << 6) | (byte(at) & 0x3fu);
  }
  constexpr char32_t kMinPoint[] = {0x0, 0x0, 0x80, 0x800, 0x10000};
  const bool surrogate = point >= 0xd800 && point <= 0xdfff;
  if (point < kMinPoint[length] || surrogate || point > 0x10ffff) return std::nullopt;
  text.remove_prefix(length);
  return point;
}

std::optional<std::u32string> points_of(std::string_view text) {
  std::u32string points;
  while (!text.empty()) {
    const std::optional<char32_t> point = take_point(text);
    if (!point) return std::nullopt;
    points += *point;
  }
  return points;
}

// Returns the problem as the predicate of a sentence, for example "must not be blank"; empty: no problem.
std::string points_problem(UserText kind, const std::u32string& points) {
  for (const char32_t point : points) {
    if (is_in(kControls, point) && !(kind == UserText::comment && point == kLineBreak))
      return fmt::format("must not contain control characters (found U+{:04X})", static_cast<std::uint32_t>(point));
    if (is_in(kInvisible, point))
      return fmt::format("must not contain invisible characters (found U+{:04X})", static_cast<std::uint32_t>(point));
  }
  if (std::all_of(points.begin(), points.end(), is_blank)) return "must not be blank";
  if (is_blank(points.front()) || is_blank(points.back()))
    return kind == UserText::name ? "must not begin or end with a space"
                                  : "must not begin or end with a space or a line break";
  return {};
}

std::string text_problem(UserText kind, std::string_view text) {
  const std::size_t max_bytes = kind == UserText::name ? kMaxNameBytes : kMaxCommentBytes;
  if (text.empty()) return "must not be empty";
  if (text.size() > max_bytes)
    return fmt::format("must have at most {} bytes in UTF-8, but has {}", max_bytes, text.size());
  const std::optional<std::u32string> points = points_of(text);
  return points ? points_problem(kind, *points) : "must be valid UTF-8 text";
}

}  // namespace

std::string user_text_problem(UserText kind, std::string_view label, std::string_view text) {
  const std::string problem = text_problem(kind, text);
  return problem.empty() ? problem : fmt::format("{} {}", label, problem);
}

void check_user_text(UserText kind, std::string_view label, std::string_view text) {
  if (const std::string problem = user_text_problem(kind, label, text); !problem.empty())
    throw std::invalid_argument(problem);
}

void check_learner_name(std::string_view name) {
  check_user_text(UserText::name, "a learner's name", name);
}

}  // namespace gearshift::lessons
