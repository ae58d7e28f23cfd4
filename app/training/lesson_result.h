// What is left of a lesson that was driven: grade, faults, shifts.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "app/training/drive_fault.h"
#include "app/training/shift_record.h"

namespace gearshift {

enum class LessonMode { follow_me, by_yourself };  // each step prompted; only the goal
enum class LessonEnd { running, done, aborted, out_of_time, left };

// Points taken off, and for what.
struct Deduction {
  std::size_t fault = 0;  // of LessonResult::faults
  double points = 0.0;    // [1] of 10
};

struct LessonResult {
  std::string lesson;  // key
  std::string task;
  LessonMode mode = LessonMode::follow_me;
  LessonEnd end = LessonEnd::running;
  bool guided = false;     // a guidance force was on: there is no grade
  bool whole = true;       // nothing of the drive was lost, no sample and no force; else there is no grade
  bool had_forces = true;  // where that is why it is not whole: false
  double begin = 0.0;      // [s] on the loop's clock
  double duration = 0.0;   // [s]
  double grade = 0.0;      // [1] 0 to 10; 10 less the deductions; 0 where it was not done
  bool passed = false;
  std::string why;  // it was not passed: one sentence
  std::vector<DriveFault> faults;
  std::vector<ShiftRecord> shifts;
  std::vector<Deduction> deductions;
  double slip_energy = 0.0;  // [J] of the whole lesson
  double fuel = 0.0;         // [J] of work by the engine, braking by it taken off
};

}  // namespace gearshift
