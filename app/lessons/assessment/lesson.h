// A lesson as described by its TOML file: start, steps, and the conditions for finishing and failing it.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "app/lessons/assessment/driving_error.h"
#include "app/lessons/assessment/norm.h"
#include "app/vehicle/car_load.h"
#include "app/vehicle/car_spec.h"
#include "haptics/files/parameter.h"
#include "haptics/gate/gate.h"

namespace gearshift::lessons {

// Met when all terms that are set have been true together for `held` seconds without a break.
struct DriveCondition {
  std::optional<int> gear;
  std::optional<bool> ignition, running, cranking, clutch_locked;
  std::optional<bool> shift_light;                   // the shift light advises a higher gear
  std::optional<bool> braked;                        // foot brake or handbrake holds the car
  std::optional<double> clutch_above, clutch_below;  // [1] pedal
  std::optional<double> clutch_torque_above;         // [N m] torque that the clutch transmits into the gearbox
  // The clutch transmits what the car needs on the lesson's slope; lesson_in_car() sets clutch_torque_above for it.
  std::optional<bool> clutch_holds_car;
  std::optional<double> throttle_above, throttle_below;      // [1]
  std::optional<double> brake_above, brake_below;            // [1]
  std::optional<double> hand_brake_above, hand_brake_below;  // [1]
  std::optional<double> engine_above, engine_below;          // [rad/s]
  std::optional<double> speed_above, speed_below;            // [m/s]
  std::optional<double> distance_above;                      // [m] distance driven forward since the lesson began
  std::optional<double> rolled_back_above;                   // [m] distance rolled back since the step began
  double held = 0.0;                                         // [s]
};

struct LessonStep {
  std::string prompt;  // for example "Press the clutch all the way down."
  std::string hint;    // shown when the step takes too long; may be empty
  DriveCondition until;
  int gear = haptics::kNeutralGear;  // gear that the guidance leads to; kNeutralGear: none
  double patience = 8.0;             // [s] time before the hint is shown
  std::optional<double> within{};    // [s] time limit; a slower step is the error slow_step
  // [s] Time after which a slow step fails the lesson, if the lesson fails on `slow_step`. At least `within`. If it is
  // empty, `within` applies.
  std::optional<double> fails_after{};
  bool call = false;            // the prompt is shown in every LessonMode, because the learner cannot know when to act
  bool may_be_skipped = false;  // prepares the next step; skipped if the next step is done first
  std::optional<double> at{};   // [m/s] road speed at which the gear of this step should be engaged
};

struct LessonAbort {
  DriveCondition when;
  std::string message;
};

struct LessonStart {
  int gear = haptics::kNeutralGear;
  double speed = 0.0;       // [m/s]
  double slope = 0.0;       // [rad] uphill is positive
  double hand_brake = 0.0;  // [1]
  double brake = 0.0;       // [1] the instructor holds the foot brake until the learner does
  bool running = true;
};
vehicle::CarStart car_start(const LessonStart& start) noexcept;  // state of the car at the start

struct Lesson {
  std::string key;  // the file's name without .toml
  std::string title;
  std::string goal;  // shown before the drive
  std::string task;  // skill that the lesson trains: "moving_off", "upshift", ...
  std::string car;   // name of the car; empty: the car that the user selected
  std::string gate;  // name of the gate; empty: the car's own gate
  LessonStart start;
  std::vector<LessonStep> steps;
  std::vector<LessonAbort> aborts;
  std::vector<ErrorKind> fails_on;          // "fails" in the file: any of these errors fails the lesson
  std::vector<ErrorKind> counted;           // "counts" in the file: these errors cost points; all others are notes
  double shift_from = 0.0, shift_to = 1e9;  // [rad/s] engine speed band for upshifts
  bool band_of_car = false;                 // use the car's band, see lesson_in_car()
  double pass_grade = 6.0;                  // [1] 0 to 10
  double time_limit = 120.0;                // [s]
  std::vector<Norm> norms;                  // of practised drivers; empty for lessons that are not shipped
  std::string text;                         // the whole file
  std::string file;                         // for messages
};

// These throw FileError with file, line, key, value and allowed range. The norms of all lessons are in one long file,
// norms/simulated.toml in the folder of the lessons; none if it is missing. Whoever reads many lessons reads it once.
std::vector<Norm> norms_beside(const std::filesystem::path& lesson);
Lesson read_lesson(const std::filesystem::path& file);                               // with its norms
Lesson read_lesson(const std::filesystem::path& file, std::span<const Norm> norms);  // of all lessons
Lesson parse_lesson(std::string_view text, const std::string& file_name);

// True if the lesson fails on this kind of error.
bool fails_on(const Lesson& lesson, ErrorKind kind) noexcept;

// True if the lesson fails on this kind of error or deducts points for it.
bool assesses(const Lesson& lesson, ErrorKind kind) noexcept;

// Tells the learner which errors fail the lesson, for example "You fail if you stall or dump the clutch." Empty if no
// error fails the lesson.
std::string failing_errors_sentence(const Lesson& lesson);

// The text with every speed in this unit: "3 to 6 km/h" becomes "2 to 4 mph". Rounded to whole numbers.
std::string text_in_unit(std::string_view text, vehicle::SpeedUnit unit);

// The lesson's norm in this mode; null if it has none.
const Norm* norm_of(const Lesson& lesson, LessonMode mode) noexcept;

// The same for a run with this car and gate; null if the norm is of another car, or of a gate with other paths.
const Norm* norm_of(const Lesson& lesson, LessonMode mode, const vehicle::CarSpec& car, const haptics::Gate& gate);

// Length of the lever's shortest path from the lesson's first gear through all gears that its steps wait for [m].
double lesson_path_length(const Lesson& lesson, const haptics::Gate& gate);

// Returns the lesson as driven in this car: with the car's upshift band, if the lesson uses the car's band, with the
// clutch torque that holds this car on the slope, where a step waits for it, and with texts in the car's unit of speed.
Lesson lesson_in_car(const Lesson& lesson, const vehicle::CarSpec& car);

}  // namespace gearshift::lessons

// Parameters of lesson files that are numbers or flags. Gears, texts and the slope are read by lesson.cpp.
namespace gearshift::haptics {

template <>
inline constexpr Parameter<lessons::DriveCondition> kParameters<lessons::DriveCondition>[] = {
    {&lessons::DriveCondition::ignition, "ignition", "ignition", FileRange{}, ""},
    {&lessons::DriveCondition::running, "running", "running", FileRange{}, ""},
    {&lessons::DriveCondition::cranking, "cranking", "cranking", FileRange{}, "The starter turns the engine."},
    {&lessons::DriveCondition::clutch_locked, "clutch_locked", "clutch_locked", FileRange{}, "Closed, no slip."},
    {&lessons::DriveCondition::shift_light, "shift_light", "shift_light", FileRange{}, "Asks for a higher gear."},
    {&lessons::DriveCondition::braked, "braked", "braked", FileRange{},
     "Foot brake above 0.05 or handbrake above 0.5."},
    {&lessons::DriveCondition::clutch_above, "clutch_above", "clutch_above", FileRange{0.0, 1.0}, "Pedal, 1 is down."},
    {&lessons::DriveCondition::clutch_below, "clutch_below", "clutch_below", FileRange{0.0, 1.0}, "Pedal, 1 is down."},
    {&lessons::DriveCondition::clutch_torque_above, "clutch_torque_above", "clutch_torque_above_nm",
     FileRange{0.0, 2000.0}, "Engine to gearbox."},
    {&lessons::DriveCondition::clutch_holds_car, "clutch_holds_car", "clutch_holds_car", FileRange{},
     "On the slope of `[start]`."},
    {&lessons::DriveCondition::throttle_above, "throttle_above", "throttle_above", FileRange{0.0, 1.0}, ""},
    {&lessons::DriveCondition::throttle_below, "throttle_below", "throttle_below", FileRange{0.0, 1.0}, ""},
    {&lessons::DriveCondition::brake_above, "brake_above", "brake_above", FileRange{0.0, 1.0}, ""},
    {&lessons::DriveCondition::brake_below, "brake_below", "brake_below", FileRange{0.0, 1.0}, ""},
    {&lessons::DriveCondition::hand_brake_above, "hand_brake_above", "hand_brake_above", FileRange{0.0, 1.0}, ""},
    {&lessons::DriveCondition::hand_brake_below, "hand_brake_below", "hand_brake_below", FileRange{0.0, 1.0}, ""},
    {&lessons::DriveCondition::engine_above, "engine_above", "engine_above_rpm",
     FileRange{0.0, 10000.0, file_unit::kRpm}, ""},
    {&lessons::DriveCondition::engine_below, "engine_below", "engine_below_rpm",
     FileRange{0.0, 10000.0, file_unit::kRpm}, ""},
    {&lessons::DriveCondition::speed_above, "speed_above", "speed_above_km_per_h",
     FileRange{-60.0, 250.0, file_unit::kKmPerHour}, "Forward +; standstill: above -0.5."},
    {&lessons::DriveCondition::speed_below, "speed_below", "speed_below_km_per_h",
     FileRange{-60.0, 250.0, file_unit::kKmPerHour}, "Forward +; standstill: below 0.5."},
    {&lessons::DriveCondition::distance_above, "distance_above", "distance_above_m", FileRange{0.0, 5000.0},
     "Driven forward since the lesson began."},
    {&lessons::DriveCondition::rolled_back_above, "rolled_back_above", "rolled_back_above_m", FileRange{0.0, 50.0},
     "Rolled back from the step's foremost position; in reverse gear: distance reversed."},
    {&lessons::DriveCondition::held, "held", "held_s", FileRange{0.0, 60.0}, "Their sum must be below `time_limit_s`."},
};
static_assert(describes_all(&lessons::DriveCondition::gear));

template <>
inline constexpr Parameter<lessons::LessonStep> kParameters<lessons::LessonStep>[] = {
    {&lessons::LessonStep::patience, "patience", "patience_s", FileRange{1.0, 60.0}, "Until the hint is shown."},
    {&lessons::LessonStep::within, "within", "within_s", FileRange{0.1, 120.0},
     "A slower step is `slow_step`; more than `held_s`."},
    {&lessons::LessonStep::fails_after, "fails_after", "fails_after_s", FileRange{0.1, 120.0},
     "A slower step fails the lesson; by default `within_s`."},
    {&lessons::LessonStep::call, "call", "call", FileRange{}, "The prompt is shown even without prompts."},
    {&lessons::LessonStep::may_be_skipped, "may_be_skipped", "may_be_skipped", FileRange{},
     "The next step's condition completes it, too."},
    {&lessons::LessonStep::at, "at", "at_km_per_h", FileRange{5.0, 150.0, file_unit::kKmPerHour},
     "Speed of the shift; only for a forward gear."},
};
static_assert(describes_all(&lessons::LessonStep::prompt, &lessons::LessonStep::hint, &lessons::LessonStep::until,
                            &lessons::LessonStep::gear));

template <>
inline constexpr Parameter<lessons::LessonStart> kParameters<lessons::LessonStart>[] = {
    {&lessons::LessonStart::speed, "speed", "speed_km_per_h", FileRange{0.0, 150.0, file_unit::kKmPerHour},
     "0 in R and with the engine off."},
    {&lessons::LessonStart::hand_brake, "hand_brake", "hand_brake", FileRange{0.0, 1.0}, "Lever, 1 is fully up."},
    {&lessons::LessonStart::brake, "brake", "brake", FileRange{0.0, 1.0}, "Held until you press the pedal as far."},
    {&lessons::LessonStart::running, "running", "running", FileRange{}, ""},
};
static_assert(describes_all(&lessons::LessonStart::gear, &lessons::LessonStart::slope));

template <>
inline constexpr Parameter<lessons::Lesson> kParameters<lessons::Lesson>[] = {
    {&lessons::Lesson::pass_grade, "pass_grade", "pass_grade", FileRange{1.0, 10.0}, "Least grade that passes, of 10."},
    {&lessons::Lesson::time_limit, "time_limit", "time_limit_s", FileRange{10.0, 1800.0}, "Of the whole lesson."},
};
static_assert(describes_all(&lessons::Lesson::key, &lessons::Lesson::title, &lessons::Lesson::goal,
                            &lessons::Lesson::task, &lessons::Lesson::car, &lessons::Lesson::gate,
                            &lessons::Lesson::start, &lessons::Lesson::steps, &lessons::Lesson::aborts,
                            &lessons::Lesson::fails_on, &lessons::Lesson::counted, &lessons::Lesson::shift_from,
                            &lessons::Lesson::shift_to, &lessons::Lesson::band_of_car, &lessons::Lesson::norms,
                            &lessons::Lesson::text, &lessons::Lesson::file));

}  // namespace gearshift::haptics
