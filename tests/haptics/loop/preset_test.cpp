// Tests of presets: the shipped presets can be read, every key sets its struct member, and error messages name line and
// key.
#include "haptics/loop/preset.h"

#include <cmath>
#include <fstream>
#include <stdexcept>
#include <string>
#include <type_traits>

#include <doctest/doctest.h>

#include "haptics/files/file_error.h"
#include "haptics/files/toml_text.h"
#include "haptics/loop/trace_fields.h"
#include "tests/support/temp_folder.h"

using namespace gearshift::haptics;
using namespace gearshift::test;

namespace {

const std::string presets = GEARSHIFT_ASSETS "/presets/";

// Reads a preset whose first line is its name; `text` begins in line 2.
Preset preset_of(const std::string& text) {
  const TempFolder folder;
  const std::string file = (folder / "my.toml").string();
  std::ofstream(file) << "name = \"Test\"\n" << text;
  return read_preset(file);
}

std::string refusal(const std::string& text) {
  try {
    preset_of(text);
  } catch (const FileError& error) {
    const std::string sentence = error.what();
    return sentence.substr(sentence.find("my.toml"));
  }
  return "accepted";
}

// Compares all members of two structs and their nested structs, using the trace's field lists.
template <class T>
void check_equal(const T& a, const T& b, const std::string& name) {
  CAPTURE(name);
  if constexpr (LeafField<T>) {
    CHECK(a == b);
  } else {
    each_field(a, [&](const std::string& member, const auto& left) {
      each_field(b, [&](const std::string& other, const auto& right) {
        if constexpr (std::is_same_v<decltype(left), decltype(right)>) {
          if (member == other) check_equal(left, right, name + "." + member);
        }
      });
    });
  }
}

// The structured bindings stop compiling when a struct gains a member, so no member can be forgotten here.
void check_equal(const SimulatedLeverConfig& a, const SimulatedLeverConfig& b) {
  const auto& [yoke, axis_x, axis_y, friction, counts, actuator, sensor, delay, own, hand, error, jitter, seed] = a;
  const auto& [radius, theta, phi] = yoke;
  const auto& [peak, continuous, overload] = actuator;
  const auto& [offset, gain, resolution, range, noise] = sensor;
  const auto& [hand_mass, hand_damping, hand_stiffness, finger_mass, grip_damping, grip_stiffness] = hand;
  CHECK((radius == b.yoke.radius && theta == b.yoke.theta_limit && phi == b.yoke.phi_limit));
  check_equal(axis_x, b.axis_x, "axis_x");
  check_equal(axis_y, b.axis_y, "axis_y");
  CHECK((friction == b.coulomb_friction && counts == b.encoder_counts && delay == b.delay));
  CHECK((peak == b.actuator.peak_force && continuous == b.actuator.continuous_force));
  CHECK((overload == b.actuator.overload_time && offset == b.force_sensor.offset && gain == b.force_sensor.gain));
  CHECK((resolution == b.force_sensor.resolution_gw && range == b.force_sensor.range_gw));
  CHECK((noise == b.force_sensor.noise_gw && hand_mass == b.hand.mass && hand_damping == b.hand.damping));
  CHECK((finger_mass == b.hand.finger_mass && grip_damping == b.hand.grip_damping));
  CHECK((grip_stiffness == b.hand.grip_stiffness && hand_stiffness == b.hand.stiffness && error == b.model_error &&
         jitter == b.period_jitter));
  CHECK((own == b.device_wall_stiffness && seed == b.seed));
}

}  // namespace

TEST_CASE("default.toml lists the defaults of the structs, all of them") {
  const Preset preset = read_preset(presets + "default.toml");
  check_equal(preset.haptics, HapticConfig{}, "haptics");
  check_equal(preset.lever, SimulatedLeverConfig{});
}

TEST_CASE("a preset with only a name has the defaults") {
  const Preset preset = preset_of("");
  CHECK(preset.name == "Test");
  check_equal(preset.haptics, HapticConfig{}, "haptics");
  check_equal(preset.lever, SimulatedLeverConfig{});
}

TEST_CASE("paper.toml is the paper's wall as published: a bare spring, held for 10 ms, nothing limited") {
  const Preset preset = read_preset(presets + "paper.toml");
  CHECK(preset.haptics.rate == 100.0);
  CHECK(preset.haptics.tuning.wall_stiffness == 5000.0);
  CHECK(preset.haptics.tuning.wall_damping == 0.0);
  CHECK(preset.haptics.tuning.aisle_damping == 0.0);
  CHECK(preset.haptics.contact.hold == ContactHold::zero_order);
  CHECK(preset.haptics.contact.energy_control == EnergyControl::none);
  CHECK_FALSE(preset.haptics.contact.reversal_limiter);
  CHECK(preset.haptics.contact.allow_unstable);
  check_equal(preset.lever, SimulatedLeverConfig{});
  check_config(preset.haptics);
}

TEST_CASE("every number of a file reaches its field") {
  const SimulatedLeverConfig lever = preset_of(R"(
[lever]
encoder_counts_per_deg = 0
peak_force_n = 8
continuous_force_n = 6
overload_time_s = 2
coulomb_friction_n = 0.25
delay_cycles = 3
own_wall_stiffness_n_per_m = 900
hand = "0.2,4,300"
model_error = 0.05
period_jitter = 0.1
seed = 77
[lever.yoke]
radius_m = 0.2
theta_limit_deg = 30
phi_limit_deg = 20
[lever.axis_x]
mass_kg = 0.5
[lever.axis_y]
damping_n_s_per_m = 1.5
stiffness_n_per_m = 40
[lever.force_sensor]
offset = 1
gain_per_gw = 2
resolution_gw = 3
range_gw = 4
noise_gw = 5)")
                                         .lever;
  const double degree = YokeGeometry{}.theta_limit / 40.0;
  CHECK(lever.yoke.theta_limit == doctest::Approx(30.0 * degree).epsilon(1e-15));
  CHECK(lever.yoke.phi_limit == doctest::Approx(20.0 * degree).epsilon(1e-15));
  SimulatedLeverConfig expected{{0.2, lever.yoke.theta_limit, lever.yoke.phi_limit},
                                {0.5, 3.0, 14.8},
                                {0.086, 1.5, 40.0},
                                0.25,
                                0.0,
                                {8.0, 6.0, 2.0},
                                {1.0, 2.0, 3.0, 4.0, 5.0},
                                3,
                                900.0,
                                {0.2, 4.0, 300.0},
                                0.05,
                                0.1,
                                77};
  check_equal(lever, expected);

  const HapticConfig haptics = preset_of(R"(
[loop]
rate_hz = 2000
gear_debounce_s = 0.02
ghost_offset_m = 0.03
[tuning]
wall_stiffness_n_per_m = 1000
wall_damping_n_s_per_m = 1
feel_scale = 0.5
aisle_damping_n_s_per_m = 3
speed_limit_m_per_s = 0.4
limit_damping_n_s_per_m = 5
[contact]
hold = "observer"
energy_control = "energy_bounding"
reversal_limiter = false
study = true
[estimator]
smoothing_s = 0.002
speed_limit_m_per_s = 6
window_samples = 15
[guard]
slew_n_per_cycle = 7
ramp_time_s = 0.8
stale_time_s = 0.09
fade_time_s = 0.01
overruns_in_row = 11
damped_damping_n_s_per_m = 12
position_margin_m = 0.013
[over_push]
warn_above_n = 14
clear_below_n = 12)")
                                   .haptics;
  const HapticConfig wanted{2000.0,
                            {1000.0, 1.0, 0.5, 3.0, 0.4, 5.0},
                            {ContactHold::observer, EnergyControl::energy_bounding, false, true},
                            {0.002, 6.0, 15},
                            {7.0, 0.8, 0.09, 0.01, 11, 12.0, 0.013},
                            {14.0, 12.0},
                            0.02,
                            0.03};
  check_equal(haptics, wanted, "haptics");
  check_config(haptics);
}

TEST_CASE("hold, energy control and hand accept all their names") {
  const auto contact = [](const std::string& text) { return preset_of("[contact]\n" + text).haptics.contact; };
  CHECK(contact("hold = \"automatic\"").hold == ContactHold::automatic);
  CHECK(contact("hold = \"zero_order\"").hold == ContactHold::zero_order);
  CHECK(contact("hold = \"half_sample\"").hold == ContactHold::half_sample);
  CHECK(contact("energy_control = \"none\"").energy_control == EnergyControl::none);
  CHECK(contact("energy_control = \"passivity_controller\"").energy_control == EnergyControl::passivity_controller);
  for (const NamedHand& named : kNamedHands) {
    const HandImpedance hand = preset_of("[lever]\nhand = \"" + std::string(named.name) + "\"").lever.hand;
    CHECK((hand.mass == named.hand.mass && hand.stiffness == named.hand.stiffness));
  }
}

TEST_CASE("both ends of every range are accepted, and values beyond them are refused") {
  struct Row {
    const char *table, *key;
    double min, max;
  };
  // From the tuning guide and the files of the first version; for warn_above_n above the default of clear_below_n.
  constexpr Row kRows[] = {
      {"tuning", "wall_stiffness_n_per_m", 0, 20000},
      {"tuning", "wall_damping_n_s_per_m", 0, 100},
      {"tuning", "feel_scale", 0, 4},
      {"tuning", "aisle_damping_n_s_per_m", 0, 50},
      {"tuning", "speed_limit_m_per_s", 0.05, 5},
      {"tuning", "limit_damping_n_s_per_m", 0, 50},
      {"loop", "rate_hz", 100, 4000},
      {"loop", "gear_debounce_s", 0, 0.5},
      {"loop", "ghost_offset_m", 0, 1},
      {"estimator", "smoothing_s", 1e-5, 1},
      {"estimator", "speed_limit_m_per_s", 0.1, 1000},
      {"estimator", "window_samples", 1, 64},
      {"guard", "slew_n_per_cycle", 2, 100},
      {"guard", "ramp_time_s", 0.001, 60},
      {"guard", "stale_time_s", 0.001, 1},
      {"guard", "fade_time_s", 0.001, 1},
      {"guard", "damped_damping_n_s_per_m", 0, 50},
      {"guard", "position_margin_m", 0, 1},
      {"guard", "overruns_in_row", 1, 1000},
      {"over_push", "warn_above_n", 50, 1000},
      {"over_push", "clear_below_n", 0, 60},
      {"lever", "delay_cycles", 0, 8},
      {"lever", "coulomb_friction_n", 0, 1000},
      {"lever", "own_wall_stiffness_n_per_m", 0, 1e5},
      {"lever", "model_error", 0, 0.5},
      {"lever", "period_jitter", 0, 0.5},
      {"lever", "overload_time_s", 0, 1e4},
      {"lever.yoke", "radius_m", 0.01, 10},
      {"lever.yoke", "theta_limit_deg", 0.5, 80},
      {"lever.yoke", "phi_limit_deg", 0.5, 80},
      {"lever.axis_x", "mass_kg", 1e-3, 1e3},
      {"lever.axis_y", "damping_n_s_per_m", 0, 1e4},
      {"lever.axis_y", "stiffness_n_per_m", 0, 1e6},
      {"lever.force_sensor", "offset", -1e9, 1e9},
      {"lever.force_sensor", "gain_per_gw", 1e-9, 1e9},
      {"lever.force_sensor", "resolution_gw", 0, 1e6},
      {"lever.force_sensor", "range_gw", 1e-3, 1e9},
      {"lever.force_sensor", "noise_gw", 0, 1e6},
  };
  for (const Row& row : kRows) {
    CAPTURE(row.key);
    const auto sentence = [&](double value) {
      return refusal("[" + std::string(row.table) + "]\n" + row.key + " = " + toml_number(value) + "\n");
    };
    CHECK(sentence(row.min) == "accepted");
    CHECK(sentence(row.max) == "accepted");
    CHECK(sentence(row.max * 1.5 + 1.0).find("must be between") != std::string::npos);
    if (std::string_view(row.key) != "warn_above_n")
      CHECK(sentence(row.min - 0.5 * std::abs(row.min) - (row.min == 0.0 ? 1.0 : 0.0)).find("must be between") !=
            std::string::npos);
  }
}

TEST_CASE("invalid values are refused with line, key, value and range") {
  CHECK(refusal("[loop]\nrate_hz = 99\n") == "my.toml:3: rate_hz = 99: must be between 100 and 4000");
  CHECK(refusal("[loop]\nrate_hz = nan\n") == "my.toml:3: rate_hz = nan: must be between 100 and 4000");
  CHECK(refusal("[loop]\nrate_hz = \"fast\"\n") ==
        "my.toml:3: rate_hz = \"fast\": must be a number between 100 and 4000");
  CHECK(refusal("[loop]\nrate = 1000\n").find("my.toml:3: rate is not a known key; known keys: rate_hz") == 0);
  CHECK(refusal("[lever.axis_x]\nmass_g = 95\n").find("my.toml:3: mass_g is not a known key") == 0);
  CHECK(refusal("[device]\n").find("my.toml:2: device is not a known key; known keys: name, lever") == 0);
  CHECK(refusal("lever = 3\n") == "my.toml:2: lever = 3: must be a table: write [lever]");
  CHECK(refusal("[lever]\ndelay_cycles = 1.5\n") == "my.toml:3: delay_cycles = 1.5: must be a whole number");
  CHECK(refusal("[lever]\ndelay_cycles = 9\n") == "my.toml:3: delay_cycles = 9: must be between 0 and 8");
  CHECK(refusal("[lever]\nseed = -1\n").find("my.toml:3: seed = -1: must be between 0 and ") == 0);
  CHECK(refusal("[lever]\nencoder_counts_per_deg = 0.5\n") ==
        "my.toml:3: encoder_counts_per_deg = 0.5: must be 0 (no encoder) or at least 1");
  CHECK(
      refusal("[lever]\nhand = \"fist\"\n")
          .find(
              "my.toml:3: hand = \"fist\": must be bare, light, grip, arm, elastic, pinch or \"M,B,K\" up to 1000 kg, "
              "10000 N s/m and 1000000 N/m, followed by the fingers'") == 0);
  CHECK(refusal("[lever]\nhand = \"2000,1,1\"\n").find("my.toml:3: hand = \"2000,1,1\": must be") == 0);
  CHECK(refusal("[lever]\nmodel_error = 0.6\n") == "my.toml:3: model_error = 0.6: must be between 0 and 0.5");
  CHECK(refusal("[lever]\npeak_force_n = 5\n") ==
        "my.toml:2: continuous_force_n is missing: it must be a number between 0 and 5");
  CHECK(refusal("[over_push]\nwarn_above_n = 40\nclear_below_n = 45\n") ==
        "my.toml:4: clear_below_n = 45: must be between 0 and 40");
  CHECK(refusal("[contact]\nhold = \"first_order\"\n") ==
        "my.toml:3: hold = \"first_order\": must be one of automatic, zero_order, half_sample, observer");
  CHECK(refusal("[contact]\nstudy = 1\n") == "my.toml:3: study = 1: must be true or false");
  CHECK(refusal("[guard]\noverruns_in_row = 0\n") == "my.toml:3: overruns_in_row = 0: must be between 1 and 1000");
  CHECK_THROWS_AS(read_preset("/nowhere/preset.toml"), FileError);
}
