// Tests of the valid ranges of the haptic parameters, and of how a device limits them.
#include "haptics/loop/haptic_config.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <initializer_list>
#include <limits>
#include <set>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>

#include <doctest/doctest.h>

#include "haptics/analysis/sampled_loop.h"
#include "haptics/contact/lever_estimator.h"
#include "haptics/contact/virtual_coupling.h"
#include "haptics/device/hand.h"
#include "haptics/gate/gate_feel.h"
#include "haptics/gate/plain_aisle.h"
#include "tests/support/gates.h"
#include "tests/support/whole_campaign.h"

using namespace gearshift::haptics;
using namespace gearshift::test;

namespace {

std::string refusal(const HapticConfig& config) {
  try {
    check_config(config);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE("a config out of range is refused with parameter, value and range") {
  CHECK(refusal({}).empty());
  HapticConfig config;
  config.rate = 4001.0;
  for (const char* part : {"rate_hz", "4001", "100", "4000"}) {
    CHECK(refusal(config).find(part) != std::string::npos);
  }
  config = {};
  config.tuning.wall_stiffness = std::numeric_limits<double>::quiet_NaN();
  CHECK(refusal(config).find("wall_stiffness_n_per_m") != std::string::npos);
  config = {};
  config.guard.slew = 1.9;  // [N/cycle] below 2, the wall force rises so slowly that the lever swings
  CHECK(refusal(config).find("slew_n_per_cycle = 1.9: must be between 2 and 100") != std::string::npos);
  config = {};
  config.guard.fade_time = 0.0;
  CHECK(refusal(config).find("fade_time_s") != std::string::npos);
  config = {};
  config.over_push.clear_below = 61.0;  // [N] above `warn_above` (60 N), so there would be no hysteresis
  CHECK(refusal(config).find("clear_below_n") != std::string::npos);
}

namespace {

AdmittedTuning admitted(const HapticTuning& wanted, double rate, int delay, ContactHold hold = ContactHold::automatic) {
  HapticConfig config;
  config.rate = rate;
  config.tuning = wanted;
  config.contact.hold = hold;
  DeviceSpec spec;
  spec.delay = delay;
  return admit_tuning(config, spec, paper_feel());
}

}  // namespace

TEST_CASE("quiet: K <= 0.25 m / tau^2 (observer 0.58), B <= 0.35 m / tau (observer 0.7), tau = (delay + 1) T") {
  HapticTuning wanted;
  wanted.wall_stiffness = 20000.0;
  wanted.wall_damping = 100.0;
  wanted.aisle_damping = 50.0;
  wanted.limit_damping = 50.0;
  for (const double rate : {100.0, 200.0, 500.0, 1000.0, 4000.0}) {
    for (const int delay : {0, 1, 3}) {
      for (const ContactHold hold : {ContactHold::half_sample, ContactHold::observer}) {
        const double tau = (delay + 1) / rate, factor = hold == ContactHold::observer ? 0.58 : 0.25;
        const AdmittedTuning found = admitted(wanted, rate, delay, hold);
        const HapticTuning& used = found.tuning;
        CHECK(used.wall_stiffness <= std::min(20000.0, factor * 0.086 / (tau * tau)) * (1.0 + 1e-12));
        if (found.hold == ContactHold::observer) CHECK(used.wall_damping == doctest::Approx(0.7 * 0.086 / tau));
        if (found.hold == ContactHold::half_sample)
          CHECK(used.wall_damping == doctest::Approx(std::min(100.0, 0.35 * 0.086 / tau)));
        CHECK(used.aisle_damping == doctest::Approx(std::min(50.0, 0.35 * 0.086 / tau)));
        CHECK(used.limit_damping == doctest::Approx(std::min(50.0, 0.35 * 0.086 / tau)));
      }
    }
  }
}

TEST_CASE("quiet on a device's springs: K <= 0.5 m / tau^2 above springs of m / tau^2, 0.58 m / tau^2 below") {
  DeviceSpec spec;
  spec.delay = 5;
  const double unit = 0.086 / (0.006 * 0.006);  // 2389 N/m
  HapticConfig config;
  for (const auto& [own, factor] : {std::pair{1000.0, 0.58}, {2300.0, 0.58}, {2500.0, 0.5}, {3000.0, 0.5}}) {
    spec.device_wall_stiffness = {own, own};
    const AdmittedTuning found = admit_tuning(config, spec, paper_feel());
    CHECK(found.hold == ContactHold::observer);
    CHECK(found.tuning.wall_stiffness == doctest::Approx(own + factor * unit));
  }
}

TEST_CASE(
    "automatic: the observer is used where delay or rate keep the half-sample hold from the wanted stiffness, up to "
    "12.5 ms") {
  CHECK(admitted({}, 1000.0, 0).hold == ContactHold::half_sample);
  CHECK(admitted({}, 1000.0, 1).hold == ContactHold::half_sample);
  CHECK(admitted({}, 1000.0, 2).hold == ContactHold::observer);
  CHECK(admitted({}, 1000.0, 2).tuning.wall_stiffness == 5000.0);
  CHECK(admitted({}, 1000.0, 2).tuning.wall_damping == doctest::Approx(0.7 * 0.086 / 0.003));
  CHECK(admitted({}, 1000.0, 3).hold == ContactHold::observer);
  CHECK(admitted({}, 1000.0, 8).hold == ContactHold::observer);
  CHECK(admitted({}, 500.0, 1).hold == ContactHold::observer);
  CHECK(admitted({}, 500.0, 0).hold == ContactHold::half_sample);
  CHECK(admitted({}, 100.0, 0).hold == ContactHold::observer);
  CHECK(admitted({}, 100.0, 1).hold == ContactHold::half_sample);  // 20 ms
}

TEST_CASE(
    "every admitted tuning is stable: in the wall, in every softer wall, in free space, slow and fast, with each "
    "hand") {
  HapticTuning damped;
  damped.wall_stiffness = 20000.0;
  damped.wall_damping = 100.0;
  damped.aisle_damping = 50.0;
  damped.limit_damping = 50.0;
  std::set<std::tuple<ContactHold, double, double, double, int, double>> seen;  // skips duplicates
  const auto check = [&seen](ContactHold as, double stiffness, double damping, double free, int delay, double rate) {
    if (!seen.insert({as, stiffness, damping, free, delay, rate}).second) return;
    const ContactLaw law{as, stiffness, damping, 1, free, 0.004, delay};
    for (const NamedHand& named : kNamedHands)
      for (const AxisModel& axis : {kPaperAxisX, kPaperAxisY})
        CHECK(spectral_radius(axis, named.hand, law, 1.0 / rate) < 1.0);
  };
  for (const HapticTuning& wanted : {HapticTuning{}, damped}) {
    for (const double rate : {100.0, 200.0, 500.0, 1000.0, 2000.0, 4000.0}) {
      for (int delay = 0; delay <= 8; delay += is_full_campaign() ? 1 : 2) {
        for (const ContactHold hold : {ContactHold::zero_order, ContactHold::half_sample, ContactHold::observer}) {
          const AdmittedTuning used = admitted(wanted, rate, delay, hold);
          const HapticTuning& t = used.tuning;
          for (const double fraction : {1.0, 0.75, 0.5, 0.1}) {
            const double stiffness = fraction * t.wall_stiffness;
            check(used.hold, stiffness, t.wall_damping, t.aisle_damping, delay, rate);
            check(used.hold, stiffness, t.wall_damping, t.aisle_damping + t.limit_damping, delay, rate);
          }
          check(ContactHold::zero_order, 0.0, 0.0, t.aisle_damping + t.limit_damping, delay, rate);
        }
      }
    }
  }
}

namespace {

constexpr double kFineStep = 74.5e-6, kCoarseStep = 419e-6;  // [m] 28 and 5 counts per degree at 120 mm

AdmittedTuning admitted_on(double step, const HapticConfig& config, int delay = 0) {
  DeviceSpec spec;
  spec.delay = delay;
  spec.position_step = step;
  return admit_tuning(config, spec, paper_feel());
}

std::string limits_text(const AdmittedTuning& admitted) {
  std::string text;
  for (const TuningLimit& limit : admitted.limits) text += describe(limit) + "\n";
  return text;
}

// Change of the damping force [N] in the cycle in which the encoder of a resting lever, 2 mm deep in a wall, counts on.
// `free`: change of the damping that acts everywhere.
struct CountForce {
  double wall = 0.0, free = 0.0;
};
CountForce count_force(const HapticConfig& config, const HapticTuning& tuning, double step) {
  const Gate gate = plain_aisle(0.060, 0.030);
  const double period = period_s(config);
  LeverEstimator estimator(config.estimator, period, step);
  LeverReading reading;
  reading.position = {0.062, 0.0};
  LeverMotion motion;
  const auto read = [&] {
    ++reading.sequence;
    reading.time_ns += period_ns(config);
    motion = estimator.update(reading);
  };
  const auto force = [&](double damping) {
    const Coupling coupling{tuning.wall_stiffness, damping, period, 0, ContactHold::half_sample};
    const Proxy proxy = place_proxy(gate, {0.060, 0.0});
    return -contact_force(coupling, gate, open_passage(gate), proxy, motion).force.x;
  };
  for (int i = 0; i < kMaxWindow + 1; ++i) read();
  reading.position.x += step;
  read();
  return {force(tuning.wall_damping) - force(0.0),
          std::max(tuning.aisle_damping, tuning.limit_damping) * motion.smooth_velocity.x};
}

}  // namespace

TEST_CASE("resolution: one encoder count changes a damping force by at most 3 N, as estimator and coupling make it") {
  for (const double rate : {250.0, 1000.0, 4000.0}) {
    for (const double step : {10e-6, kFineStep, kCoarseStep}) {
      for (const double smoothing : {1e-5, 0.004, 1.0}) {
        HapticConfig config;
        config.rate = rate;
        config.estimator.smoothing = smoothing;
        config.contact.hold = ContactHold::half_sample;
        config.tuning.wall_damping = 100.0;
        config.tuning.aisle_damping = config.tuning.limit_damping = 50.0;
        CAPTURE(rate);
        CAPTURE(step);
        CAPTURE(smoothing);
        const HapticTuning used = admitted_on(step, config).tuning;
        const CountForce found = count_force(config, used, step);
        CHECK(found.wall == doctest::Approx(used.wall_damping * step * rate));  // closed form B q / T
        CHECK(found.wall <= 3.0 + 1e-9);
        CHECK(found.free <= 3.0 + 1e-9);
        CHECK(used.wall_damping == doctest::Approx(std::min({100.0, 0.35 * 0.086 * rate, 3.0 / (step * rate)})));
      }
    }
  }
  // A longer window divides the step, but is allowed only with allow_unstable.
  HapticConfig config;
  config.estimator.window = 8;
  CHECK(count_force(config, config.tuning, kFineStep).wall == doctest::Approx(10.0 * kFineStep * 1000.0 / 8.0));
}

TEST_CASE("resolution: 100 N s/m at 4 kHz and an encoder of 5 counts per degree are limited, and the law is named") {
  HapticConfig fast;
  fast.rate = 4000.0;
  CHECK(admitted_on(kFineStep, fast).limits.empty());  // the shipped tuning: B q / T = 2.98 N
  fast.tuning.wall_damping = 100.0;
  CHECK(limits_text(admitted_on(kFineStep, fast)) ==
        "wall_damping_n_s_per_m limited from 100 to 10.0671 (one encoder count q changes the damping force by at most "
        "3 N if B <= 3 N T / q)\n");
  for (const double rate : {250.0, 500.0, 1000.0, 2000.0, 4000.0}) {
    for (const int delay : {0, 1, 3}) {
      CAPTURE(rate);
      CAPTURE(delay);
      HapticConfig config;
      config.rate = rate;
      CHECK(limits_text(admitted_on(kFineStep, config, delay)).find("count") == std::string::npos);
      const AdmittedTuning coarse = admitted_on(kCoarseStep, config, delay);
      CHECK(coarse.hold == ContactHold::half_sample);
      CHECK(coarse.tuning.wall_stiffness <= std::min(0.2 * 0.086 * std::pow(rate / (delay + 1), 2.0),
                                                     0.086 * std::pow(0.1 / (3.0 * kCoarseStep), 2.0)) *
                                                (1.0 + 1e-12));
    }
  }
  CHECK(limits_text(admitted_on(kCoarseStep, {})).find("the encoder resolves a contact at 0.1 m/s") !=
        std::string::npos);
}

TEST_CASE("resolution: an observer that is asked for on a coarse encoder is replaced, and the reason is given") {
  HapticConfig config;
  config.contact.hold = ContactHold::observer;
  CHECK(admitted_on(kFineStep, config, 3).hold == ContactHold::observer);
  const AdmittedTuning coarse = admitted_on(kCoarseStep, config, 3);
  CHECK(coarse.hold == ContactHold::half_sample);
  CHECK(
      limits_text(coarse).find("hold limited from observer to half_sample (with the observer hold, one encoder count q "
                               "changes the velocity by more than 0.125 m/s)") != std::string::npos);
}

TEST_CASE("slew: K <= S / (T 1 m/s), so that the force follows a contact at 1 m/s") {
  HapticConfig config;
  config.guard.slew = 2.0;
  CHECK(
      limits_text(admitted_on(kFineStep, config))
          .starts_with("wall_stiffness_n_per_m limited from 5000 to 2000 (the slew limit S per cycle follows a contact "
                       "at 1 m/s only if K <= S / (T 1 m/s))\n"));
  config.rate = 500.0;
  CHECK(admitted_on(kFineStep, config).tuning.wall_stiffness == doctest::Approx(1000.0));
  config.rate = 4000.0;
  CHECK(admitted_on(kFineStep, config).limits.empty());
}

TEST_CASE("options that need allow_unstable are refused without it") {
  HapticConfig config;
  config.estimator.window = 15;
  CHECK_THROWS_WITH_AS(admit_tuning(config, {}, paper_feel()), doctest::Contains("window"), std::invalid_argument);
  config = {};
  config.contact.reversal_limiter = false;
  CHECK_THROWS_WITH_AS(admit_tuning(config, {}, paper_feel()), doctest::Contains("limiter"), std::invalid_argument);
  config = {};
  config.contact.energy_control = EnergyControl::passivity_controller;
  CHECK_THROWS_WITH_AS(admit_tuning(config, {}, paper_feel()), doctest::Contains("passivity"), std::invalid_argument);
  config.contact.energy_control = EnergyControl::energy_bounding;
  CHECK_NOTHROW(admit_tuning(config, {}, paper_feel()));
}

TEST_CASE("a device with invalid properties is refused") {
  const auto refused = [](auto spoil) {
    DeviceSpec spec;
    spoil(spec);
    CHECK_THROWS_AS(check_device(spec), std::invalid_argument);
  };
  CHECK_NOTHROW(check_device({}));
  refused([](DeviceSpec& s) { s.max_force.y = -5.0; });
  refused([](DeviceSpec& s) { s.max_force.x = std::numeric_limits<double>::quiet_NaN(); });
  refused([](DeviceSpec& s) { s.continuous_force.x = 1e9; });
  refused([](DeviceSpec& s) { s.workspace.y = -0.1; });
  refused([](DeviceSpec& s) { s.yoke_radius = -0.12; });
  refused([](DeviceSpec& s) { s.position_step = -1e-5; });
  refused([](DeviceSpec& s) { s.device_wall_stiffness.x = -1.0; });
  refused([](DeviceSpec& s) { s.device_wall_stiffness.y = std::numeric_limits<double>::quiet_NaN(); });
  refused([](DeviceSpec& s) { s.delay = 16; });
  refused([](DeviceSpec& s) { s.delay = -1; });
  refused([](DeviceSpec& s) { s.axis_x.mass = 0.0; });
  refused([](DeviceSpec& s) { s.axis_y.damping = -1.0; });
  refused([](DeviceSpec& s) { s.axis_y.stiffness = std::numeric_limits<double>::infinity(); });
}

TEST_CASE("a textbook spring's bound is below the exact boundary, and the limiting hand is named") {
  HapticConfig spring;
  spring.contact = {ContactHold::zero_order, EnergyControl::none, true, true};
  spring.tuning.wall_stiffness = 20000.0;
  spring.tuning.wall_damping = 0.0;
  spring.tuning.aisle_damping = 0.0;
  DeviceSpec spec;
  spec.simulated = true;
  const AdmittedTuning used = admit_tuning(spring, spec, paper_feel());
  // The exact limit of the bare handle is 2 b / T + 32 N/m, with damping b and period T: 6032 N/m on the X axis
  // (stability_table_test.cpp) and 5832 N/m on the Y axis. The lower one, divided by the gain margin of 1.1, is the
  // limit.
  const auto is_wall = [](const TuningLimit& one) { return one.parameter == &HapticTuning::wall_stiffness; };
  const auto wall = std::find_if(used.limits.begin(), used.limits.end(), is_wall);
  REQUIRE(wall != used.limits.end());
  CHECK(wall->hand == "bare");
  CHECK(wall->wanted == 20000.0);
  CHECK(wall->bound == doctest::Approx(5832.0 / 1.1).epsilon(0.001));
}

TEST_CASE("least damping: B >= K (q / (0.08 m/s) + 0.1 tau), and (2 delay + 1) T more with the zero-order hold") {
  constexpr double kMass = 0.086;
  for (const auto& timing : {std::pair{4000.0, 0}, {4000.0, 8}, {1000.0, 0}, {1000.0, 4}, {500.0, 1}, {100.0, 0}}) {
    const double rate = timing.first;
    const int delay = timing.second;
    for (const ContactHold hold : {ContactHold::half_sample, ContactHold::zero_order}) {
      CAPTURE(rate);
      CAPTURE(delay);
      CAPTURE(to_string(hold));
      HapticConfig config;
      config.rate = rate;
      config.contact.hold = hold;
      config.tuning.wall_stiffness = 20000.0;
      config.tuning.wall_damping = 0.0;
      const double tau = (delay + 1) / rate, held = hold == ContactHold::zero_order ? (2 * delay + 1) / rate : 0.0;
      const double time = kFineStep / 0.08 + 0.1 * tau + held;
      const AdmittedTuning none = admitted_on(kFineStep, config, delay);
      CHECK(none.tuning.wall_damping == doctest::Approx(none.tuning.wall_stiffness * time));
      CHECK(none.tuning.wall_damping <= std::min(0.35 * kMass / tau, 3.0 / (kFineStep * rate)) * (1.0 + 1e-9));
      CHECK(limits_text(none).find("wall_damping_n_s_per_m raised from 0 to ") != std::string::npos);
      CHECK(limits_text(none).find("gains energy from the encoder's count q") != std::string::npos);
      config.tuning.wall_stiffness = 100.0;  // so soft that the usual damping suffices, if the lag allows so much
      config.tuning.wall_damping = 2.0;
      CHECK(admitted_on(kFineStep, config, delay).tuning.wall_damping == 2.0);
    }
  }
  // The observer hold has a damping of its own, and a study uses what is wanted.
  HapticConfig config;
  config.tuning.wall_damping = 0.0;
  CHECK(admitted_on(kFineStep, config, 2).tuning.wall_damping == doctest::Approx(0.7 * kMass / 0.003));
  config.contact.allow_unstable = true;
  DeviceSpec spec;
  spec.simulated = true;
  spec.position_step = kFineStep;
  const AdmittedTuning study = admit_tuning(config, spec, paper_feel());
  CHECK(study.tuning == config.tuning);
  CHECK(limits_text(study).find("wall_damping_n_s_per_m 0 used anyway; the limit is 5.15625") != std::string::npos);
}

TEST_CASE("a lag above 15 ms is said to add energy to an impact, whatever the wall") {
  const auto text = [](double rate, int delay) {
    HapticConfig config;
    config.rate = rate;
    return limits_text(admitted_on(kFineStep, config, delay));
  };
  CHECK(text(200.0, 2).find("above 15 ms") == std::string::npos);  // 15 ms
  CHECK(text(100.0, 1).find("above 15 ms an impact gains energy anyway") != std::string::npos);
}

TEST_CASE("the default is admitted unchanged at 1 kHz; at 100 Hz every limited parameter is reported") {
  CHECK(admitted({}, 1000.0, 0).limits.empty());
  const AdmittedTuning slow = admitted({}, 100.0, 0);
  REQUIRE(slow.limits.size() >= 2);
  for (const TuningLimit& limited : slow.limits) {
    CHECK(limited.used < limited.wanted);
    CHECK(limited.used == limited.bound);
    CHECK_FALSE(limited.law.empty());
  }
}

TEST_CASE("allow_unstable uses the wanted values, still reports what is not stable, and is refused on real devices") {
  HapticConfig config;
  config.rate = 100.0;
  config.contact.allow_unstable = true;
  config.contact.hold = ContactHold::zero_order;
  DeviceSpec spec;
  CHECK_THROWS_WITH_AS(admit_tuning(config, spec, paper_feel()), doctest::Contains("study"), std::invalid_argument);
  spec.simulated = true;
  const AdmittedTuning used = admit_tuning(config, spec, paper_feel());
  CHECK(used.tuning == config.tuning);
  REQUIRE_FALSE(used.limits.empty());
  for (const TuningLimit& limited : used.limits) CHECK(limited.used == limited.wanted);
}

TEST_CASE("the limits that allow_unstable reports are those without it") {
  for (const double rate : {100.0, 250.0, 1000.0}) {
    HapticConfig config;
    config.rate = rate;
    config.contact.hold = ContactHold::zero_order;
    config.tuning.wall_damping = 20.0;
    DeviceSpec spec;
    spec.simulated = true;
    spec.delay = 1;
    const AdmittedTuning limited = admit_tuning(config, spec, paper_feel());
    config.contact.allow_unstable = true;
    const AdmittedTuning used = admit_tuning(config, spec, paper_feel());
    const auto stiffness_limit = [](const AdmittedTuning& admitted) {
      for (const TuningLimit& one : admitted.limits)
        if (one.parameter == TuningParameter(&HapticTuning::wall_stiffness)) return one.bound;
      return 0.0;
    };
    CAPTURE(rate);
    REQUIRE(stiffness_limit(limited) > 0.0);
    CHECK(stiffness_limit(used) <= stiffness_limit(limited) * (1.0 + 1e-12));
  }
}

TEST_CASE("the feel is no stiffer than the wall that carries the proxy") {
  HapticTuning wanted;
  wanted.feel_scale = 4.0;
  const HapticTuning used = admitted(wanted, 1000.0, 0).tuning;
  CHECK(used.feel_scale * paper_feel() <= used.wall_stiffness * (1.0 + 1e-12));
}

namespace {

// Stiffness of a spring whose force comes `lag` [s] late, at which a bare lever just keeps swinging [N/m]. At the angular
// frequency w, with the late damping B smoothed over Ts: -m w^2 + j w b + (K + j w B / (1 + j w Ts)) e^(-j w lag) = 0.
double swinging_stiffness(const AxisModel& lever, double damping, double smoothing, double lag) {
  const auto stiffness = [&](double w) {
    const std::complex<double> j(0.0, 1.0), s = j * w;
    return (lever.mass * w * w - s * lever.damping) * std::exp(s * lag) - s * damping / (1.0 + s * smoothing);
  };
  double low = 1e-3, high = 1.5 / lag;  // [rad/s] the imaginary part is negative at `low`
  while (high - low > 1e-9 * high) {
    const double mid = 0.5 * (low + high);
    (stiffness(mid).imag() < 0.0 ? low : high) = mid;
  }
  return stiffness(low).real();
}

}  // namespace

TEST_CASE("feel: outside the walls only the free damping acts, so a late feel is softer than the wall") {
  HapticConfig config;
  config.contact.hold = ContactHold::zero_order;
  config.tuning.feel_scale = 4.0;
  DeviceSpec spec;
  for (const double rate : {250.0, 350.0, 500.0, 1000.0}) {
    for (const int delay : {1, 2, 3, 8}) {
      CAPTURE(rate);
      CAPTURE(delay);
      config.rate = rate;
      spec.delay = delay;
      const AdmittedTuning used = admit_tuning(config, spec, paper_feel());
      const double feel = used.tuning.feel_scale * paper_feel();
      // A held force comes half a period late on average.
      const auto swings_at = [&](const AxisModel& axis) {
        return swinging_stiffness(axis, used.tuning.aisle_damping, config.estimator.smoothing,
                                  (delay + 0.5) * period_s(config));
      };
      const double swings = std::min(swings_at(spec.axis_x), swings_at(spec.axis_y));
      CHECK(feel <= swings / 1.05);
      if (feel < used.tuning.wall_stiffness * (1.0 - 1e-9)) {
        CHECK(feel == doctest::Approx(swings / 1.1).epsilon(0.03));
        CHECK(limits_text(used).find("1.1 times the gate's stiffest force") != std::string::npos);
      }
    }
  }
}

namespace {

AdmittedTuning admitted_with_device_walls(double own, double wanted, int delay,
                                          ContactHold hold = ContactHold::automatic) {
  HapticConfig config;
  config.tuning.wall_stiffness = wanted;
  config.contact.hold = hold;
  DeviceSpec spec;
  spec.delay = delay;
  spec.device_wall_stiffness = {own, own};
  return admit_tuning(config, spec, paper_feel());
}

const TuningLimit* limit_of(TuningParameter what, const AdmittedTuning& admitted) {
  for (const TuningLimit& limited : admitted.limits)
    if (limited.parameter == what) return &limited;
  return nullptr;
}
const TuningLimit* limit_of_wall(const AdmittedTuning& admitted) {
  return limit_of(&HapticTuning::wall_stiffness, admitted);
}

// A device with the given delay and a damper of `own` [N s/m].
DeviceSpec damping_itself(double own, int delay) {
  DeviceSpec spec;
  spec.delay = delay;
  spec.device_wall_damping = {own, own + 1.0};  // the weaker of the two axes decides
  return spec;
}
AdmittedTuning admitted_with(const DeviceSpec& spec, double damping, ContactHold hold) {
  HapticConfig config;
  config.tuning.wall_damping = damping;
  config.contact.hold = hold;
  return admit_tuning(config, spec, paper_feel());
}

}  // namespace

TEST_CASE("the loop does not render the device's part of a wall: wanted minus device part, never negative") {
  DeviceSpec spec;
  spec.device_wall_stiffness = {400.0, 500.0};
  const HapticTuning wanted{.wall_stiffness = 1000.0};
  CHECK(loop_stiffness(wanted, spec) == 600.0);  // the device's axis with the smaller stiffness decides
  CHECK(loop_stiffness({.wall_stiffness = 300.0}, spec) == 0.0);
  spec.device_wall_stiffness.x = 0.0;
  CHECK(loop_stiffness(wanted, spec) == 1000.0);

  // Without delay the full stiffness is admitted, as the sum of the loop's and the device's parts.
  const AdmittedTuning prompt = admitted_with_device_walls(1000.0, 5000.0, 0);
  CHECK(prompt.tuning.wall_stiffness == 5000.0);
  CHECK(limit_of_wall(prompt) == nullptr);
}

TEST_CASE(
    "where the loop cannot render the rest, the wall is the loop's part plus the device's, and the limit is reported") {
  const double quiet = 0.25 * 0.086 / 16e-6;  // 16e-6 = (4 ms)^2: 3 samples of delay plus one period
  const AdmittedTuning used = admitted_with_device_walls(400.0, 5000.0, 3, ContactHold::half_sample);
  CHECK(used.tuning.wall_stiffness == doctest::Approx(quiet + 400.0));
  const TuningLimit* wall = limit_of_wall(used);
  REQUIRE(wall != nullptr);
  CHECK(wall->wanted == 5000.0);
  CHECK(wall->used == used.tuning.wall_stiffness);
  CHECK(wall->bound == used.tuning.wall_stiffness);
  CHECK(wall->law ==
        "the half-sample hold is quiet only if K <= 0.25 m / tau^2, with tau = (delay + 1) T; the device itself "
        "renders another 400 N/m");
  // If loop and device together reach the wanted wall stiffness, nothing is limited, and the half-sample hold is
  // sufficient.
  const AdmittedTuning both = admitted_with_device_walls(1000.0, quiet + 900.0, 3);
  CHECK(both.tuning.wall_stiffness == quiet + 900.0);
  CHECK(limit_of_wall(both) == nullptr);
  CHECK(both.hold == ContactHold::half_sample);
}

TEST_CASE(
    "on device springs k > 0.35 m / tau^2, the observer renders the rest of a wall, or no part of the loop does") {
  for (const int delay : {2, 5, 8}) {
    CAPTURE(delay);
    const double unit = 0.086 / std::pow(0.001 * (delay + 1), 2.0), slow = 0.34 * unit, fast = 0.36 * unit, rest = 50.0;
    CHECK(admitted_with_device_walls(slow, slow + rest, delay).hold == ContactHold::half_sample);
    CHECK(admitted_with_device_walls(fast, fast + rest, delay).hold == ContactHold::observer);
    const AdmittedTuning loop = admitted_with_device_walls(slow, slow + rest, delay, ContactHold::half_sample);
    CHECK(loop.tuning.wall_stiffness == slow + rest);
    CHECK(loop.tuning.wall_damping > 0.0);
    const AdmittedTuning none = admitted_with_device_walls(fast, fast + rest, delay, ContactHold::half_sample);
    CHECK(none.tuning.wall_stiffness == doctest::Approx(fast));
    CHECK(none.tuning.wall_damping == 0.0);
    CHECK(limits_text(none).find("if k tau^2 > 0.35 m") != std::string::npos);
    const AdmittedTuning held =
        admitted_with_device_walls(0.16 * unit, 0.16 * unit + rest, delay, ContactHold::zero_order);
    CHECK(held.tuning.wall_stiffness == doctest::Approx(0.16 * unit));
    CHECK(limits_text(held).find("if k tau^2 > 0.15 m") != std::string::npos);
  }
}

TEST_CASE("the loop renders the rest of a wall's damping; with the device's part it exceeds the loop's own limit") {
  const double quiet = 0.35 * 0.086 / 0.006;  // [N s/m] 5.0, for 5 samples of delay plus one period at 1 kHz
  const DeviceSpec weak = damping_itself(3.0, 5), strong = damping_itself(20.0, 5), none = damping_itself(0.0, 5);
  const AdmittedTuning loop_only = admitted_with(none, 10.0, ContactHold::half_sample);
  CHECK(loop_only.tuning.wall_damping == doctest::Approx(quiet));

  const AdmittedTuning both = admitted_with(weak, 10.0, ContactHold::half_sample);
  CHECK(both.tuning.wall_damping == doctest::Approx(quiet + 3.0));
  CHECK(contact_law({}, both, weak).damping == doctest::Approx(quiet));
  const TuningLimit* limit = limit_of(&HapticTuning::wall_damping, both);
  REQUIRE(limit != nullptr);
  CHECK(limit->wanted == 10.0);
  CHECK(limit->used == both.tuning.wall_damping);
  CHECK(limit->law ==
        "damping by a sampled velocity is quiet only if B <= 0.35 m / tau, with tau = (delay + 1) T; the device itself "
        "renders "
        "another 3 N s/m");

  const AdmittedTuning device_only = admitted_with(strong, 10.0, ContactHold::half_sample);
  CHECK(device_only.tuning.wall_damping == 10.0);
  CHECK(contact_law({}, device_only, strong).damping == 0.0);
  CHECK(limit_of(&HapticTuning::wall_damping, device_only) == nullptr);

  const AdmittedTuning observed = admitted_with(damping_itself(20.0, 3), 10.0, ContactHold::observer);
  REQUIRE(observed.hold == ContactHold::observer);
  CHECK(contact_law({}, observed, strong).damping == observed.tuning.wall_damping);  // no device damper
}

TEST_CASE("feel is rendered only by the loop: a device wall does not allow a stiffer feel") {
  HapticConfig config;
  config.tuning.feel_scale = 4.0;
  DeviceSpec spec;
  spec.delay = 3;
  spec.device_wall_stiffness = {4000.0, 4000.0};
  const AdmittedTuning used = admit_tuning(config, spec, paper_feel());
  CHECK(used.tuning.wall_stiffness > 4000.0);
  CHECK(used.tuning.feel_scale * paper_feel() <= 0.58 * 0.086 / 16e-6 * (1.0 + 1e-12));
}

TEST_CASE("every tuning admitted with device dampers is stable with all, half and none of their damping") {
  for (const double own : {3.0, 10.0, 60.0}) {
    for (const int delay : {0, 1, 3, 6, 8}) {
      CAPTURE(own);
      CAPTURE(delay);
      const DeviceSpec spec = damping_itself(own, delay);
      const AdmittedTuning used = admitted_with(spec, 10.0, ContactHold::half_sample);
      const ContactLaw in_wall = contact_law({}, used, spec);
      for (const double fraction : {0.0, 0.5, 1.0}) {
        for (NamedHand named : kNamedHands) {
          named.hand.damping += fraction * std::min(own, 10.0);
          for (const AxisModel& axis : {kPaperAxisX, kPaperAxisY})
            CHECK(spectral_radius(axis, named.hand, in_wall, 0.001) < 1.0);
        }
      }
    }
  }
}

TEST_CASE("every tuning admitted with device walls is stable with all, half and none of their stiffness") {
  for (const double own : {400.0, 3000.0, 20000.0}) {
    for (const int delay : {0, 1, 3, 6, 8}) {
      for (const ContactHold hold : {ContactHold::half_sample, ContactHold::observer}) {
        CAPTURE(own);
        CAPTURE(delay);
        const AdmittedTuning used = admitted_with_device_walls(own, 5000.0, delay, hold);
        const HapticTuning& t = used.tuning;
        DeviceSpec spec;
        spec.device_wall_stiffness = {own, own};
        const double device_part = std::min(own, t.wall_stiffness), loop_part = loop_stiffness(t, spec);
        for (const double fraction : {0.0, 0.5, 1.0}) {
          for (const double free : {t.aisle_damping, t.aisle_damping + t.limit_damping}) {
            for (NamedHand named : kNamedHands) {
              named.hand.stiffness += fraction * device_part;  // for the loop, a device wall acts like a stiffer hand
              for (const AxisModel& axis : {kPaperAxisX, kPaperAxisY}) {
                const ContactLaw in_wall{used.hold, loop_part, t.wall_damping, 1, free, 0.004, delay};
                CHECK(spectral_radius(axis, named.hand, in_wall, 0.001) < 1.0);
                const ContactLaw outside{ContactHold::zero_order, 0.0, 0.0, 1, free, 0.004, delay};
                CHECK(spectral_radius(axis, named.hand, outside, 0.001) < 1.0);
              }
            }
          }
        }
      }
    }
  }
}
