#include "app/report/learner_history.h"

#include <utility>

namespace gearshift {

LearnerHistory read_learner(History& history, const LearnerRow& learner) {
  LearnerHistory all{learner, {}};
  for (RunRow& run : history.runs(learner.id)) {
    std::vector<CommentRow> comments = history.comments(run.id);
    all.runs.push_back({std::move(run), std::move(comments)});
  }
  return all;
}

}  // namespace gearshift
