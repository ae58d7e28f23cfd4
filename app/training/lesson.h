// A lesson, as a TOML file says it: where it begins, what to do step by step, when it is done and when it is lost.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/training/drive_fault.h"
#include "app/vehicle/car_spec.h"
#include "haptics/gate/gate.h"

namespace gearshift {

// All that is named must hold at once, for `held` seconds on end.
struct DriveCondition {
  std::optional<int> gear;
  std::optional<bool> ignition, running, clutch_locked;
  std::optional<bool> shift_light;                           // it asks for a higher gear
  std::optional<bool> braked;                                // foot or hand brake holds the car
  std::optional<double> clutch_above, clutch_below;          // [1] pedal
  std::optional<double> clutch_torque_above;                 // [N m] that it carries into the gearbox
  std::optional<double> throttle_above, throttle_below;      // [1]
  std::optional<double> brake_above, brake_below;            // [1]
  std::optional<double> hand_brake_above, hand_brake_below;  // [1]
  std::optional<double> engine_above, engine_below;          // [rad/s]
  std::optional<double> speed_above, speed_below;            // [m/s]
  std::optional<double> distance_above;                      // [m] since the lesson began, forward
  std::optional<double> rolled_back_above;                   // [m] since the step began
  double held = 0.0;                                         // [s]
};

struct LessonStep {
  std::string prompt;  // "Press the clutch all the way down."
  std::string hint;    // what is said when it takes too long; may be empty
  DriveCondition until;
  int gear = kNeutralGear;              // where the guidance leads; kNeutralGear: nowhere
  double patience = 8.0;                // [s] before the hint
  std::optional<double> within{};       // [s] longer is slow_step
  std::optional<double> fails_after{};  // [s] longer fails the lesson that catches slow_step; >= within; none: within
  bool call = false;                    // prompted in both modes: nobody can know by himself when to do it
  bool may_be_skipped = false;          // it prepares the next one and is done with it
  std::optional<double> at{};           // [m/s] road speed at which the gear that it waits for is to go in
};

struct LessonAbort {
  DriveCondition when;
  std::string says;
};

struct LessonStart {
  int gear = kNeutralGear;
  double speed = 0.0;       // [m/s]
  double slope = 0.0;       // [rad] uphill +
  double hand_brake = 0.0;  // [1]
  bool running = true;
};

struct Lesson {
  std::string key;  // the file's name without .toml
  std::string title;
  std::string goal;  // said first
  std::string task;  // what its grade counts for: "moving_off", "upshift", ...
  std::string car;   // empty: the one that is chosen
  std::string gate;  // empty: the car's
  LessonStart start;
  std::vector<LessonStep> steps;
  std::vector<LessonAbort> aborts;
  std::vector<FaultKind> catches;           // "fails": it claims to catch these; one of them and it is not passed
  std::vector<FaultKind> counts;            // "counts": they cost points; what is in neither list is a note
  double shift_from = 0.0, shift_to = 1e9;  // [rad/s] band of engine speed for an upshift
  bool band_of_car = false;                 // that band is the car's: lesson_in_car
  double pass_grade = 6.0;                  // [1] of 10
  double time_limit = 120.0;                // [s]
  std::string text;                         // the whole file as read
  std::string file;                         // for messages
};

// Throws FileError with file, line, key, value and allowed range.
Lesson read_lesson(const std::filesystem::path& file);
Lesson parse_lesson(std::string_view text, const std::string& file_name);

// The lesson claims to catch that kind: a drive in which it was done is not passed.
bool catches(const Lesson& lesson, FaultKind kind) noexcept;

// It looks at that kind: catches it, or counts it.
bool looks_at(const Lesson& lesson, FaultKind kind) noexcept;

// What it claims to catch, for who is about to drive it: "Not passed with: a stall, a dumped clutch." Empty where it
// catches nothing.
std::string catches_sentence(const Lesson& lesson);

// The lesson as it is driven in that car: with its band for the upshifts, where the lesson leaves it to the car.
Lesson lesson_in_car(const Lesson& lesson, const CarSpec& car);

}  // namespace gearshift
