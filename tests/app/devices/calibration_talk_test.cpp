// A calibration from its first question to its last, with an emulated stick and a person on a virtual clock: what he shows
// and says is what is kept, nonsense is asked again, and one that was broken off goes on where it was.
#include "app/devices/calibration_talk.h"

#include <atomic>
#include <cmath>
#include <deque>
#include <functional>
#include <mutex>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "tests/support/stick/stick_port.h"

using namespace gearshift;

namespace {

constexpr std::int64_t kMillisecond = 1'000'000;

// Holds nothing but what he pushes with.
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

EmulatedStickConfig bare_stick() {
  EmulatedStickConfig config;
  config.lever.hand = kBareHand;
  return config;
}

// The stick, the person at it, and the talk between him and the program.
struct Rig {
  Pusher hand;
  EmulatedStick stick{bare_stick(), hand};
  std::mutex mutex;
  std::atomic<bool> plugged{true};
  StickPort port{stick, mutex, plugged};
  PidDriver driver{stick.report_descriptor()};
  PidAbility ability{driver.prepare(port)};
  std::int64_t now_ns = 1'000'000'000, asked_ns = now_ns;
  std::string question;
  std::vector<std::string> asked, said;
  std::vector<DeviceCalibration> kept;
  std::deque<std::string> lines;  // in place of his own answers
  std::function<void(double)> does;

  std::int64_t tick() {
    now_ns += kMillisecond;
    if (does) does(1e-9 * static_cast<double>(now_ns - asked_ns));
    tick_stick(stick, driver.stream_config(kMillisecond), driver, now_ns);
    return now_ns;
  }

  bool is_about(const char* words) const { return question.find(words) != std::string::npos; }

  // What he does next, and what he types.
  std::string answer(const std::string& next) {
    asked.push_back(question = next);
    asked_ns = now_ns;
    stick.held_buttons = 0;
    hand.push = {};
    does = {};
    if (is_about("RIGHT")) does = [this](double time) { hand.push = {time > 0.7 ? 8.0 : 0.0, 0.0}; };
    if (is_about("FORWARD")) does = [this](double time) { hand.push = {0.0, time > 1.2 ? 8.0 : 0.0}; };
    if (is_about("knob down")) does = [this](double time) { stick.held_buttons = time > 0.5 ? 4 : 0; };
    if (is_about("round along")) {
      does = [this](double time) {
        const double turn = 2.0 * time;
        hand.push = time < 8.0 ? 9.0 * glm::dvec2(std::cos(turn), std::sin(turn)) : glm::dvec2(0.0);
      };
    }
    if (!lines.empty()) {
      std::string line = lines.front();
      lines.pop_front();
      return line;
    }
    if (is_about("lifts the ring") || is_about("switches the motors off")) return "-";
    if (is_about("left stop") || is_about("back stop")) return "140 mm";
    if (is_about("How strong")) return "20";
    return "";
  }

  DeviceCalibration run(const DeviceCalibration& known = {}) {
    CalibrationTalk talk;
    talk.ask = [this](const std::string& next) { return answer(next); };
    talk.say = [this](const std::string& line) { said.push_back(line); };
    talk.keep = [this](const DeviceCalibration& calibration) { kept.push_back(calibration); };
    Calibrator calibrator(
        driver, [this] { return tick(); }, known);
    calibrate(calibrator, ability.spring, talk);
    return calibrator.calibration();
  }

  bool has_said(const char* words) const {
    for (const std::string& line : said)
      if (line.find(words) != std::string::npos) return true;
    return false;
  }
};

}  // namespace

TEST_CASE("what a person shows and says is what is known of the stick at the end; every step is kept when it is done") {
  Rig rig;
  const DeviceCalibration found = rig.run();
  CHECK(missing_steps(found, true).empty());
  CHECK(found.select.usage == 0x30);
  CHECK(found.shift.usage == 0x31);
  CHECK(found.select.travel == doctest::Approx(0.14));  // as he said
  CHECK(found.shift.full_force == 20.0);
  CHECK(found.press_button == 3);  // he held bit 2
  CHECK(found.lift_button == 0);
  CHECK(found.stop_button == 0);
  CHECK(rig.kept.size() == 6);  // range, numbers, polarity, timing, handle, springs
  CHECK(rig.kept.front().has_stops());
  CHECK_FALSE(rig.kept.front().has_travel());
}

TEST_CASE("no motor moves before the person was told to keep his hands off") {
  Rig rig;
  bool moved = false, warned = false;
  CalibrationTalk talk;
  talk.say = [](const std::string&) {};
  talk.keep = [](const DeviceCalibration&) {};
  talk.ask = [&](const std::string& next) {
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
  calibrate(calibrator, rig.ability.spring, talk);
  CHECK(moved);
}

TEST_CASE("what cannot be is told and asked again: a stick that was not pushed, numbers out of range, words") {
  Rig rig;
  rig.lines = {"yes", ""};  // to the first question; and then he sleeps
  bool slept = false;
  CalibrationTalk talk;
  talk.say = [&](const std::string& line) { rig.said.push_back(line); };
  talk.keep = [&](const DeviceCalibration& calibration) { rig.kept.push_back(calibration); };
  talk.ask = [&](const std::string& next) {
    std::string line = rig.answer(next);
    if (rig.asked.size() == 2) {
      rig.does = {};
      slept = true;
    }
    if (next.find("left stop") != std::string::npos && rig.asked.back() != rig.asked[rig.asked.size() - 2]) {
      rig.lines = {"1000", "a lot", "nan", " 140mm "};
      return std::string("-140");
    }
    return line;
  };
  Calibrator calibrator(rig.driver, [&] { return rig.tick(); }, {});
  calibrate(calibrator, rig.ability.spring, talk);
  CHECK(slept);
  CHECK(rig.has_said("\"yes\" is no answer"));
  CHECK(rig.has_said("no axis moved"));
  for (const char* nonsense : {"\"-140\"", "\"1000\"", "\"a lot\"", "\"nan\""}) CHECK(rig.has_said(nonsense));
  CHECK(calibrator.calibration().select.travel == doctest::Approx(0.14));
}

TEST_CASE("broken off, it goes on with the first step that is missing, and asks for nothing that is known") {
  Rig first;
  std::size_t questions = 0;
  CalibrationTalk talk;
  talk.say = [](const std::string&) {};
  talk.keep = [&](const DeviceCalibration& calibration) { first.kept.push_back(calibration); };
  talk.ask = [&](const std::string& next) {
    if (next.starts_with("HANDS OFF") && ++questions == 2) throw CalibrationEnded("enough");
    return first.answer(next);
  };
  Calibrator calibrator(first.driver, [&] { return first.tick(); }, {});
  CHECK_THROWS_AS(calibrate(calibrator, true, talk), CalibrationEnded);
  REQUIRE(first.kept.size() == 3);

  Rig second;
  const DeviceCalibration found = second.run(first.kept.back());
  CHECK(missing_steps(found, true).empty());
  CHECK(second.asked.size() == 3);  // timing, handle, springs
  CHECK(second.asked.front().find("How fast it answers") != std::string::npos);
  CHECK(found.press_button == 3);
}

TEST_CASE("a measurement may be left out where the stick can be driven without, and only there") {
  Rig rig;
  CalibrationTalk talk;
  talk.say = [&](const std::string& line) { rig.said.push_back(line); };
  talk.keep = [](const DeviceCalibration&) {};
  talk.ask = [&](const std::string& next) {
    const std::string line = rig.answer(next);
    const bool first_time = rig.asked.size() < 2 || rig.asked[rig.asked.size() - 2] != next;
    return next.starts_with("HANDS OFF") && first_time ? "-" : line;
  };
  Calibrator calibrator(rig.driver, [&] { return rig.tick(); }, {});
  calibrate(calibrator, rig.ability.spring, talk);
  CHECK(calibrator.calibration().has_polarity());
  CHECK(calibrator.calibration().has_timing());
  CHECK_FALSE(calibrator.calibration().has_handle());
  CHECK(rig.has_said("\"-\" is no answer here"));
}
