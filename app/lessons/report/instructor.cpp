#include "app/lessons/report/instructor.h"

#include <algorithm>
#include <stdexcept>
#include <vector>

#include <fmt/format.h>

#include "haptics/files/printable.h"

namespace gearshift::lessons {
namespace {

[[noreturn]] void refuse(const char* kind, std::int64_t number, const LearnerRow& learner,
                         const std::vector<std::int64_t>& known) {
  throw std::runtime_error(fmt::format("{0} {1} does not belong to {2}, who has these {0}s: {3}", kind, number,
                                       haptics::printable(learner.name),
                                       known.empty() ? "none" : fmt::format("{}", fmt::join(known, ", "))));
}

void require_known(const char* kind, std::int64_t number, const LearnerRow& learner,
                   const std::vector<std::int64_t>& known) {
  if (std::find(known.begin(), known.end(), number) == known.end()) refuse(kind, number, learner, known);
}

std::vector<std::int64_t> runs_of(History& history, const LearnerRow& learner) {
  std::vector<std::int64_t> numbers;
  for (const RunRow& run : history.runs(learner.id)) numbers.push_back(run.id);
  return numbers;
}

std::vector<std::int64_t> comments_of(History& history, const LearnerRow& learner) {
  std::vector<std::int64_t> numbers;
  for (const RunRow& run : history.runs(learner.id)) {
    for (const CommentRow& comment : run.comments) numbers.push_back(comment.id);
  }
  return numbers;
}

}  // namespace

std::int64_t comment_on_run(History& history, const LearnerRow& learner, std::int64_t run, const std::string& author,
                            const std::string& text) {
  require_known("run", run, learner, runs_of(history, learner));
  return history.add_comment(run, author, text);
}

void edit_comment(History& history, const LearnerRow& learner, std::int64_t comment, const std::string& text) {
  require_known("comment", comment, learner, comments_of(history, learner));
  if (!history.edit_comment(comment, text)) refuse("comment", comment, learner, comments_of(history, learner));
}

void delete_comment(History& history, const LearnerRow& learner, std::int64_t comment) {
  require_known("comment", comment, learner, comments_of(history, learner));
  history.delete_comment(comment);
}

}  // namespace gearshift::lessons
