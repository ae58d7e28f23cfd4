#include "app/lessons/report/learner_history.h"

#include <utility>

namespace gearshift::lessons {

LearnerHistory read_learner(History& history, const LearnerRow& learner) {
  LearnerHistory all{learner, {}};
  for (RunRow& run : history.runs(learner.id)) {
    std::vector<CommentRow> comments = history.comments(run.id);
    all.runs.push_back({std::move(run), std::move(comments)});
  }
  return all;
}

}  // namespace gearshift::lessons
