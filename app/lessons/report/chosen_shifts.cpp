#include "app/lessons/report/chosen_shifts.h"

#include <algorithm>
#include <tuple>

#include "app/lessons/assessment/driving_error.h"
#include "app/lessons/report/progress.h"

namespace gearshift::lessons {
namespace {

ChosenShift with_its_errors(const RunRow& run, const ShiftRecord& shift) {
  ChosenShift chosen{run.id, run.result.lesson, run.recording, shift, {}, 0.0};
  for (const DrivingError& error : run.result.errors) {
    if (error.shift != shift.number) continue;
    chosen.errors.push_back(error);
    chosen.points += error.points;
  }
  return chosen;
}

bool is_bad(const ChosenShift& chosen) {
  return chosen.points > 0.0 || chosen.shift.missed || !chosen.errors.empty();
}

// True for a shift without a flaw. Stricter than the error rules, because readers examine the best shifts closely.
// Blocking is the exception: it is allowed up to its error threshold, because every synchroniser takes some time.
bool is_clean(const ShiftRecord& shift) {
  const bool in_order = shift.steps_out_of_place == 0 && shift.clutch_lead >= 0.0 && shift.clutch_lag >= 0.0;
  const bool went_in = shift.block_time < error_rule(ErrorKind::blocked).raise && shift.grind_time == 0.0;
  return in_order && went_in && shift.wrong_columns == 0;
}

bool is_good(const ChosenShift& chosen) {
  const bool between_gears = chosen.shift.from != haptics::kNeutralGear && chosen.shift.to != haptics::kNeutralGear;
  return between_gears && !is_bad(chosen) && is_clean(chosen.shift);
}

bool is_worse(const ChosenShift& a, const ChosenShift& b) {
  const auto badness = [](const ChosenShift& c) {
    return std::tuple(c.points, c.shift.missed, c.errors.size(), c.run, c.shift.number);
  };
  return badness(a) > badness(b);
}

bool is_better(const ChosenShift& a, const ChosenShift& b) {
  return a.shift.end - a.shift.begin < b.shift.end - b.shift.begin;
}

template <class Order>
void keep_first(std::vector<ChosenShift>& shifts, Order order) {
  std::stable_sort(shifts.begin(), shifts.end(), order);
  if (shifts.size() > kMaxChosenShifts) shifts.resize(kMaxChosenShifts);
}

}  // namespace

ChosenShifts choose_shifts(const LearnerHistory& history) {
  ChosenShifts chosen;
  for (const RunRow& run : history.runs) {
    if (!is_graded(run.result)) continue;
    for (const ShiftRecord& shift : run.result.shifts) {
      ChosenShift one = with_its_errors(run, shift);
      if (is_bad(one))
        chosen.worst.push_back(std::move(one));
      else if (is_good(one))
        chosen.best.push_back(std::move(one));
    }
  }
  keep_first(chosen.worst, is_worse);
  keep_first(chosen.best, is_better);
  return chosen;
}

}  // namespace gearshift::lessons
