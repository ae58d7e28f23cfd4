// Validates text that users type and the history stores: names of learners and instructors, comments.
//
// This work is based on:
// F. Yergeau. RFC 3629, UTF-8, a transformation format of ISO 10646. 2003
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace gearshift::lessons {

inline constexpr std::size_t kMaxNameBytes = 100;      // [bytes] of UTF-8
inline constexpr std::size_t kMaxCommentBytes = 4000;  // [bytes] of UTF-8

enum class UserText {
  name,    // one line
  comment  // may contain line breaks ("\n")
};

// Returns why the text is rejected, in one sentence that begins with `label` (for example "a learner's name"); empty if
// the text is accepted. Rejected are: empty, blank or too long text and invalid UTF-8; blanks or line breaks at either
// end; control characters; invisible characters and characters that change the writing direction (U+200B to U+200F,
// U+202A to U+202E, U+2060 to U+206F, U+FEFF and the like).
std::string user_text_problem(UserText kind, std::string_view label, std::string_view text);

// If the text is rejected, throws std::invalid_argument with the sentence from user_text_problem().
void check_user_text(UserText kind, std::string_view label, std::string_view text);
void check_learner_name(std::string_view name);

}  // namespace gearshift::lessons
