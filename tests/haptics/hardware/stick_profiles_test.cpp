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

Calibrated calibrate_stick(const EmulatedStickConfig& config, bool is_swapped = false) {
  Calibrated result;
  CalibrationBench bench(config);
  Calibrator& calibrator = bench.calibrator;
  try {
    bench.find_axes(is_swapped);
    bench.measure_all_stops();
  } catch (const CalibrationRefused& refused) {  // the reports end before Y
    result.refusal = result.left_out = result.heard = refused.what();
    CHECK(bench.problems().size() == 1);
    return result;
  }
  calibrator.set_numbers(dvec2(0.14), dvec2(20.0));
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
  if (calibrator.calibration().select_by_position)
    append(result.left_out, result.heard.substr(0, result.heard.find("; a reading")));
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
  result.found.buttons.press = 1;
  result.found.buttons.lift = 2;
  return result;
}

dvec2 swapped(dvec2 v) {
  return {v.y, v.x};
}

// The lever's right is the stick's forward, and the other way round: a hand that is told of the gate moves the stick.
class SwappedHand final : public HandDriver {
 public:
  explicit SwappedHand(HandDriver& hand) : hand_(hand) {}
  HandTarget next(double time, dvec2 lever) noexcept override {
    HandTarget target = hand_.next(time, swapped(lever));
    for (dvec2* vector : {&target.position, &target.velocity, &target.push}) *vector = swapped(*vector);
    return target;
  }

 private:
  HandDriver& hand_;
};

struct Driven {
  std::size_t gears = 0;
  std::vector<int> order;         // the engaged gears
  double rms = 0.0, worst = 0.0;  // [N] force believed minus force made, which may be late by the stick's delay
  double wrong = 0.0;             // [s] forces of at least 1 N in opposite directions
  double silent = 0.0;            // [s] longest time without a force although at least 1 N was believed
  std::vector<std::string> problems;
};

Driven drive_through(const Gate& gate, const EmulatedStickConfig& bare, const DeviceCalibration& known,
                     bool is_swapped = false) {
  EmulatedStickConfig config = bare;
  config.lever.hand = kGripHand;
  const dvec2 start = rest_position(gate, kNeutralGear);
  ScriptedHandConfig script = touring_hand(start);
  // [N] a gentle hand, because the stick has only 20 N, or less
  script.effort_limit = std::min(8.0, 0.4 * spec_of(known, 0.001).max_force.y);
  ScriptedHand hand(script, shift_strokes(gate, start, tour_order(gate)), config.plant_period);
  SwappedHand other_hand(hand);
  StickLoop run(config, known, {}, gate, is_swapped ? static_cast<HandDriver&>(other_hand) : hand);
  run.stick.logs = false;
  run.loop.arm();
  Driven result;
  double sum = 0.0, silence = 0.0;
  long count = 0;
  std::vector<dvec2> late(static_cast<std::size_t>(std::lround(1e3 * config.delay)) + 1, dvec2(0.0));  // a ring
  for (; run.time() < hand.duration(); ++count) {
    run.cycle();
    const auto now = static_cast<std::size_t>(count);
    late[now % late.size()] = -run.loop.snapshot().f_a;
    const dvec2 made = is_swapped ? swapped(run.stick.force()) : run.stick.force();
    const dvec2 believed = late[(now + 1) % late.size()];
    const double error = glm::length(believed - made);
    sum += error * error;
    result.worst = std::max(result.worst, error);
    if (glm::dot(made, believed) < -1.0) result.wrong += 0.001;
    silence = glm::length(believed) > 1.0 && glm::length(made) == 0.0 ? silence + 0.001 : 0.0;
    result.silent = std::max(result.silent, silence);
  }
  result.rms = std::sqrt(sum / static_cast<double>(count));
  result.order = run.gears();
  result.gears = result.order.size();
  result.problems = run.problems();
  return result;
}

Driven drive_through_gate(const EmulatedStickConfig& config, const DeviceCalibration& known, bool is_swapped = false) {
  return drive_through(stick_gate("six_speed_r_left_up", config), config, known, is_swapped);
}

// A lever that moves forward and back only.
Gate straight_gate(const EmulatedStickConfig& config) {
  return compile_gate(parse_gate_layout("name = \"Straight\"\n[gate]\n[feel]\n[[column]]\nposition_mm = 0\n"
                                        "forward = \"1\"\nback = \"2\"\nneutral = true\n",
                                        "straight.toml"),
                      dvec2(config.half_travel));
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
  known.buttons.press = 1;
  known.buttons.lift = 2;
  return known;
}

struct Habit {
  const char* name;
  std::function<void(EmulatedStickConfig&)> give;
  // Words with which dialogue or driver name what the habit breaks; "": nothing is felt, and nothing left out
  const char* words = "";
  const char* elsewhere = "";  // the same beside other habits or on other families
};
constexpr const char* kOneMotor = "the stick has a motor for select, but none for shift";
constexpr const char* kOneForce = "the stick renders one force at a time";

const std::vector<Habit>& habits() {
  using Config = EmulatedStickConfig;
  static const std::vector<Habit> all{
      {"constants by the first angle", [](Config& c) { c.habits.constant = ConstantLaw::first_angle; }},
      {"constants by axes byte 4", [](Config& c) { c.habits.constant = ConstantLaw::equal_to_4; }},
      {"constants on X only", [](Config& c) { c.habits.constant = ConstantLaw::x_only; }, kOneMotor},
      {"constants rotate their sum", [](Config& c) { c.habits.constant = ConstantLaw::rotates_sum; }, kOneForce},
      {"constants need axis bits", [](Config& c) { c.habits.constant = ConstantLaw::no_bit_alone; }},
      {"constants keep their sign", [](Config& c) { c.habits.constant_update = ConstantUpdate::strength; }},
      {"constants keep all", [](Config& c) { c.habits.constant_update = ConstantUpdate::nothing; },
       "the stick does not change a force while it acts"},
      {"constants jump at half force", [](Config& c) { c.habits.jumps_at_half = true; },
       "so only magnitudes up to 50 % are used"},
      {"constants inverted on X", [](Config& c) { c.constant_sign.x = -1; }},
      {"constants inverted on Y", [](Config& c) { c.constant_sign.y = -1; }},
      {"springs inverted on X", [](Config& c) { c.spring_sign.x = -1; }},
      {"springs inverted on Y", [](Config& c) { c.spring_sign.y = -1; }},
      {"dampers inverted on X", [](Config& c) { c.damper_sign.x = -1; }},
      {"dampers inverted on Y", [](Config& c) { c.damper_sign.y = -1; }},
      {"constants cross the axes", [](Config& c) { c.habits.cross_talk.constant = 0.3; }, "which is cancelled",
       "a force along select also acts along shift"},
      {"springs cross the axes", [](Config& c) { c.habits.cross_talk.spring = 0.3; },
       "a spring along select also acts along shift"},
      {"dampers cross the axes", [](Config& c) { c.habits.cross_talk.damper = 0.3; },
       "a damper along select also acts along shift"},
      {"conditions of the board", [](Config& c) { c.habits.condition = ConditionLaw::board; }, "",
       "a spring along select also acts along shift"},
      {"conditions are counted", [](Config& c) { c.habits.condition = ConditionLaw::counted; }},
      {"conditions by axes byte 4", [](Config& c) { c.habits.condition = ConditionLaw::exactly_4; }},
      {"conditions on X only", [](Config& c) { c.habits.condition = ConditionLaw::x_only; }, "springs do not move"},
      {"conditions along the direction", [](Config& c) { c.habits.condition = ConditionLaw::along_direction; }},
      {"conditions times the direction", [](Config& c) { c.habits.condition = ConditionLaw::times_direction; }},
      {"conditions always times the direction", [](Config& c) { c.habits.condition = ConditionLaw::direction_scales; },
       "springs do not move the lever"},
      {"conditions on both axes", [](Config& c) { c.habits.condition = ConditionLaw::both_axes; }},
      {"no conditions", [](Config& c) { c.habits.condition = ConditionLaw::never; }, "springs do not move the lever"},
      {"one spring at a time", [](Config& c) { c.habits.condition = ConditionLaw::last_set; },
       "the springs of both axes at the same time"},
      {"dead band ignored", [](Config& c) { c.habits.dead_band = DeadBandLaw::ignored; }, "inside their dead band"},
      {"dead band in counts", [](Config& c) { c.habits.dead_band = DeadBandLaw::raw_counts; }, "keep their dead band"},
      {"dead band narrow", [](Config& c) { c.habits.dead_band = DeadBandLaw::narrow; }},
      {"dead band wide", [](Config& c) { c.habits.dead_band = DeadBandLaw::wide; }},
      {"dead band shifts the centre", [](Config& c) { c.habits.dead_band = DeadBandLaw::shifts_centre; },
       "inside their dead band"},
      {"saturation ignored", [](Config& c) { c.habits.ignores_saturation = true; }},
      {"dampers do nothing", [](Config& c) { c.habits.damper = DamperLaw::nothing; }, "dampers do not brake"},
      {"dampers are full", [](Config& c) { c.habits.damper = DamperLaw::full; }, "damper"},
      {"dampers are springs", [](Config& c) { c.habits.damper = DamperLaw::is_spring; }, "the stick's dampers"},
      {"auto-centre after reset", [](Config& c) { c.habits.auto_centre = AutoCentre::after_reset; }},
      {"auto-centre always", [](Config& c) { c.habits.auto_centre = AutoCentre::always; }, "too stiff for the motors"},
      {"auto-centre without a spring", [](Config& c) { c.habits.auto_centre = AutoCentre::until_spring; }, "",
       "make the stick's own centring weaker"},
      {"auto-centre while on", [](Config& c) { c.habits.auto_centre = AutoCentre::while_on; },
       "pulls to its centre by itself"},
      {"auto-centre when off", [](Config& c) { c.habits.auto_centre = AutoCentre::when_off; }},
      {"drops the sign", [](Config& c) { c.habits.drops_sign = true; }},
      {"constants ignore gain", [](Config& c) { c.habits.constant_ignores_gain = true; }},
      {"ignores device gain", [](Config& c) { c.habits.ignores_device_gain = true; }},
      {"one motor", [](Config& c) { c.habits.motors = 1; }, kOneMotor},
      {"one motor, for shift", [](Config& c) { c.habits.only_y_pushes = true; },
       "the stick has a motor for shift, but none for select, so only forces along shift are used"},
      {"trigger none is FFh", [](Config& c) { c.habits.trigger_none_is_ff = true; }},
      {"one effect at a time", [](Config& c) { c.habits.effects_at_once = 1; }, kOneForce},
      {"two effects at a time", [](Config& c) { c.habits.effects_at_once = 2; }, "only two effects at a time"},
      {"three effects at a time", [](Config& c) { c.habits.effects_at_once = 3; }, "only three effects at a time"},
      {"silence after each start", [](Config& c) { c.habits.restart_gap = 0.001; }, "each renewal interrupts a force"},
      {"stopped blocks are free", [](Config& c) { c.habits.stopped_is_free = true; }},
      {"mute until stop-all", [](Config& c) { c.habits.mute_until_stop_all = true; }},
      {"off until enabled", [](Config& c) { c.habits.off_until_enabled = true; }},
      {"off, but says on",
       [](Config& c) {
         c.habits.off_until_enabled = true;
         c.habits.says_actuators = true;
       }},
      {"ignores actuators", [](Config& c) { c.habits.ignores_actuators = true; }},
      {"stop-all erases", [](Config& c) { c.habits.stop_all_erases = true; }},
      {"ignores stop-all", [](Config& c) { c.habits.ignores_stop_all = true; }},
      {"tests bits of controls", [](Config& c) { c.habits.control_tests_bits = true; }},
      {"forces 4 ms late", [](Config& c) { c.delay = 0.004; }},
      {"readings every 4 ms", [](Config& c) { c.input_interval = 0.004; }},
      {"readings every 8 ms", [](Config& c) { c.input_interval = 0.008; }},
      {"pool managed by the driver", [](Config& c) { c.family = StickFamily::saitek; }},
      {"answers late", [](Config& c) { c.habits.late_loads = 20; }},
      {"short features", [](Config& c) { c.habits.short_features = 1; }},
      {"answers once", [](Config& c) { c.habits.load_answers_once = true; }},
      {"first create fails", [](Config& c) { c.habits.first_create_fails = true; }},
      {"pool said to be the driver's", [](Config& c) { c.habits.pool_by_driver_flag = true; }},
      {"reading the pool frees all", [](Config& c) { c.habits.pool_read_frees_all = true; }},
      {"reports no state", [](Config& c) { c.habits.state_sent = StateSent::never; }},
      {"reports its state at settings", [](Config& c) { c.habits.state_sent = StateSent::at_setting; }},
      {"says no safety switch", [](Config& c) { c.habits.says_no_safety_switch = true; }},
      {"says no power", [](Config& c) { c.habits.says_no_power = true; }},
      {"says no actuators", [](Config& c) { c.habits.says_no_actuators = true; }},
      {"longer reports", [](Config& c) { c.habits.longer_input = 3; }},
      {"shorter reports", [](Config& c) { c.habits.longer_input = -1; }, "", "the stick sends no position"},
  };
  return all;
}

// Calibrates and drives a stick. Fails if the dialogue does not end, if a force has the wrong sign, or if something is
// left out, silent or wrong and no sentence names what one of the habits breaks.
void check_stick(const EmulatedStickConfig& config, const std::string& name, const std::vector<Habit>& given) {
  CAPTURE(name);
  const Calibrated calibrated = calibrate_stick(config);
  CHECK(calibrated.seconds < kMaxDialogue);
  Driven driven;
  std::string said = calibrated.heard;
  if (calibrated.refusal.empty()) driven = drive_through_gate(config, calibrated.found);
  for (const std::string& problem : driven.problems) append(said, problem);
  CAPTURE(said);
  const auto says = [&](const char* words) { return *words != '\0' && said.find(words) != said.npos; };
  const auto names = [&](const Habit& habit) {
    return says(habit.words) || (given.size() > 1 && says(habit.elsewhere));
  };
  const bool is_named = std::any_of(given.begin(), given.end(), names);
  if (given.size() == 1) CHECK(is_named == (*given.front().words != '\0'));
  CHECK((calibrated.left_out.empty() || is_named));
  if (!calibrated.refusal.empty()) return;
  const DeviceCalibration& found = calibrated.found;
  const bool has_own_spring = found.select.own_spring > 0.0;
  CHECK((found.timing.restart_gap > 0.0) == (config.habits.restart_gap > 0.0));
  CHECK(std::abs(found.timing.restart_gap - config.habits.restart_gap) < 0.0015);
  const DeadBandLaw band = config.habits.dead_band;
  const double width = band == DeadBandLaw::narrow ? 0.6 : band == DeadBandLaw::wide ? 1.6 : 1.0;
  if (found.has_springs() && found.springs_refused.empty()) {
    CHECK(found.select.spring_dead_band == doctest::Approx(width).epsilon(0.05));
    CHECK(found.shift.spring_dead_band == doctest::Approx(width).epsilon(0.05));
  }
  CHECK(has_own_spring == (config.habits.auto_centre == AutoCentre::while_on));
  CHECK(driven.gears == 7);
  const AutoCentre centring = config.habits.auto_centre;
  const bool is_alone = config.habits.effects_at_once == 1;  // no spring can play beside a force
  // Forces that nothing can switch off.
  if (has_own_spring || centring == AutoCentre::always || (centring == AutoCentre::until_spring && is_alone)) {
    CHECK(is_named);
    return;
  }
  CHECK(driven.wrong < 0.05);
  CHECK((driven.silent < 0.05 || is_named));
  CHECK((driven.rms < kMaxRms || is_named));
  CHECK(driven.rms < 2.0 * kMaxRms);
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
      {"PID 1.0, centres itself", "", ""},
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
      {"Arduino-FFB-wheel, two motors", "", "springs need forces along both axes"},
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
    CHECK(calibrated.left_out.empty() == (*expected[i].refusal == '\0' && *expected[i].springs == '\0'));
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

TEST_CASE("a stick whose only motor moves X drives the gate's shift axis, if X is named as that") {
  for (const StickProfile& profile : stick_profiles()) {
    if (profile.habits.motors == 2) continue;
    CAPTURE(std::string(profile.name));
    const EmulatedStickConfig config = config_of(profile);
    const Calibrated calibrated = calibrate_stick(config, true);
    CHECK(calibrated.refusal == "");
    CHECK(calibrated.found.select_by_position);
    CHECK(calibrated.heard.find(
              "the stick has a motor for shift, but none for select, so only forces along shift are used: "
              "walls of select are not felt, and the position chooses the slot") != std::string::npos);
    const Driven driven = drive_through_gate(config, calibrated.found, true);
    CHECK(driven.gears == 7);
    CHECK(driven.rms < kMaxRms);
    CHECK(driven.wrong == 0.0);
    CHECK(driven.problems.empty());
  }
}

// Levers along one axis: the select axis needs neither motor nor forces.
TEST_CASE("a lever that moves forward and back only, and a sequential gate: with one motor and with two") {
  std::string table = "gate | motors | gears | rms N | worst N\n";
  for (const bool is_sequential : {false, true}) {
    for (const int motors : {1, 2}) {
      CAPTURE(is_sequential);
      CAPTURE(motors);
      EmulatedStickConfig config;
      config.family = StickFamily::openffboard;
      config.habits.motors = motors;
      const bool is_swapped = motors == 1;  // the only motor moves X
      const Calibrated calibrated = calibrate_stick(config, is_swapped);
      CHECK(calibrated.refusal == "");
      CHECK(calibrated.found.select_by_position == is_swapped);
      const Gate gate = is_sequential ? stick_gate(kSequentialGate, config) : straight_gate(config);
      const Driven driven = drive_through(gate, config, calibrated.found, is_swapped);
      if (is_sequential)
        CHECK(driven.order == std::vector{1, 2, 3, 4, 5, 6, 5, 4, 3, 2, 1, kReverseGear});
      else
        CHECK(driven.gears == 2);
      CHECK(driven.rms < kMaxRms);
      CHECK(driven.wrong == 0.0);
      CHECK(driven.problems.empty());
      table += std::string(is_sequential ? "sequential" : "straight") + " | " + std::to_string(motors) + " | " +
               std::to_string(driven.gears) + " | " + std::to_string(driven.rms) + " | " +
               std::to_string(driven.worst) + '\n';
    }
  }
  MESSAGE(table);
}

TEST_CASE("every habit alone: the dialogue ends, no force has the wrong sign, what is broken is named") {
  for (const Habit& habit : habits()) {
    EmulatedStickConfig config;
    habit.give(config);
    check_stick(config, habit.name, {habit});
  }
}

TEST_CASE("random pairs of habits on any family") {
  constexpr StickFamily kFamilies[] = {StickFamily::sidewinder, StickFamily::openffboard, StickFamily::vjoy,
                                       StickFamily::arduino, StickFamily::sunffb};
  std::mt19937 chance(35);
  for (unsigned pair = 0; pair < campaign_size(200, 8); ++pair) {
    EmulatedStickConfig config;
    config.family = kFamilies[chance() % std::size(kFamilies)];
    const std::size_t one = chance() % habits().size(), other = 1 + chance() % (habits().size() - 1);
    const Habit &first = habits()[one], &second = habits()[(one + other) % habits().size()];
    first.give(config);
    second.give(config);
    check_stick(config, std::string(to_string(config.family)) + ", " + first.name + ", " + second.name,
                {first, second});
  }
}
