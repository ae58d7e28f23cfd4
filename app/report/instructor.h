// What the instructor says to a learner's runs, by their numbers.
#pragma once

#include <cstdint>
#include <string>

#include "app/history/history.h"

namespace gearshift {

// All throw std::runtime_error, one sentence that names what there is, for a run or a comment that is none of this
// learner's; std::invalid_argument for what is no name or no comment (typed_text.h); HistoryError.
std::int64_t comment_on_run(History& history, const LearnerRow& learner, std::int64_t run, const std::string& author,
                            const std::string& text);  // returns its number
void edit_comment(History& history, const LearnerRow& learner, std::int64_t comment, const std::string& text);
void delete_comment(History& history, const LearnerRow& learner, std::int64_t comment);

}  // namespace gearshift
