// Tests of the calibration file, which must preserve every bit, and of the DeviceSpec made from a calibration.
#include "haptics/hardware/device_calibration.h"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <random>
#include <sstream>
#include <stdexcept>
#include <string>

#include <doctest/doctest.h>

#include "haptics/files/file_error.h"
#include "haptics/hardware/calibrator.h"
#include "haptics/loop/haptic_config.h"
#include "tests/support/gates.h"
#include "tests/support/temp_folder.h"

using namespace gearshift::haptics;
using namespace gearshift::test;

namespace {

class RandomCalibration {
 public:
  explicit RandomCalibration(std::uint64_t seed) : chance_(seed) {}

  DeviceCalibration make() {
    DeviceCalibration made;
    made.vendor = static_cast<std::uint16_t>(chance_());
    made.product = static_cast<std::uint16_t>(chance_());
    if (flag()) made.serial = "S\"" + std::to_string(chance_()) + "\\";
    if (flag())
      made.name =
          "St\xc3\xb6"
          "ck # " +
          std::to_string(chance_());
    fill(made.select);
    fill(made.shift);
    made.select.usage = 0x30 + static_cast<int>(chance_() % 4);
    made.shift.usage = 0x34 + static_cast<int>(chance_() % 5);
    made.timing = {between(0.0, 1.0), between(0.0, 1.0), between(0.0, 1.0), between(0.0, 1.0), between(0.0, 1.0)};
    made.style = {static_cast<AxisStyle>(chance_() % 3), static_cast<AxisStyle>(chance_() % 3),
                  static_cast<SignStyle>(chance_() % 2)};
    made.holds_spring = flag();
    made.select_by_position = flag();
    if (flag()) made.effects_at_once = 1 + static_cast<int>(chance_() % 4);
    if (flag()) made.springs_refused = "springs \"" + std::to_string(chance_());
    if (flag()) made.dampers_refused = "dampers # " + std::to_string(chance_());
    made.buttons.press = static_cast<int>(chance_() % 65);
    made.buttons.lift = static_cast<int>(chance_() % 65);
    made.buttons.stop = static_cast<int>(chance_() % 65);
    return made;
  }

 private:
  double between(double low, double high) { return std::uniform_real_distribution<double>(low, high)(chance_); }
  bool flag() { return chance_() % 2 == 0; }
  int sign() { return static_cast<int>(chance_() % 3) - 1; }

  void fill(LeverAxisCalibration& axis) {
    axis.low = between(-4e4, 4e4);
    axis.high = between(-4e4, 4e4);
    axis.centre = axis.low + between(0.1, 0.9) * (axis.high - axis.low);
    axis.travel = flag() ? 0.0 : between(0.01, 1.0);
    axis.full_force = flag() ? 0.0 : between(0.1, 200.0);
    axis.constant_sign = sign();
    axis.spring_sign = sign();
    axis.spring_stiffness = between(0.0, 1e5);
    axis.spring_dead_band = between(0.0, 10.0);
    axis.own_spring = between(0.0, 1e5);
    axis.friction = between(0.0, 1e3);
    axis.damper_sign = sign();
    for (double* fraction : {&axis.constant_cross_talk, &axis.spring_cross_talk, &axis.damper_cross_talk})
      if (flag()) *fraction = between(0.0, 10.0);
    if (flag()) axis.constant_coupling = between(-0.9, 0.9);
    if (flag()) {
      axis.constant_limit = between(0.01, 1.0);
      axis.constant_slope = between(0.01, 10.0);
    }
    axis.damper_strength = between(0.0, 1e3);
    if (flag()) axis.handle = {between(1e-3, 1e3), between(0.0, 1e4), between(0.0, 1e6)};
  }

  std::mt19937_64 chance_;
};

bool same(const AxisModel& a, const AxisModel& b) {
  return a.mass == b.mass && a.damping == b.damping && a.stiffness == b.stiffness;
}

bool same(const LeverAxisCalibration& a, const LeverAxisCalibration& b) {
  return a.usage == b.usage && a.low == b.low && a.centre == b.centre && a.high == b.high && a.travel == b.travel &&
         a.full_force == b.full_force && a.constant_sign == b.constant_sign && a.spring_sign == b.spring_sign &&
         a.spring_stiffness == b.spring_stiffness && a.spring_dead_band == b.spring_dead_band &&
         a.own_spring == b.own_spring && a.friction == b.friction && a.damper_sign == b.damper_sign &&
         a.damper_strength == b.damper_strength && a.constant_cross_talk == b.constant_cross_talk &&
         a.spring_cross_talk == b.spring_cross_talk && a.damper_cross_talk == b.damper_cross_talk &&
         a.constant_limit == b.constant_limit && a.constant_slope == b.constant_slope &&
         a.constant_coupling == b.constant_coupling && same(a.handle, b.handle);
}

bool same(const DeviceTiming& a, const DeviceTiming& b) {
  return a.input_interval == b.input_interval && a.output_interval == b.output_interval && a.delay == b.delay &&
         a.jitter == b.jitter && a.restart_gap == b.restart_gap;
}

bool same(const DeviceCalibration& a, const DeviceCalibration& b) {
  return a.style == b.style && a.effects_at_once == b.effects_at_once && a.holds_spring == b.holds_spring &&
         a.select_by_position == b.select_by_position && a.springs_refused == b.springs_refused &&
         a.dampers_refused == b.dampers_refused && a.vendor == b.vendor && a.product == b.product &&
         a.serial == b.serial && a.name == b.name && same(a.select, b.select) && same(a.shift, b.shift) &&
         same(a.timing, b.timing) && a.buttons.press == b.buttons.press && a.buttons.lift == b.buttons.lift &&
         a.buttons.stop == b.buttons.stop;
}

// Calibration of the paper's joystick as a stick with 140 mm travel, 20 N of force and the given timing.
DeviceCalibration measured(const DeviceTiming& timing) {
  DeviceCalibration known;
  known.select = {0x30, 0.0, 500.0, 1000.0, 0.14, 20.0, 1, 1, 400.0, kPaperAxisX};
  known.shift = {0x31, 1000.0, 400.0, 0.0, 0.14, 20.0, -1, 1, 300.0, kPaperAxisY};
  known.select.spring_dead_band = known.shift.spring_dead_band = 1.0;
  known.timing = timing;
  return known;
}

std::string refusal(const std::string& text) {
  const TempFolder folder;
  std::ofstream(folder / "c.toml") << text;
  try {
    (void)read_calibration(folder / "c.toml");
  } catch (const FileError& error) {
    const std::string sentence = error.what();
    return sentence.substr(sentence.find("c.toml"));
  }
  return "";
}

// The text of a calibration in which `line` replaces the line of `key`.
std::string changed(const std::string& key, const std::string& line) {
  std::istringstream text(calibration_text(measured({0.001, 0.001, 0.002, 0.0})));
  std::string out, old;
  for (bool done = false; std::getline(text, old);) {
    const bool is_it = !done && old.rfind(key + " = ", 0) == 0;
    out += (is_it ? line : old) + '\n';
    done = done || is_it;
  }
  return out;
}

}  // namespace

TEST_CASE("a written calibration is read back: every key, every bit") {
  const TempFolder folder;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    CAPTURE(seed);
    const DeviceCalibration written = RandomCalibration(seed).make();
    const std::filesystem::path file = folder / "deep" / "c.toml";
    write_calibration(written, file);
    const std::optional<DeviceCalibration> back = read_calibration(file);
    REQUIRE(back.has_value());
    CHECK(same(*back, written));
  }
  CHECK(read_calibration(folder / "none.toml") == std::nullopt);
}

TEST_CASE("every device has its own file, whatever its serial number") {
  HidIdentity stick;
  stick.vendor = 0x045e;
  stick.product = 0x001b;
  CHECK(calibration_file("/c", stick) == "/c/045e_001b.toml");
  stick.serial = "A-1/../\xc3\xa9\n";
  CHECK(calibration_file("/c", stick) == "/c/045e_001b_A-1_______.toml");
}

TEST_CASE("invalid values are refused with file, line, key, value and range") {
  CHECK(refusal(changed("low_counts", "low_counts = 600")) ==
        "c.toml:8: centre_counts = 500: must lie between low_counts and high_counts");
  CHECK(refusal(changed("travel_m", "travel_m = 0.003")) ==
        "c.toml:10: travel_m = 0.003: must be 0 (unknown) or between 0.01 and 1");
  CHECK(refusal(changed("constant_sign", "constant_sign = 2")) ==
        "c.toml:12: constant_sign = 2: must be between -1 and 1");
  CHECK(refusal(changed("constant_sign", "constant_sign = 0.5")) ==
        "c.toml:12: constant_sign = 0.5: must be a whole number");
  CHECK(refusal(changed("mass_kg", "mass_kg = nan")).find("c.toml:28: mass_kg = nan: must be between 0 and 1000") == 0);
  CHECK(refusal(changed("axis", "axis = \"q\"")) ==
        "c.toml:6: axis = \"q\": must be one of x, y, z, rx, ry, rz, slider, dial, wheel");
  CHECK(refusal(changed("axis", "axis = \"y\"")).find("must differ from the axis of select") != std::string::npos);
  CHECK(refusal(changed("stop", "stop = 65")).find("stop = 65: must be between 0 and 64") != std::string::npos);
  CHECK(refusal(changed("stop", "halt = 1")).find("halt") != std::string::npos);
  CHECK(refusal(changed("high_counts", "")).find("high_counts is missing") != std::string::npos);
  CHECK(refusal("vendor = 1\n").find("product is missing") != std::string::npos);
  CHECK(refusal("what").find("not valid TOML") != std::string::npos);
}

TEST_CASE("a calibration that could not be read back is not written, and the old file stays") {
  const TempFolder folder;
  const std::filesystem::path file = folder / "c.toml";
  write_calibration(measured({}), file);
  DeviceCalibration bad = measured({});
  bad.select.centre = 2000.0;
  CHECK_THROWS_AS(write_calibration(bad, file), FileError);
  CHECK(same(*read_calibration(file), measured({})));
}

TEST_CASE("cycles of delay: (1 + delay) T is at least the time from a reading to its answer") {
  // The comments give the sum of input interval, jitter, output interval and delay.
  CHECK(delay_cycles({0.001, 0.001, 0.0, 0.0}, 0.001) == 1);        // 2.0 ms
  CHECK(delay_cycles({0.001, 0.001, 0.002, 0.0}, 0.001) == 3);      // 4.0 ms: one period of 1 ms plus 3 cycles
  CHECK(delay_cycles({0.001, 0.001, 0.002, 0.0001}, 0.001) == 4);   // 4.1 ms
  CHECK(delay_cycles({0.001, 0.001, 0.002, 0.0}, 0.002) == 1);      // 4.0 ms: one period of 2 ms plus 1 cycle
  CHECK(delay_cycles({0.001, 0.001, 0.002, 0.0}, 0.00025) == 15);   // 4.0 ms
  CHECK(delay_cycles({0.000125, 0.000125, 0.0, 0.0}, 0.001) == 0);  // 0.25 ms
  CHECK_THROWS_WITH_AS(
      delay_cycles({0.008, 0.008, 0.004, 0.0}, 0.001),
      "the stick responds after 20 ms, but at 1000 Hz the loop compensates at most 16 ms; a rate of 800 Hz would work",
      std::invalid_argument);
  CHECK(delay_cycles({0.008, 0.008, 0.004, 0.0}, 1.0 / 800.0) == 15);
  CHECK_THROWS_WITH_AS(delay_cycles({0.1, 0.1, 0.0, 0.0}, 0.001),
                       "the stick responds after 200 ms, but at 1000 Hz the loop compensates at most 16 ms; the stick "
                       "is too slow for any "
                       "rate from 100 Hz up",
                       std::invalid_argument);
}

TEST_CASE("a file from before dead bands were measured loads, its springs are not used, and its signs still hold") {
  std::istringstream text(calibration_text(measured({0.001, 0.001, 0.002, 0.0})));
  std::string old, line;
  for (bool keeps = true; std::getline(text, line);) {
    if (line.starts_with("[")) keeps = !line.starts_with("[effects]");
    if (keeps && !line.starts_with("spring_dead_band")) old += line + '\n';
  }
  const TempFolder folder;
  std::ofstream(folder / "c.toml") << old;
  const DeviceCalibration known = read_calibration(folder / "c.toml").value();
  CHECK(known.style == StickStyle{AxisStyle::both, AxisStyle::bits});  // as the program named axes then
  CHECK(known.has_polarity());
  CHECK(known.select.spring_stiffness == 400.0);
  CHECK_FALSE(known.has_springs());
  CHECK(spec_of(known, 0.001).device_wall_stiffness == glm::dvec2(0.0));
}

TEST_CASE("the device specification from a calibration") {
  const DeviceSpec spec = spec_of(measured({0.001, 0.001, 0.002, 0.0}), 0.001);
  CHECK(spec.max_force == glm::dvec2(20.0));
  CHECK(spec.workspace == glm::dvec2(0.07));
  CHECK(spec.position_step == doctest::Approx(0.07 / 400.0));  // 400 counts from the centre to the nearer stop
  CHECK(spec.delay == 3);
  CHECK(spec.axis_x.mass == kPaperAxisX.mass);
  CHECK(spec.device_wall_stiffness == glm::dvec2(300.0));  // the smaller stiffness of the two axes
  CHECK_FALSE(spec.measures_hand_force);
  CHECK_FALSE(spec.simulated);

  DeviceCalibration unknown = measured({});
  unknown.shift.constant_sign = 0;
  unknown.select.handle = {};
  const DeviceSpec careful = spec_of(unknown, 0.001);
  CHECK(careful.max_force == glm::dvec2(0.0));  // no force is allowed: one axis has no measured polarity
  CHECK(careful.device_wall_stiffness == glm::dvec2(0.0));
  CHECK(careful.delay == 7);  // unmeasured timing counts as 8 ms: one period of 1 ms plus 7 cycles
  CHECK(careful.axis_x.mass == kUnmeasuredHandle.mass);

  DeviceCalibration weak = measured({});
  weak.shift.spring_stiffness = 40.0;
  CHECK(spec_of(weak, 0.001).device_wall_stiffness == glm::dvec2(0.0));
}

TEST_CASE("the builder's guide shows a calibration exactly as the program writes it") {
  std::ifstream file(GEARSHIFT_TEST_DATA "/../../haptics/hardware/BUILDING.md");
  const std::string page{std::istreambuf_iterator<char>(file), {}};
  const std::string fence = "```toml 1209_ffb0_EMULATED01.toml\n";
  const auto begin = page.find(fence);
  REQUIRE(begin != std::string::npos);
  const std::string shown = page.substr(begin + fence.size(), page.find("```\n", begin + 3) - begin - fence.size());
  const TempFolder folder;
  std::ofstream(folder / "shown.toml") << shown;

  const auto known = read_calibration(folder / "shown.toml");
  REQUIRE(known);
  CHECK(calibration_text(*known) == shown);
  CHECK(known->product == 0xffb0);
  CHECK(known->shift.low == 32767.0);
  CHECK(known->select.handle.mass == 0.2483);
  CHECK(known->timing.output_interval == 0.001131);
  CHECK(known->buttons.lift == 2);
  CHECK(missing_steps(*known, true, true).empty());  // so it has the key of every measurement
  for (const char* key : {"springs_refused", "dampers_refused"}) {
    CAPTURE(key);
    CHECK(shown.find(key) == std::string::npos);
    CHECK(page.find('`' + std::string(key) + '`') != std::string::npos);
  }
}

// At 1 kHz with three samples of delay and no wall damping, the exact limit of the wall stiffness is 873 N/m (X axis).
// With the half-sample hold the limit is 2078 N/m.
TEST_CASE("a 3 ms device gets parameters that are stable at 3 ms, and reports the limit") {
  DeviceCalibration known = measured({0.001, 0.001, 0.002, 0.0});
  known.select.spring_sign = known.shift.spring_sign = 0;
  known.select.high = known.shift.low = 1023.0;  // counts of 137 um: coarser ones are limited further
  known.select.centre = known.shift.centre = 511.0;
  const DeviceSpec spec = spec_of(known, 0.001);
  HapticConfig config;

  config.contact.hold = ContactHold::zero_order;
  config.tuning.wall_damping = config.tuning.aisle_damping = config.tuning.limit_damping = 0.0;
  const AdmittedTuning plain = admit_tuning(config, spec, paper_feel());
  CHECK(plain.tuning.wall_stiffness > 683.0);
  CHECK(plain.tuning.wall_stiffness < 873.0);
  const auto is_wall = [](const TuningLimit& one) {
    return one.parameter == &HapticTuning::wall_stiffness && one.wanted == 5000.0;
  };
  CHECK(std::any_of(plain.limits.begin(), plain.limits.end(), is_wall));

  config = {};
  config.contact.hold = ContactHold::half_sample;
  const AdmittedTuning held = admit_tuning(config, spec, paper_feel());
  // The limit is 1344 N/m, the limit of the lighter axis.
  CHECK(held.tuning.wall_stiffness == doctest::Approx(0.25 * kPaperAxisY.mass / 16e-6));
  CHECK(std::any_of(held.limits.begin(), held.limits.end(), is_wall));
}
