// All that is remembered of one learner, as plain rows: what page and tables are made from.
#pragma once

#include <vector>

#include "app/history/history.h"

namespace gearshift {

struct ReportedRun {
  RunRow row;
  std::vector<CommentRow> comments;
};

struct LearnerHistory {
  LearnerRow learner;
  std::vector<ReportedRun> runs;  // oldest first
};

LearnerHistory read_learner(History& history, const LearnerRow& learner);  // throws HistoryError

}  // namespace gearshift
