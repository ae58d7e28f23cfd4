// Lets an instructor comment on a learner's runs by run number.
#pragma once

#include <cstdint>
#include <string>

#include "app/lessons/history/history.h"

namespace gearshift::lessons {

// All three functions throw std::runtime_error if the run or comment does not belong to this learner; the message lists
// the valid numbers. They throw std::invalid_argument for an invalid name or comment (user_text.h). They also throw
// HistoryError.
std::int64_t comment_on_run(History& history, const LearnerRow& learner, std::int64_t run, const std::string& author,
                            const std::string& text);  // returns the comment's number
void edit_comment(History& history, const LearnerRow& learner, std::int64_t comment, const std::string& text);
void delete_comment(History& history, const LearnerRow& learner, std::int64_t comment);

}  // namespace gearshift::lessons
