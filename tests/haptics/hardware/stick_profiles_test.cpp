// Sticks that people own, as far as their firmware is known: calibrated from the start by a person who leaves out what
// is refused, then driven through a gate. The forces that the program believes are compared with those that the stick
// makes. Profiles come from firmware sources; habits are also tried alone and in random pairs.
#include "tests/support/stick/stick_profiles.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "haptics/loop/shift_script.h"
#include "tests/haptics/hardware/calibration_bench.h"
#include "tests/haptics/hardware/stick_loop.h"
#include "tests/support/whole_campaign.h"

using namespace gearshift::haptics;
using namespace gearshift::test;
using glm::dvec2;

namespace {

constexpr double kMaxRms = 0.5;         // [N] of 20 N, where the stick can do it
constexpr double kMaxDialogue = 300.0;  // [s] of all measurements without a hand

struct Calibrated {
  DeviceCalibration found;
  std::string refusal;   // why the stick cannot be used; empty: it can
  std::string left_out;  // all that is refused
  std::string heard;     // all that the dialogue says about the forces
  double seconds = 0.0;  // [s] of all measurements without a hand
};

void append(std::string& all, const std::string& sentence) {
  if (!sentence.empty()) all += (all.empty() ? "" : "; ") + sentence;
}

Calibrated calibrate_stick(const EmulatedStickConfig& config) {
  Calibrated result;
  CalibrationBench bench(config);
  Calibrator& calibrator = bench.calibrator;
  try {
    bench.find_axes();
    bench.measure_all_stops();
  } catch (const CalibrationRefused& refused) {  // the reports end before Y
    result.refusal = result.left_out = result.heard = refused.what();
    CHECK(bench.problems().size() == 1);
    return result;
  }
  calibrator.set_numbers(0.14, 0.14, 20.0);
  bench.hands_off();
  const double begin = bench.time();
  // Like the user of the dialogue, who tries twice.
  const auto measure = [&](auto step) -> std::string {
    std::string refusal;
    for (int tries = 0; tries < 2; ++tries) {
      try {
        append(result.heard, std::invoke(step, calibrator));
        return "";
      } catch (const CalibrationRefused& refused) {
        refusal = refused.what();
      }
    }
    append(result.heard, refusal);
    append(result.left_out, refusal);
    return refusal;
  };
  for (const auto step : {&Calibrator::measure_polarity, &Calibrator::measure_timing})
    if (result.refusal.empty()) result.refusal = measure(step);
  if (result.refusal.empty()) {
    measure(&Calibrator::measure_strength);
    measure(&Calibrator::measure_handle);
    if (bench.ability.spring) measure(&Calibrator::measure_springs);
    const std::string& refused = calibrator.calibration().springs_refused;
    if (!refused.empty()) CHECK(result.heard.find(refused + ", so springs are not used") != std::string::npos);
    append(result.left_out, refused);
    append(result.left_out, calibrator.calibration().dampers_refused);
  }
  result.seconds = bench.time() - begin;
  result.found = calibrator.calibration();
  result.found.press_button = 1;
  result.found.lift_button = 2;
  return result;
}

struct Driven {
  std::size_t gears = 0;
  double rms = 0.0, worst = 0.0;  // [N] force believed minus force made
  double wrong = 0.0;             // [s] forces of at least 1 N in opposite directions
  double silent = 0.0;            // [s] longest time without a force although at least 1 N was believed
  std::vector<std::string> problems;
};

Driven drive_through_gate(const EmulatedStickConfig& bare, const DeviceCalibration& known) {
  EmulatedStickConfig config = bare;
  config.lever.hand = kGripHand;
  const Gate gate = stick_gate("six_speed_r_left_up", config);
  const dvec2 start = rest_position(gate, kNeutralGear);
  ScriptedHandConfig script = touring_hand(start);
  // [N] a gentle hand, because the stick has only 20 N, or less
  script.effort_limit = std::min(8.0, 0.4 * spec_of(known, 0.001).max_force.x);
  ScriptedHand hand(script, shift_strokes(gate, start, tour_order(gate)), config.plant_period);
  StickLoop run(config, known, {}, gate, hand);
  run.stick.logs = false;
  run.loop.arm();
  Driven result;
  double sum = 0.0, silence = 0.0;
  long count = 0;
  for (; run.time() < hand.duration(); ++count) {
    run.cycle();
    const dvec2 made = run.stick.force(), believed = -run.loop.snapshot().f_a;
    const double error = glm::length(believed - made);
    sum += error * error;
    result.worst = std::max(result.worst, error);
    if (glm::dot(made, believed) < -1.0) result.wrong += 0.001;
    silence = glm::length(believed) > 1.0 && glm::length(made) == 0.0 ? silence + 0.001 : 0.0;
    result.silent = std::max(result.silent, silence);
  }
  result.rms = std::sqrt(sum / static_cast<double>(count));
  result.gears = run.gears().size();
  result.problems = run.problems();
  return result;
}

// Returns the calibration that a program would assume if it believed the descriptor.
DeviceCalibration believed_calibration(const EmulatedStickConfig& config, const DeviceCalibration& found) {
  DeviceCalibration known = calibration_of(config);
  for (const bool select : {true, false}) {
    LeverAxisCalibration& axis = select ? known.select : known.shift;
    const LeverAxisCalibration& measured = select ? found.select : found.shift;
    axis.low = measured.low;
    axis.centre = measured.centre;
    axis.high = measured.high;
  }
  known.press_button = 1;
  known.lift_button = 2;
  return known;
}

struct Habit {
  const char* name;
  std::function<void(StickHabits&)> give;
  const char* refusal = "";  // beginning of the sentence if the stick cannot be used
};
constexpr const char* kOneMotor = "the stick has a motor for select, but none for shift";

const std::vector<Habit>& habits() {
  static const std::vector<Habit> all{
      {"constants by the first angle", [](StickHabits& h) { h.constant = ConstantLaw::first_angle; }},
      {"constants by axes byte 4", [](StickHabits& h) { h.constant = ConstantLaw::equal_to_4; }},
      {"constants on X only", [](StickHabits& h) { h.constant = ConstantLaw::x_only; }, kOneMotor},
      {"constants rotate their sum", [](StickHabits& h) { h.constant = ConstantLaw::rotates_sum; },
       "the stick renders one force at a time"},
      {"constants need axis bits", [](StickHabits& h) { h.constant = ConstantLaw::no_bit_alone; }},
      {"conditions of the board", [](StickHabits& h) { h.condition = ConditionLaw::board; }},
      {"conditions are counted", [](StickHabits& h) { h.condition = ConditionLaw::counted; }},
      {"conditions by axes byte 4", [](StickHabits& h) { h.condition = ConditionLaw::exactly_4; }},
      {"conditions on X only", [](StickHabits& h) { h.condition = ConditionLaw::x_only; }},
      {"conditions along the direction", [](StickHabits& h) { h.condition = ConditionLaw::along_direction; }},
      {"conditions times the direction", [](StickHabits& h) { h.condition = ConditionLaw::times_direction; }},
      {"conditions on both axes", [](StickHabits& h) { h.condition = ConditionLaw::both_axes; }},
      {"no conditions", [](StickHabits& h) { h.condition = ConditionLaw::never; }},
      {"dead band ignored", [](StickHabits& h) { h.dead_band = DeadBandLaw::ignored; }},
      {"dead band in counts", [](StickHabits& h) { h.dead_band = DeadBandLaw::raw_counts; }},
      {"dead band narrow", [](StickHabits& h) { h.dead_band = DeadBandLaw::narrow; }},
      {"dead band wide", [](StickHabits& h) { h.dead_band = DeadBandLaw::wide; }},
      {"one spring at a time", [](StickHabits& h) { h.condition = ConditionLaw::last_set; }},
      {"dead band shifts the centre", [](StickHabits& h) { h.dead_band = DeadBandLaw::shifts_centre; }},
      {"auto-centre after reset", [](StickHabits& h) { h.auto_centre = AutoCentre::after_reset; }},
      {"auto-centre always", [](StickHabits& h) { h.auto_centre = AutoCentre::always; }},
      {"auto-centre while on", [](StickHabits& h) { h.auto_centre = AutoCentre::while_on; }},
      {"auto-centre when off", [](StickHabits& h) { h.auto_centre = AutoCentre::when_off; }},
      {"drops the sign", [](StickHabits& h) { h.drops_sign = true; }},
      {"constants ignore gain", [](StickHabits& h) { h.constant_ignores_gain = true; }},
      {"ignores device gain", [](StickHabits& h) { h.ignores_device_gain = true; }},
      {"one motor", [](StickHabits& h) { h.motors = 1; }, kOneMotor},
      {"trigger none is FFh", [](StickHabits& h) { h.trigger_none_is_ff = true; }},
      {"one effect at a time", [](StickHabits& h) { h.one_effect = true; }, "the stick renders one force at a time"},
      {"silence after each start", [](StickHabits& h) { h.restart_gap = 0.001; }},
      {"stopped blocks are free", [](StickHabits& h) { h.stopped_is_free = true; }},
      {"mute until stop-all", [](StickHabits& h) { h.mute_until_stop_all = true; }},
      {"off until enabled", [](StickHabits& h) { h.off_until_enabled = true; }},
      {"ignores actuators", [](StickHabits& h) { h.ignores_actuators = true; }},
      {"stop-all erases", [](StickHabits& h) { h.stop_all_erases = true; }},
      {"ignores stop-all", [](StickHabits& h) { h.ignores_stop_all = true; }},
      {"tests bits of controls", [](StickHabits& h) { h.control_tests_bits = true; }},
      {"answers late", [](StickHabits& h) { h.late_loads = 20; }},
      {"short features", [](StickHabits& h) { h.short_features = 1; }},
      {"answers once", [](StickHabits& h) { h.load_answers_once = true; }},
      {"first create fails", [](StickHabits& h) { h.first_create_fails = true; }},
      {"pool said to be the driver's", [](StickHabits& h) { h.pool_by_driver_flag = true; }},
      {"reading the pool frees all", [](StickHabits& h) { h.pool_read_frees_all = true; }},
      {"reports no state", [](StickHabits& h) { h.state_sent = StateSent::never; }},
      {"reports its state at settings", [](StickHabits& h) { h.state_sent = StateSent::at_setting; }},
      {"says no safety switch", [](StickHabits& h) { h.says_no_safety_switch = true; }},
      {"says no power", [](StickHabits& h) { h.says_no_power = true; }},
      {"says no actuators", [](StickHabits& h) { h.says_no_actuators = true; }},
      {"longer reports", [](StickHabits& h) { h.longer_input = 3; }},
      {"shorter reports", [](StickHabits& h) { h.longer_input = -1; }},
  };
  return all;
}

// Calibrates and drives a stick. Fails if the dialogue does not end, if a force has the wrong sign, or if the stick is
// silent or makes other forces without a sentence.
void check_stick(const EmulatedStickConfig& config, const std::string& name, const Habit* alone = nullptr) {
  CAPTURE(name);
  const Calibrated calibrated = calibrate_stick(config);
  CHECK(calibrated.seconds < kMaxDialogue);
  if (alone != nullptr) {
    CHECK_MESSAGE(calibrated.refusal.starts_with(alone->refusal), name, ": ", calibrated.refusal);
    CHECK_MESSAGE(calibrated.refusal.empty() == std::string(alone->refusal).empty(), name, ": ", calibrated.refusal);
  }
  if (!calibrated.refusal.empty()) return;
  const Driven driven = drive_through_gate(config, calibrated.found);
  const DeviceCalibration& found = calibrated.found;
  const bool has_gap = found.timing.restart_gap > 0.0, has_own_spring = found.select.own_spring > 0.0;
  const bool has_sentence = !calibrated.left_out.empty() || !driven.problems.empty() || has_gap || has_own_spring;
  CHECK(has_gap == (config.habits.restart_gap > 0.0));
  CHECK(has_own_spring == (config.habits.auto_centre == AutoCentre::while_on));
  CHECK(driven.gears == 7);
  if (has_own_spring || config.habits.auto_centre == AutoCentre::always) {  // a force that nothing can switch off
    CHECK(has_sentence);
    return;
  }
  CHECK_MESSAGE(driven.wrong < 0.05, name, ": wrong for ", driven.wrong, " s, ", calibrated.left_out);
  CHECK_MESSAGE((driven.silent < 0.05 || has_sentence), name, ": silent for ", driven.silent, " s");
  CHECK_MESSAGE((driven.rms < kMaxRms || has_sentence), name, ": rms ", driven.rms, " N");
  CHECK_MESSAGE(driven.rms < 2.0 * kMaxRms, name, ": rms ", driven.rms, " N, ", calibrated.left_out);
}

}  // namespace

TEST_CASE("each profile: calibration, gears, force error, and what is not used") {
  struct Expected {
    const char *name, *refusal, *springs;  // beginnings of sentences; "": none
  };
  constexpr const char* kNoBand = "the stick's springs have no dead band";
  constexpr const char* kWrongBand = "the stick's springs do not keep their dead band";
  const std::vector<Expected> expected{
      {"PID 1.0", "", ""},
      {"SideWinder FF2", "", ""},
      {"OpenFFBoard", "", ""},
      {"OpenFFBoard, 32-bit", "", ""},
      {"OpenFFBoard, one motor", kOneMotor, ""},
      {"Arduino library", "", kWrongBand},
      {"Arduino library, hat", "", kWrongBand},
      {"Fino", "", kWrongBand},
      {"adapt-ffb-joy 0.5", "", kNoBand},
      {"adapt-ffb-joy 0.4", "", kNoBand},
      {"adapt-ffb-joy 0.4, fixed", "the stick does not change a force while it acts", ""},
      {"SunFFB", "", ""},
      {"AFFBWheel", kOneMotor, ""},
      {"Arduino-FFB-wheel, one motor", kOneMotor, ""},
      {"Arduino-FFB-wheel, two motors", "the stick renders one force at a time", ""},
      {"STM32_FFBJoystick", "", "the stick's springs push inside their dead band"},
      {"Cyborg Evo Force", "", ""},
      {"vJoy", "", ""},
  };
  REQUIRE(expected.size() == stick_profiles().size());
  std::string table = "profile | calibrated in s | gears | rms N | worst N | believed: rms N | sentences\n";
  for (std::size_t i = 0; i < expected.size(); ++i) {
    const StickProfile& profile = stick_profiles()[i];
    CAPTURE(i);
    CHECK(std::string(profile.name) == expected[i].name);
    const EmulatedStickConfig config = config_of(profile);
    const Calibrated calibrated = calibrate_stick(config);
    CHECK(calibrated.refusal.starts_with(expected[i].refusal));
    CHECK(calibrated.refusal.empty() == std::string(expected[i].refusal).empty());
    CHECK(calibrated.found.springs_refused.starts_with(expected[i].springs));
    CHECK(calibrated.found.springs_refused.empty() == std::string(expected[i].springs).empty());
    CHECK(calibrated.seconds < kMaxDialogue);
    table += std::string(profile.name) + " | " + std::to_string(calibrated.seconds) + " | ";
    if (!calibrated.refusal.empty()) {
      table += "- | - | - | - | " + calibrated.left_out + '\n';
      continue;
    }
    const Driven driven = drive_through_gate(config, calibrated.found);
    const Driven believing = drive_through_gate(config, believed_calibration(config, calibrated.found));
    table += std::to_string(driven.gears) + " | " + std::to_string(driven.rms) + " | " + std::to_string(driven.worst) +
             " | " + std::to_string(believing.rms) + " | " + calibrated.left_out + '\n';
    CHECK(driven.gears == 7);
    CHECK(driven.rms < kMaxRms);
    CHECK(driven.wrong == 0.0);
    CHECK(driven.problems.empty());
    // Negative control: where something is not used, believing it would be felt.
    if (*expected[i].springs != '\0') CHECK(believing.rms > 2.0 * kMaxRms);
  }
  MESSAGE(table);
}

TEST_CASE("every habit alone: the dialogue ends, no force has the wrong sign, no silence without a sentence") {
  for (const Habit& habit : habits()) {
    EmulatedStickConfig config;
    habit.give(config.habits);
    check_stick(config, habit.name, &habit);
  }
}

TEST_CASE("random pairs of habits on any family") {
  constexpr StickFamily kFamilies[] = {StickFamily::sidewinder, StickFamily::openffboard, StickFamily::vjoy,
                                       StickFamily::arduino, StickFamily::sunffb};
  std::mt19937 chance(35);
  for (int pair = 0; pair < (is_full_campaign() ? 200 : 20); ++pair) {
    EmulatedStickConfig config;
    config.family = kFamilies[chance() % std::size(kFamilies)];
    const Habit &first = habits()[chance() % habits().size()], &second = habits()[chance() % habits().size()];
    first.give(config.habits);
    second.give(config.habits);
    check_stick(config, std::string(to_string(config.family)) + ", " + first.name + ", " + second.name);
  }
}
