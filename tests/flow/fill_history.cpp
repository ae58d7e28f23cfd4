// Fills a history for the flow tests. Usage: fill_history DATABASE RECORDING. All runs refer to the file RECORDING.
#include <cmath>
#include <string>

#include "app/lessons/history/history.h"

using namespace gearshift::lessons;

namespace {

ShiftRecord shift_of(int number) {
  ShiftRecord shift;
  shift.number = number;
  shift.begin = 1.05 + number;
  shift.end = shift.begin + 0.6;
  shift.from = 1 + number;
  shift.to = 2 + number;
  shift.clutch_time = 0.5;
  shift.lever_time = 0.3;
  shift.clutch_lead = 0.1;
  shift.clutch_lag = 0.1;
  shift.steps = {ShiftStep::throttle_off, ShiftStep::clutch_down, ShiftStep::neutral, ShiftStep::gear,
                 ShiftStep::clutch_up};
  return shift;
}

// The grade rises with the number n of the trial: 9 - 6 exp(-n / 3), rounded to halves.
LessonResult result_of(int trial) {
  LessonResult result;
  result.lesson = "up_through_the_gears";
  result.task = "upshift";
  result.end = LessonEnd::done;
  result.duration = 60.0;
  result.grade = 0.5 * std::round(2.0 * (9.0 - 6.0 * std::exp(-trial / 3.0)));
  result.passed = result.grade >= 6.0;
  if (!result.passed) result.why = "Grade is <below> \"6\".";
  for (int i = 0; i < 3; ++i) result.shifts.push_back(shift_of(i));
  result.errors = {make_driving_error(ErrorKind::clutch_early, Severity::minor, 2.5, 0.12, 1)};
  result.errors[0].points = 10.0 - result.grade;
  return result;
}

}  // namespace

int main(int count, char** arguments) {
  if (count != 3) return 2;
  History history(arguments[1]);
  const std::int64_t session = history.begin_session(history.find_or_add_learner("Ada <i>Löwe</i>"), "flow");
  for (int trial = 0; trial < 12; ++trial) {
    const LessonResult result = result_of(trial);
    history.end_run(history.begin_run(session, result, arguments[2]), result);
  }
  history.find_or_add_learner("Bob");
}
