// Tests of reading car files. An invalid file must be rejected in one sentence with file, line and reason.
#include "app/vehicle/car_spec.h"

#include <algorithm>
#include <filesystem>
#include <set>
#include <stdexcept>
#include <string>

#include <doctest/doctest.h>

#include "app/vehicle/car_load.h"
#include "haptics/files/file_error.h"
#include "haptics/files/printable.h"
#include "tests/app/vehicle/cars.h"

using namespace gearshift::haptics;
using namespace gearshift::test;
using namespace gearshift::vehicle;

namespace {

struct Hostile {
  const char* file;
  const char* sentence;  // the expected message, without the file name
};

// The expected line numbers and reasons, written by hand from the files in tests/data/hostile_cars.
constexpr Hostile kHostile[] = {
    {"bite_beyond_pedal", ":37: bite_pedal = 1.2: must be between 0 and 1"},
    {"capacity_missing", ":35: capacity_nm is missing: it must be a number between 1 and 10000"},
    {"closed_above_bite", ":38: closed_pedal = 0.8: must be less than bite_pedal"},
    {"cone_and_a_half", ":57: cones = 1.5: must be a whole number"},
    {"cone_in_radians", ":56: cone_half_angle_deg = 0.113: must be between 3 and 20"},
    {"efficiency_above_one", ":64: efficiency = 1.1: must be between 0.5 and 1"},
    {"empty", ":1: title is missing: it must be text in quotes"},
    {"friction_below_zero", ":16: friction_nm = -1: must be between 0 and 5000"},
    {"gate_is_a_number", ":2: gate = 5: must be text in quotes"},
    {"gate_under_engine", ":1: gate is missing: it must be text in quotes"},
    {"half_a_tooth", ":61: teeth = 36.5: must be a whole number"},
    {"idle_above_shift", ":21: idle_rpm = 2100: must be less than shift_from_rpm"},
    {"idle_below_stall", ":25: stall_rpm = 350: must be less than idle_rpm"},
    {"inertia_nan", ":20: inertia_kgm2 = nan: must be between 0.01 and 10"},
    {"limiter_band_to_idle", ":28: limiter_band_rpm = 1000: must not exceed limiter_rpm minus idle_rpm"},
    {"lug_above_shift", ":33: lug_below_rpm = 2500: must be less than shift_to_rpm"},
    {"massless", ":66: mass_kg = 0: must be between 100 and 60000"},
    {"negative_reverse", ":48: ratio_r = -3.17: must be between 0.1 and 20"},
    {"no_engine", ":1: engine is missing: it must be a table, [engine]"},
    {"no_first_gear", ":42: ratio_1 is missing: it must be a number between 0.1 and 20"},
    {"no_friction", ":54: friction = 0: must be between 0.01 and 0.5"},
    {"no_title", ":1: title is missing: it must be text in quotes"},
    {"not_toml", ":35: not valid TOML: "},
    {"one_point",
     ":4: full_load = (a list): must have between 2 and 24 points, each { rpm = ..., nm = ... }, but has 1"},
    {"point_of_power", ":10: kw is not a known key; known keys: rpm, nm"},
    {"point_without_torque", ":10: nm is missing: it must be a number between 0 and 5000"},
    {"points_of_numbers", ":4: full_load must be a list of tables: write each as [[full_load]]"},
    {"ratio_gap", ":45: ratio_4 = 0.97: needs ratio_3, which is missing"},
    {"ratio_text", ":44: ratio_2 = \"35:18\": must be a number between 0.1 and 20"},
    {"ratios_rise", ":46: ratio_4 = 1.3: must be less than ratio_3"},
    {"red_line_above_limiter", ":26: red_line_rpm = 6500: must be less than limiter_rpm"},
    {"shift_above_red_line", ":32: shift_to_rpm = 6300: must be less than red_line_rpm"},
    {"shift_band_turned", ":31: shift_from_rpm = 2000: must be less than shift_to_rpm"},
    {"shudder_of_a_hammer", ":34: shudder_n = 300: must be between 0 and 10"},
    {"speeds_do_not_rise", ":9: rpm = 2000: must be greater than the rpm of the previous point"},
    {"starter_infinite", ":29: starter_nm = inf: must be between 1 and 1000"},
    {"tenth_gear", ":49: ratio_10 is not a known key; known keys: ratio_1"},
    {"title_with_escape", ":1: title = \"?[31mHostile\": must be one line without control characters"},
    {"too_many_points",
     ":4: full_load = (a list): must have between 2 and 24 points, each { rpm = ..., nm = ... }, but has 25"},
    {"torque_begins_late",
     ":4: full_load = (a list): must cover all speeds from idle_rpm to limiter_rpm, but covers only 1500 to 7000 rpm"},
    {"torque_stops_short",
     ":4: full_load = (a list): must cover all speeds from idle_rpm to limiter_rpm, but covers only 600 to 6000 rpm"},
    {"unknown_key", ":73: abs is not a known key; known keys: mass_kg"},
    {"unknown_table",
     ":74: turbo is not a known key; known keys: title, gate, speed_unit, engine, clutch, gearbox, synchro, body"},
    {"wheel_in_metres", ":68: wheel_radius_mm = 0.303: must be between 100 and 1000"},
};

constexpr const char* kFolder = GEARSHIFT_TEST_DATA "/hostile_cars";

std::string refusal(const std::filesystem::path& file) {
  try {
    read_car(file);
  } catch (const FileError& error) {
    return error.what();
  }
  return "not refused";
}

}  // namespace

TEST_CASE("every hostile car is rejected in one sentence with file, line and reason") {
  for (const Hostile& hostile : kHostile) {
    const std::filesystem::path file = std::filesystem::path(kFolder) / (std::string(hostile.file) + ".toml");
    const std::string sentence = refusal(file);
    CAPTURE(sentence);
    CHECK(sentence.find(file.string() + hostile.sentence) == 0);
    CHECK(is_printable(sentence));
  }
}

TEST_CASE("no hostile car is left untested") {
  std::set<std::string> expected, found;
  for (const Hostile& hostile : kHostile) expected.insert(hostile.file);
  for (const auto& entry : std::filesystem::directory_iterator(kFolder)) found.insert(entry.path().stem().string());
  CHECK(found == expected);
}

TEST_CASE("a missing file is rejected by name") {
  CHECK(refusal("no_such_car.toml").find("no_such_car.toml") == 0);
}

TEST_CASE("the hatchback is the car used for the other methods, in SI units") {
  const CarSpec car = shipped_car("hatchback");
  CHECK(car.name == "hatchback");
  CHECK(car.gate == "five_speed_r_right_down");
  CHECK(full_torque(car.engine, 4000.0 * kRpm) == doctest::Approx(145.0));
  CHECK(full_torque(car.engine, 6000.0 * kRpm) * 6000.0 * kRpm == doctest::Approx(74e3).epsilon(0.01));
  // Heywood: 97, 15 and 5 kPa times 1.6 l over 4 pi.
  CHECK(friction_torque(car.engine, 1000.0 * kRpm) == doctest::Approx(14.9).epsilon(0.002));
  CHECK(friction_torque(car.engine, 3000.0 * kRpm) == doctest::Approx(23.8).epsilon(0.002));
  CHECK(friction_torque(car.engine, 6000.0 * kRpm) == doctest::Approx(46.7).epsilon(0.002));
  CHECK(car.engine.idle == doctest::Approx(83.8).epsilon(0.001));
  CHECK(car.engine.idle_gain * 1000.0 * kRpm == doctest::Approx(3.0));
  CHECK(car.synchro.cone_angle == doctest::Approx(0.11345).epsilon(1e-4));
  CHECK(car.synchro.radius == doctest::Approx(0.03));
  CHECK(car.body.wheel_radius == doctest::Approx(0.3032));
  const double kmh_per_krpm[] = {8.1, 14.4, 21.7, 28.9, 36.8};  // [km/h] speed per 1000 rpm, computed by hand
  for (int gear = 1; gear <= 5; ++gear)
    CHECK(3.6 * road_speed_at(car, gear, 1000.0 * kRpm) == doctest::Approx(kmh_per_krpm[gear - 1]).epsilon(0.007));
  CHECK(shaft_per_road(car, 6) == 0.0);
}

TEST_CASE(
    "top speed: a long drive at full throttle on the level comes close to it and never beyond; the limiter ends it") {
  for (const std::string name : {"hatchback", "diesel"}) {
    CarSpec car = shipped_car(name);
    CAPTURE(name);
    double best = 0.0;
    for (int gear = 3; gear <= (name == "diesel" ? 6 : 5); ++gear) {
      Driveline line(car);
      const double start = 0.9 * top_speed(car), shaft = shaft_per_road(car, gear) * start;
      if (shaft > car.engine.limiter) continue;
      line.place(shaft, shaft, start, true);
      DrivelineInput in;
      in.pedals.throttle = 1.0;
      in.meshed = gear;
      for (int i = 0; i < 400000; ++i) line.step(in, 0.001);
      best = std::max(best, line.state().road_speed);
    }
    CHECK(top_speed(car) == doctest::Approx(best).epsilon(0.005));
    car.body.resistance = car.body.resistance_slope = car.body.resistance_square = 0.0;
    const int highest = name == "diesel" ? 6 : 5;
    CHECK(top_speed(car) == doctest::Approx(road_speed_at(car, highest, car.engine.limiter)).epsilon(0.1));
  }
}

TEST_CASE("a car shows km/h unless its file says mph; any other unit is refused") {
  const CarSpec metric = shipped_car("hatchback");
  CHECK(metric.speed_unit == SpeedUnit::km_per_h);
  const auto with = [&](const std::string& line) { return parse_car(line + metric.text, "car.toml"); };
  CHECK(with("speed_unit = \"mph\"\n").speed_unit == SpeedUnit::mph);
  CHECK(with("speed_unit = \"km/h\"\n").speed_unit == SpeedUnit::km_per_h);
  CHECK_THROWS_AS(with("speed_unit = \"knots\"\n"), FileError);
  CHECK(in_unit(SpeedUnit::mph, 1609.344 / 36.0) == doctest::Approx(100.0));  // a mile in 36 s
}

TEST_CASE("every shipped car fits its gate, and its rings block") {
  int cars = 0;
  for (const auto& entry : std::filesystem::directory_iterator(GEARSHIFT_ASSETS "/cars")) {
    if (entry.path().extension() != ".toml") continue;
    CAPTURE(entry.path());
    ++cars;
    const CarSpec car = read_car(entry.path());
    CHECK_NOTHROW(check_car_fits(car, gate_of(car)));
    CHECK(critical_friction(car.synchro) < car.synchro.friction);
    CHECK(car.clutch.capacity > 1.5 * full_torque(car.engine, 2000.0 * kRpm));
  }
  CHECK(cars == 2);
}

TEST_CASE("a gate with a gear that the car lacks is rejected when they are combined") {
  const CarSpec car = shipped_car("hatchback");
  const Gate six = shipped_gate("six_speed_r_left_up");
  const std::string sentence = "this gate has a gear 6, but the car \"hatchback\" does not";
  CHECK_THROWS_WITH_AS(CarLoad(car, six, kPaperForce), sentence.c_str(), std::invalid_argument);
  // This gate has no fifth gear, which is allowed.
  CHECK_NOTHROW(CarLoad(car, shipped_gate("four_speed"), kPaperForce));
  CHECK_THROWS_AS(CarLoad(car, gate_of(car), 0.0), std::invalid_argument);
}
