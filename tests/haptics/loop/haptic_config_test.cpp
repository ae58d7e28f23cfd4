// Which numbers the cycle accepts, and what a device admits of them.
#include "haptics/loop/haptic_config.h"

#include <algorithm>
#include <initializer_list>
#include <limits>
#include <stdexcept>
#include <string>

#include <doctest/doctest.h>

#include "haptics/gate/gate_feel.h"
#include "tests/support/gates.h"

using namespace gearshift;

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
  config.guard.fade_time = 0.0;
  CHECK(refusal(config).find("fade_time_s") != std::string::npos);
  config = {};
  config.over_push.clear_below = 61.0;  // above the warning: no hysteresis left
  CHECK(refusal(config).find("clear_below_n") != std::string::npos);
}

TEST_CASE("half-sample hold: K <= 0.35 m / tau^2 and B <= 0.35 m / tau, tau = (delay + 1) T, m the lighter axis") {
  const Gate gate = paper_gate();
  HapticTuning wanted;
  wanted.wall_stiffness = 20000.0;
  wanted.wall_damping = 100.0;
  wanted.aisle_damping = 50.0;
  wanted.limit_damping = 50.0;
  for (const double period : {0.01, 0.005, 0.002, 0.001, 0.00025}) {
    for (const int delay : {0, 1, 3}) {
      DeviceSpec spec;
      spec.delay = delay;
      const double tau = (delay + 1) * period;
      const HapticTuning used = admit_tuning(wanted, period, spec, gate).tuning;
      CHECK(used.wall_stiffness == doctest::Approx(std::min(20000.0, 0.35 * 0.086 / (tau * tau))));
      CHECK(used.wall_damping == doctest::Approx(std::min(100.0, 0.35 * 0.086 / tau)));
      CHECK(used.aisle_damping == doctest::Approx(std::min(50.0, 0.35 * 0.086 / tau)));
      CHECK(used.limit_damping == doctest::Approx(std::min(50.0, 0.35 * 0.086 / tau)));
    }
  }
}

TEST_CASE("the default is admitted whole at 1 kHz; at 100 Hz everything that was limited is said") {
  const Gate gate = paper_gate();
  CHECK(admit_tuning({}, 0.001, {}, gate).limited.empty());
  const AdmittedTuning slow = admit_tuning({}, 0.01, {}, gate);
  REQUIRE(slow.limited.size() >= 2);
  for (const Limited& limited : slow.limited) {
    CHECK(limited.used < limited.wanted);
    CHECK_FALSE(limited.law.empty());
  }
}

TEST_CASE("no feel stiffer than the wall that carries the proxy") {
  const Gate gate = paper_gate();
  HapticTuning wanted;
  wanted.feel_scale = 4.0;
  const HapticTuning used = admit_tuning(wanted, 0.001, {}, gate).tuning;
  CHECK(used.feel_scale * stiffest_feel(gate) <= used.wall_stiffness * (1.0 + 1e-12));
}
