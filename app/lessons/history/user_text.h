// Text that users type and the history stores: names of learners and instructors, comments.
//
// This work is based on:
// F. Yergeau. RFC 3629, UTF-8, a transformation format of ISO 10646. 2003
// Patrik Faltstrom. RFC 5892, The Unicode Code Points and IDNA. 2010 (appendix A: where a joiner is visible)
// Unicode Standard Annex #15, Normalization Forms; #29, Text Segmentation
// Unicode Technical Standard #39, Security Mechanisms (5.1: mixed scripts; 5.4: marks); #51, Emoji
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace gearshift::lessons {

// Lengths in characters as a reader counts them (grapheme clusters), and as bytes of UTF-8, for text fields.
inline constexpr std::size_t kMaxNameLength = 100, kMaxNameBytes = 1000;
inline constexpr std::size_t kMaxCommentLength = 4000, kMaxCommentBytes = 16000;

enum class UserText {
  name,    // one line
  comment  // may contain line breaks ("\n")
};

// Returns why the text is rejected, in one sentence that begins with `label` (for example "a learner's name"); empty if
// the text is accepted. Rejected are: empty, blank or too long text and invalid UTF-8; control characters; invisible
// characters where they change nothing that a reader sees, and characters that change the writing direction; marks
// stacked so high that they cover other text; in a name, Latin letters beside Greek or Cyrillic ones in one word.
// Joiners and variation selectors are accepted where a script needs them.
std::string user_text_problem(UserText kind, std::string_view label, std::string_view text);

// Returns the text in the form in which the history stores it: normalised (NFC), without blanks at either end; in a
// name, one space for several blanks. Throws std::invalid_argument with the sentence from user_text_problem().
std::string checked_text(UserText kind, std::string_view label, std::string_view text);
std::string checked_learner_name(std::string_view name);

// Returns the stored form without a check. Names look equal if their stored forms are equal.
std::string stored_name(std::string_view name);

// Returns the index of the name that `typed` means: the one that looks equal, otherwise the only one that differs just
// in upper and lower case, invisible characters, width or ligatures (NFKC case folding). Empty: none, or several.
std::optional<std::size_t> find_name(std::span<const std::string> names, std::string_view typed);

std::size_t text_columns(std::string_view text);  // width in a terminal, in columns; valid UTF-8

}  // namespace gearshift::lessons
