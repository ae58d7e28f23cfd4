// Everything in the history about one learner, as plain rows: the input of the HTML page and the tables.
#pragma once

#include <vector>

#include "app/lessons/history/history.h"

namespace gearshift::lessons {

struct LearnerHistory {
  LearnerRow learner;
  std::vector<RunRow> runs;  // oldest first
};

inline LearnerHistory read_learner(History& history, const LearnerRow& learner) {  // throws HistoryError
  return {learner, history.runs(learner.id)};
}

}  // namespace gearshift::lessons
