#include "app/report/chosen_shifts.h"

#include <algorithm>
#include <tuple>

#include "app/report/progress.h"
#include "app/training/fault_rules.h"

namespace gearshift {
namespace {

ChosenShift with_its_faults(const RunRow& run, const ShiftRecord& shift) {
  ChosenShift chosen{run.id, run.result.lesson, run.recording, shift, {}, 0.0};
  const std::vector<DriveFault>& faults = run.result.faults;
  for (const DriveFault& fault : faults) {
    if (fault.shift == shift.number) chosen.faults.push_back(fault);
  }
  for (const Deduction& deduction : run.result.deductions) {
    if (deduction.fault < faults.size() && faults[deduction.fault].shift == shift.number)
      chosen.points += deduction.points;
  }
  return chosen;
}

bool is_bad(const ChosenShift& chosen) {
  return chosen.points > 0.0 || chosen.shift.missed || !chosen.faults.empty();
}

// By the record itself, below what the rules call a fault: what is shown as the best is looked at closely. Only a block
// has to be as long as a fault's, because every synchroniser takes its time.
bool is_clean(const ShiftRecord& shift) {
  const bool in_order = shift.steps_out_of_place == 0 && shift.clutch_lead >= 0.0 && shift.clutch_lag >= 0.0;
  const bool went_in = shift.block_time < fault_rule(FaultKind::blocked).raise && shift.grind_time == 0.0;
  return in_order && went_in && shift.wrong_columns == 0;
}

bool is_good(const ChosenShift& chosen) {
  const bool between_gears = chosen.shift.from != kNeutralGear && chosen.shift.to != kNeutralGear;
  return between_gears && !is_bad(chosen) && is_clean(chosen.shift);
}

bool is_worse(const ChosenShift& a, const ChosenShift& b) {
  const auto badness = [](const ChosenShift& c) {
    return std::tuple(c.points, c.shift.missed, c.faults.size(), c.run, c.shift.number);
  };
  return badness(a) > badness(b);
}

bool is_better(const ChosenShift& a, const ChosenShift& b) {
  return a.shift.end - a.shift.begin < b.shift.end - b.shift.begin;
}

template <class Order>
void keep_first(std::vector<ChosenShift>& shifts, Order order) {
  std::stable_sort(shifts.begin(), shifts.end(), order);
  if (shifts.size() > kMostChosen) shifts.resize(kMostChosen);
}

}  // namespace

ChosenShifts choose_shifts(const LearnerHistory& history) {
  ChosenShifts chosen;
  for (const ReportedRun& run : history.runs) {
    if (!is_graded(run.row.result)) continue;
    for (const ShiftRecord& shift : run.row.result.shifts) {
      ChosenShift one = with_its_faults(run.row, shift);
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

}  // namespace gearshift
