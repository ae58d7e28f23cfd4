// Result of a lesson run: grade, driving errors and shifts.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/lessons/assessment/driving_error.h"
#include "app/lessons/assessment/shift_record.h"
#include "haptics/files/parameter.h"

namespace gearshift::lessons {

enum class LessonMode { follow_me, by_yourself };  // follow_me prompts every step; by_yourself shows only the goal
constexpr std::string_view to_string(LessonMode mode) noexcept {
  constexpr std::string_view kNames[] = {"follow_me", "by_yourself"};
  return kNames[static_cast<std::size_t>(mode)];
}
constexpr LessonMode last_value(LessonMode) noexcept {
  return LessonMode::by_yourself;
}

enum class LessonEnd { running, done, aborted, out_of_time, left };
constexpr std::string_view to_string(LessonEnd end) noexcept {
  constexpr std::string_view kNames[] = {"running", "done", "aborted", "out_of_time", "left"};
  return kNames[static_cast<std::size_t>(end)];
}
constexpr LessonEnd last_value(LessonEnd) noexcept {
  return LessonEnd::left;
}

// How the grade was found. The history stores these values as numbers, so append new values at the end.
enum class Grading {
  old_rule,  // by errors, before there were norms: a grade above the pass grade could be a failed run's
  errors,    // by errors; the lesson has no norm for this car, gate and mode
  norm       // by errors and by the distance from practised drivers
};
constexpr std::string_view to_string(Grading grading) noexcept {
  constexpr std::string_view kNames[] = {"old_rule", "errors", "norm"};
  return kNames[static_cast<std::size_t>(grading)];
}
constexpr Grading last_value(Grading) noexcept {
  return Grading::norm;
}

// Figures of a whole run, besides LessonResult::slip_energy. Empty: the run has no such shift. norm.h compares them.
struct RunFigures {
  std::optional<double> jerk_peak;          // [m/s^3] largest jerk while not braking
  std::optional<double> rev_error;          // [rad/s] root mean square of ShiftRecord::rev_error
  std::optional<double> clutch_lead_error;  // [s] root mean square of clutch_lead minus that of practised drivers
  std::optional<double> clutch_lag_error;   // [s] the same of clutch_lag
  std::optional<double> path_efficiency;    // [1] geometric mean over the shifts
  std::optional<double> impulse;            // [N s] geometric mean over the shifts
  std::optional<double> pedal_corrections;  // [1/s] PedalCorrections::rate()
};

// A figure that norms compare. Less is better in every figure.
struct RunFigure {
  std::optional<double> RunFigures::*member;  // null: LessonResult::slip_energy
  bool of_lever;                              // what the hand did; else what the feet did
  const char* name;                           // in files of norms; of a member also its column, see RecordField
  std::string_view label;                     // for people
  std::string_view unit;
  double scale = 1.0;  // shown value per stored value
  int decimals = 0;
  double floor = 0.0;  // smaller values count as this one, because they are below what a person could tell
  std::string_view advice{};
};
inline constexpr double kMinImpulse = 0.01;  // [N s]
inline constexpr RunFigure kRunFigures[] = {
    {nullptr, false, "clutch_heat_j", "Clutch heat", " kJ", 1e-3, 2, 1.0,
     "Use less throttle while the clutch slips, and let it up once the car rolls."},
    {&RunFigures::jerk_peak, false, "jerk_peak_m_per_s3", "Largest jerk", " m/s³", 1.0, 0, 0.1,
     "Let the clutch up more slowly through the bite point."},
    {&RunFigures::rev_error, false, "rev_error_rad_per_s", "Revs off as the clutch takes hold", " rpm",
     1.0 / haptics::kTurnPerMinute, 0, 1.0,
     "Bring the engine to the speed of the new gear before the clutch takes hold."},
    {&RunFigures::clutch_lead_error, false, "clutch_lead_error_s", "Lever after clutch down, off by", " s", 1.0, 2,
     0.01, "Clutch down first, and then the lever, without a pause."},
    {&RunFigures::clutch_lag_error, false, "clutch_lag_error_s", "Clutch up after gear, off by", " s", 1.0, 2, 0.01,
     "Let the clutch up as soon as the gear is in, not before."},
    {&RunFigures::path_efficiency, true, "path_efficiency", "Lever path / shortest", "", 1.0, 2, 1.0,
     "Move the lever straight through neutral, and let its springs guide it."},
    {&RunFigures::impulse, true, "impulse_n_s", "Push per shift", " N s", 1.0, 1, kMinImpulse,
     "Push the lever lightly, and wait until the gear goes in."},
    {&RunFigures::pedal_corrections, false, "pedal_corrections_per_s", "Small pedal corrections", " %/s", 100.0, 0,
     0.01, "Rest your heel on the floor, and move each pedal in one steady stroke."},
};

constexpr void each_field(FieldsOf<RunFigures> auto&& figures, auto&& visit) {
  for (const RunFigure& figure : kRunFigures)
    if (figure.member != nullptr) visit(RecordField{figure.name}, figures.*figure.member);
}

struct LessonResult {
  std::string lesson;  // key
  std::string task;
  LessonMode mode = LessonMode::follow_me;
  LessonEnd end = LessonEnd::running;
  bool guided = false;       // one of the next two was not 0, so the run is not graded
  double lever_help = 0.0;   // [1] strongest guidance of the lever, 0 to 1
  double pedal_help = 0.0;   // [1] help with the pedals, 0 to 1, see GuidancePolicy
  bool is_complete = true;   // no samples were lost and forces were on; otherwise the run is not graded
  bool had_forces = true;    // false if the run is incomplete because the lever had no forces
  std::string car;           // name of the car's file
  double path_length = 0.0;  // [m] shortest path of the lever through the lesson's gears: tells gates apart
  double begin = 0.0;        // [s] on the haptic loop's clock
  double duration = 0.0;     // [s]
  double grade = 0.0;        // [1] 0 to 10, see grade_result(); 0 if not finished
  bool passed = false;
  std::string why;  // one sentence on why the run was not passed
  std::vector<DrivingError> errors;
  std::vector<ShiftRecord> shifts;
  double slip_energy = 0.0;  // [J] heat in the clutch during the whole lesson
  RunFigures figures;
  Grading grading = Grading::errors;
  std::optional<double> score;  // [1] distance from practised drivers, 1 is the largest that passes; empty: no norm
};

// Errors and shifts are records of their own. `why` contains the effect of `had_forces`.
constexpr void each_field(FieldsOf<LessonResult> auto&& result, auto&& visit) {
  visit(RecordField{"lesson"}, result.lesson);
  visit(RecordField{"task"}, result.task);
  visit(RecordField{"mode"}, result.mode);
  visit(RecordField{"ended"}, result.end);
  visit(RecordField{"guided"}, result.guided);
  visit(RecordField{"lever_help"}, result.lever_help);
  visit(RecordField{"pedal_help"}, result.pedal_help);
  visit(RecordField{"car"}, result.car);
  visit(RecordField{"path_length_m"}, result.path_length);
  visit(RecordField{"complete"}, result.is_complete);
  visit(RecordField{"begin_s"}, result.begin);
  visit(RecordField{"duration_s"}, result.duration);
  visit(RecordField{"grade"}, result.grade);
  visit(RecordField{"passed"}, result.passed);
  visit(RecordField{"why"}, result.why);
  visit(RecordField{"slip_energy_j"}, result.slip_energy);
  each_field(result.figures, visit);
  visit(RecordField{"graded_by"}, result.grading);
  visit(RecordField{"score"}, result.score);
}

}  // namespace gearshift::lessons
