// What a person types and the history keeps: names of learners and instructors, comments.
//
// This work is based on:
// F. Yergeau. RFC 3629, UTF-8, a transformation format of ISO 10646. 2003
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace gearshift {

inline constexpr std::size_t kLongestName = 100;      // [bytes] of UTF-8
inline constexpr std::size_t kLongestComment = 4000;  // [bytes] of UTF-8

enum class TypedText {
  name,    // one line
  comment  // may have line breaks: "\n"
};

// Why the text is not taken, in one sentence that begins with `what` ("a learner's name"); empty: it is. Refused: what
// is empty, blank, too long or no UTF-8; blanks or line breaks at either end; control characters; characters that are
// not seen or turn the writing (U+200B to U+200F, U+202A to U+202E, U+2060 to U+2069, U+FEFF and the like).
std::string typed_text_problem(TypedText kind, std::string_view what, std::string_view text);

// Throws std::invalid_argument with that sentence.
void check_typed_text(TypedText kind, std::string_view what, std::string_view text);
void check_learner_name(std::string_view name);

}  // namespace gearshift
