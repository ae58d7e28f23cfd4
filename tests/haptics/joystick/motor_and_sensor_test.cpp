#include <cmath>
#include <initializer_list>
#include <limits>

#include <doctest/doctest.h>

#include "haptics/joystick/actuator.h"
#include "haptics/joystick/force_sensor.h"

using namespace gearshift::haptics;

TEST_CASE("motors give at most 3.8 N m / 0.12 m, and nothing for a command that is not a number") {
  Actuator motor{ActuatorLimits{}};
  CHECK(motor.deliver(60.0, 1e-3) == doctest::Approx(3.8 / 0.12).epsilon(2e-3));
  CHECK(motor.deliver(-60.0, 1e-3) == doctest::Approx(-3.8 / 0.12).epsilon(2e-3));
  CHECK(motor.deliver(std::nan(""), 1e-3) == 0.0);
  CHECK(motor.deliver(std::numeric_limits<double>::infinity(), 1e-3) == 0.0);
  CHECK(motor.deliver(7.0, 1e-3) == 7.0);
}

TEST_CASE("a force F lasts overload_time (Fp^2 - Fc^2) / (F^2 - Fc^2), then Fc, until half the heat is gone") {
  const ActuatorLimits limits{30.0, 10.0, 5.0};
  for (double force : {30.0, 20.0, 12.0}) {
    Actuator motor(limits);
    const auto is_limited = [&] { return motor.deliver(force, 0.0) < force; };  // in no time, so that no heat is added
    double time = 0.0;
    while (!is_limited()) {
      CHECK(motor.deliver(force, 1e-3) == force);
      time += 1e-3;
    }
    CHECK(std::abs(time - 5.0 * (900.0 - 100.0) / (force * force - 100.0)) < 2.5e-3);
    CHECK(motor.deliver(force, 1e-3) == 10.0);

    // The overload integral has a limit of 5 s * (30^2 - 10^2) N^2 = 4000 N^2 s. Without load it falls by the square of
    // the continuous force, (10 N)^2, per second. So it reaches half the limit after 20 s.
    double rest = 0.0;
    while (is_limited()) {
      motor.deliver(0.0, 1e-2);
      rest += 1e-2;
    }
    CHECK(rest == doctest::Approx(20.0).epsilon(0.01));
    CHECK(motor.deliver(force, 1e-3) == force);
  }
}

TEST_CASE("the continuous force has no time limit") {
  Actuator motor{ActuatorLimits{}};
  for (int i = 0; i < 100000; ++i) motor.deliver(10.83, 1.0);
  CHECK(motor.deliver(31.7, 1e-3) == 31.7);
}

TEST_CASE("eq (7): no force reads 19.04, a kilogram 19.04 + 155.1, and the force comes back") {
  ForceSensorModel fine;
  fine.resolution_gw = 0.0;
  CHECK(sensor_reading(fine, 0.0) == 19.04);
  CHECK(sensor_reading(fine, 9.80665) == doctest::Approx(19.04 + 155.1).epsilon(1e-14));
  CHECK(force_from_reading(fine, 19.04 + 155.1) == doctest::Approx(9.80665).epsilon(1e-14));
  CHECK(force_from_reading(fine, sensor_reading(fine, -3.3)) == doctest::Approx(-3.3).epsilon(1e-13));
}

TEST_CASE("the sensor reads in steps of 44 gw = 0.43 N and saturates at 22 kgf") {
  const ForceSensorModel sensor;
  const double step = 0.044 * 9.80665, range = 22.0 * 9.80665;
  for (int i = -20'000; i <= 20'000; ++i) {
    const double force = 0.0151 * i;
    const double measured = force_from_reading(sensor, sensor_reading(sensor, force));
    const double steps = measured / step;
    CHECK(std::abs(steps - std::round(steps)) < 1e-9);
    CHECK(std::abs(measured) <= range * (1.0 + 1e-12));
    if (std::abs(force) < range) CHECK(std::abs(measured - force) <= 0.5 * step + 1e-9);
  }
}
