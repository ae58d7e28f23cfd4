// Everything in the history about one learner, as plain rows: the input of the HTML page and the tables.
#pragma once

#include <vector>

#include "app/lessons/history/history.h"

namespace gearshift::lessons {

struct ReportedRun {
  RunRow row;
  std::vector<CommentRow> comments;
};

struct LearnerHistory {
  LearnerRow learner;
  std::vector<ReportedRun> runs;  // oldest first
};

LearnerHistory read_learner(History& history, const LearnerRow& learner);  // throws HistoryError

}  // namespace gearshift::lessons
