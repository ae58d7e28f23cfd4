// A simulated user calibrates an emulated stick on a virtual clock. Measurements and answers are saved, invalid answers
// are asked for again, and an interrupted calibration continues where it stopped.
#include "app/runtime/devices/calibration_dialog.h"

#include <atomic>
#include <cmath>
#include <deque>
#include <functional>
#include <mutex>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "tests/support/stick/stick_port.h"

using namespace gearshift::haptics;
using namespace gearshift::runtime;
using namespace gearshift::test;

namespace {

constexpr std::int64_t kMillisecond = 1'000'000;

// A hand that pushes with a constant force and does not hold the lever at a position.
class Pusher final : public HandDriver {
 public:
  HandTarget next(double, glm::dvec2 lever) noexcept override {
    HandTarget target;
    target.position = lever;
    target.push = push;
    return target;
  }
  glm::dvec2 push{0.0};  // [N]
};

EmulatedStickConfig bare_stick(const StickHabits& habits = {}) {
  EmulatedStickConfig config;
  config.habits = habits;
  config.lever.hand = kBareHand;
  return config;
}

// An emulated stick, its simulated user, and the dialog between the user and the program.
struct Rig {
  explicit Rig(const StickHabits& habits = {}) : stick(bare_stick(habits), hand) {}

  Pusher hand;
  EmulatedStick stick;
  std::mutex mutex;
  std::atomic<bool> plugged{true};
  StickPort port{stick, mutex, plugged};
  PidDriver driver{stick.report_descriptor()};
  PidAbility ability{driver.prepare(port)};
  std::int64_t now_ns = 1'000'000'000, asked_ns = now_ns;
  std::string question;
  std::vector<std::string> asked, printed;
  std::vector<DeviceCalibration> saved;
  std::deque<std::string> lines;  // if not empty, the user types these lines
  std::function<void(double)> action;

  std::int64_t tick() {
    now_ns += kMillisecond;
    if (action) action(1e-9 * static_cast<double>(now_ns - asked_ns));
    tick_stick(stick, driver.stream_config(kMillisecond), driver, now_ns);
    return now_ns;
  }

  bool is_about(const char* words) const { return question.find(words) != std::string::npos; }

  // Performs the user's next action and returns the line that the user types.
  std::string answer(const std::string& next) {
    asked.push_back(question = next);
    asked_ns = now_ns;
    stick.held_buttons = 0;
    hand.push = {};
    action = {};
    if (is_about("RIGHT")) action = [this](double time) { hand.push = {time > 0.7 ? 8.0 : 0.0, 0.0}; };
    if (is_about("FORWARD")) action = [this](double time) { hand.push = {0.0, time > 1.2 ? 8.0 : 0.0}; };
    if (is_about("the knob down")) action = [this](double time) { stick.held_buttons = time > 0.5 ? 4 : 0; };
    if (is_about("along all its stops")) {
      action = [this](double time) {
        const double turn = 2.0 * time;
        hand.push = time < 8.0 ? 9.0 * glm::dvec2(std::cos(turn), std::sin(turn)) : glm::dvec2(0.0);
      };
    }
    if (!lines.empty()) {
      std::string line = lines.front();
      lines.pop_front();
      return line;
    }
    if (is_about("lift the ring") || is_about("in an emergency")) return "-";
    if (is_about("left stop") || is_about("back stop")) return "140 mm";
    if (is_about("maximum force")) return "20";
    return "";
  }

  DeviceCalibration run(const DeviceCalibration& known = {}) {
    CalibrationDialog dialog;
    dialog.ask = [this](const std::string& next) { return answer(next); };
    dialog.print = [this](const std::string& line) { printed.push_back(line); };
    dialog.save = [this](const DeviceCalibration& calibration) { saved.push_back(calibration); };
    Calibrator calibrator(
        driver, [this] { return tick(); }, known, ability.spring);
    calibrate(calibrator, ability, dialog);
    return calibrator.calibration();
  }

  bool has_printed(const char* words) const {
    for (const std::string& line : printed)
      if (line.find(words) != std::string::npos) return true;
    return false;
  }
};

}  // namespace

TEST_CASE("a stick with dampers but without springs is asked for its dampers, once") {
  StickHabits habits;
  habits.springs_full = true;
  Rig rig(habits);
  REQUIRE_FALSE(rig.ability.spring);
  REQUIRE(rig.ability.damper);
  const DeviceCalibration found = rig.run();
  CHECK(found.springs_refused == "the stick has no springs");
  CHECK(found.dampers_refused == "");
  CHECK(found.select.damper_sign == 1);
  CHECK(found.shift.damper_strength ==
        doctest::Approx(DeviceCalibration(Rig().run()).shift.damper_strength).epsilon(0.1));
  CHECK(missing_steps(found, false, true).empty());
  Rig again(habits);
  (void)again.run(found);
  CHECK(again.asked.empty());
}

TEST_CASE("the calibration matches the user's actions and answers; every step is saved when done") {
  Rig rig;
  const DeviceCalibration found = rig.run();
  CHECK(missing_steps(found, true, true).empty());
  CHECK(found.select.usage == 0x30);
  CHECK(found.shift.usage == 0x31);
  CHECK(found.select.travel == doctest::Approx(0.14));  // the user typed 140 mm
  CHECK(found.shift.full_force == 20.0);
  CHECK(found.buttons.press == 3);  // the user pressed the button of bit 2, which is number 3
  CHECK(found.buttons.lift == 0);
  CHECK(found.buttons.stop == 0);
  CHECK(rig.saved.size() == 7);  // saved once per step: range, numbers, polarity, timing, strength, handle, springs
  CHECK(rig.saved.front().has_stops());
  CHECK_FALSE(rig.saved.front().has_travel());
}

TEST_CASE("one full force, or one for each axis") {
  using Pair = std::pair<double, double>;
  const auto forces = [](std::deque<std::string> answers) {
    Rig rig;
    DeviceCalibration known;
    known.select = {0x30, -512.0, -0.5, 511.0};
    known.shift = {0x31, 511.0, -0.5, -512.0};
    CalibrationDialog dialog;
    dialog.print = [&](const std::string& line) { rig.printed.push_back(line); };
    dialog.save = [](const DeviceCalibration&) {};
    dialog.ask = [&](const std::string& question) -> std::string {
      if (question.find("knob travel") != std::string::npos) return "140";
      if (question.find("maximum force") == std::string::npos || answers.empty()) return "-";
      const std::string answer = answers.front();
      answers.pop_front();
      return answer;
    };
    Calibrator calibrator(
        rig.driver, [&] { return rig.tick(); }, known);
    calibrate(calibrator, rig.ability, dialog);
    CHECK(rig.has_printed("is not one or two numbers from 0.5 to 100 N") == !answers.empty());
    return Pair{calibrator.calibration().select.full_force, calibrator.calibration().shift.full_force};
  };
  CHECK(forces({"20"}) == Pair(20.0, 20.0));
  CHECK(forces({"20 N"}) == Pair(20.0, 20.0));
  CHECK(forces({"20 15"}) == Pair(20.0, 15.0));
  CHECK(forces({" 20 N  15N "}) == Pair(20.0, 15.0));
  for (const char* nonsense : {"20 15 10", "20 200", "20 x", "20,15", "0 15"}) {
    CAPTURE(std::string(nonsense));
    CHECK(forces({nonsense, "-", "not asked"}) == Pair(0.0, 0.0));
  }
}

TEST_CASE("no motor moves before the user was told to let go of the stick") {
  Rig rig;
  bool moved = false, warned = false;
  CalibrationDialog dialog;
  dialog.print = [](const std::string&) {};
  dialog.save = [](const DeviceCalibration&) {};
  dialog.ask = [&](const std::string& next) {
    if (next.starts_with("HANDS OFF")) warned = true;
    if (!warned) CHECK_FALSE(moved);
    return rig.answer(next);
  };
  Calibrator calibrator(rig.driver,
                        [&] {
                          moved = moved || rig.stick.actuators_on() || rig.stick.playing() > 0;
                          return rig.tick();
                        },
                        {});
  calibrate(calibrator, rig.ability, dialog);
  CHECK(moved);
}

TEST_CASE("invalid input is reported and asked again: a stick that was not pushed, numbers out of range, words") {
  Rig rig;
  rig.lines = {"yes", ""};  // first an invalid answer, then only Enter
  bool slept = false;
  CalibrationDialog dialog;
  dialog.print = [&](const std::string& line) { rig.printed.push_back(line); };
  dialog.save = [&](const DeviceCalibration& calibration) { rig.saved.push_back(calibration); };
  dialog.ask = [&](const std::string& next) {
    std::string line = rig.answer(next);
    if (rig.asked.size() == 2) {
      rig.action = {};
      slept = true;
    }
    if (next.find("left stop") != std::string::npos && rig.asked.back() != rig.asked[rig.asked.size() - 2]) {
      rig.lines = {"1000", "a lot", "nan", " 140mm "};
      return std::string("-140");
    }
    return line;
  };
  Calibrator calibrator(rig.driver, [&] { return rig.tick(); }, {});
  calibrate(calibrator, rig.ability, dialog);
  CHECK(slept);
  CHECK(rig.has_printed("\"yes\" is not a valid answer"));
  CHECK(rig.has_printed("no axis moved"));
  for (const char* nonsense : {"\"-140\"", "\"1000\"", "\"a lot\"", "\"nan\""}) CHECK(rig.has_printed(nonsense));
  CHECK(calibrator.calibration().select.travel == doctest::Approx(0.14));
}

TEST_CASE("an interrupted calibration continues with the first missing step and asks for no known value") {
  Rig first;
  std::size_t questions = 0;
  CalibrationDialog dialog;
  dialog.print = [](const std::string&) {};
  dialog.save = [&](const DeviceCalibration& calibration) { first.saved.push_back(calibration); };
  dialog.ask = [&](const std::string& next) {
    if (next.starts_with("HANDS OFF") && ++questions == 2) throw CalibrationEnded("enough");
    return first.answer(next);
  };
  Calibrator calibrator(first.driver, [&] { return first.tick(); }, {});
  CHECK_THROWS_AS(calibrate(calibrator, first.ability, dialog), CalibrationEnded);
  REQUIRE(first.saved.size() == 3);

  Rig second;
  const DeviceCalibration found = second.run(first.saved.back());
  CHECK(missing_steps(found, true, true).empty());
  CHECK(second.asked.size() == 4);  // the questions are about timing, strength, handle and springs
  CHECK(second.asked.front().find("how fast the stick responds") != std::string::npos);
  CHECK(found.buttons.press == 3);
}

TEST_CASE("every step may be left out, and the question says what that costs") {
  for (const char* left_out : {"RIGHT", "knob down", "along all its stops", "left stop", "maximum force", "forces push",
                               "how fast", "how strong", "how heavy", "springs and dampers"}) {
    CAPTURE(left_out);
    Rig rig;
    CalibrationDialog dialog;
    dialog.print = [&](const std::string& line) { rig.printed.push_back(line); };
    dialog.save = [](const DeviceCalibration&) {};
    dialog.ask = [&](const std::string& next) {
      std::string line = rig.answer(next);
      if (!rig.is_about(left_out)) return line;
      CHECK(next.find("- to leave it out: then ") != std::string::npos);
      return std::string("-");
    };
    Calibrator calibrator(rig.driver, [&] { return rig.tick(); }, {});
    calibrate(calibrator, rig.ability, dialog);
    CHECK_FALSE(rig.has_printed("Rejected"));
    CHECK(calibrator.calibration().has_springs() ==
          (std::string(left_out) == "knob down" || std::string(left_out) == "how fast" ||
           std::string(left_out) == "how strong" || std::string(left_out) == "how heavy"));
  }
}

// "yes abc | gearshift devices --calibrate" must not fill a disk.
TEST_CASE("no question is asked for ever") {
  for (const char* question : {"RIGHT", "knob down", "along all its stops", "left stop", "back stop", "maximum force",
                               "forces push", "how fast", "how strong", "how heavy", "springs and dampers"}) {
    CAPTURE(question);
    Rig rig;
    CalibrationDialog dialog;
    dialog.print = [](const std::string&) {};
    dialog.save = [](const DeviceCalibration&) {};
    int asked = 0;
    dialog.ask = [&](const std::string& next) {
      std::string line = rig.answer(next);
      if (!rig.is_about(question)) return line;
      if (++asked > 100) throw std::runtime_error("asked for ever");
      return std::string("abc");
    };
    Calibrator calibrator(rig.driver, [&] { return rig.tick(); }, {});
    CHECK_NOTHROW(calibrate(calibrator, rig.ability, dialog));
    CHECK(asked > 1);
  }
}

// A person who always presses Enter, with a stick that never moves.
TEST_CASE("a step that is rejected three times is left out, and those that need it are not asked for") {
  Rig rig;
  CalibrationDialog dialog;
  dialog.print = [&](const std::string& line) { rig.printed.push_back(line); };
  dialog.save = [](const DeviceCalibration&) {};
  dialog.ask = [&](const std::string& next) {
    rig.stick.faults.stuck = next.starts_with("HANDS OFF");
    return rig.answer(next);
  };
  Calibrator calibrator(rig.driver, [&] { return rig.tick(); }, {});
  calibrate(calibrator, rig.ability, dialog);
  CHECK(rig.has_printed("the lever does not move with 10 % of the full force"));
  CHECK(rig.has_printed("This step is left out: the stick cannot be used."));
  CHECK(rig.asked.size() == 12);  // 6 for the range, 3 numbers, 3 times the direction of forces
  CHECK(calibrator.calibration().has_range());
  CHECK_FALSE(calibrator.calibration().has_polarity());
}
