// Everything in the history about one learner, as plain rows: the input of the HTML page and the tables.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "app/lessons/history/history.h"

namespace gearshift::lessons {

struct LearnerHistory {
  LearnerRow learner;
  std::vector<RunRow> runs;           // oldest first
  std::optional<std::int64_t> now{};  // [s] since 1970, when it was read; empty: no test is due
};

inline LearnerHistory read_learner(History& history, const LearnerRow& learner) {  // throws HistoryError
  return {learner, history.runs(learner.id), system_seconds()};
}

}  // namespace gearshift::lessons
