// Tests of the push that is estimated on a device without a force sensor, against the simulated lever's true force.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "app/lab/bench/lever/pressed_rig.h"
#include "haptics/device/pushing_hand.h"
#include "haptics/device/scripted_hand.h"
#include "haptics/device/simulated_lever.h"
#include "haptics/gate/plain_aisle.h"
#include "haptics/loop/haptic_loop.h"

using namespace gearshift::haptics;
using namespace gearshift::lab;
using glm::dvec2;

namespace {

constexpr double kWall = 0.01;  // [m] half width of the aisle whose wall the lever is pressed against

// A lever that hides its force sensor from the loop; only the test reads the sensor.
class SensorlessLever final : public HapticDevice {
 public:
  SensorlessLever(const SimulatedLeverConfig& config, HandDriver& hand)
      : lever(config, kPeriodNs, hand), spec_(lever.spec()) {
    spec_.measures_hand_force = false;
  }
  const DeviceSpec& spec() const noexcept override { return spec_; }
  LeverReading read(std::int64_t now_ns) noexcept override {
    LeverReading reading = lever.read(now_ns);
    truth = reading.hand_force;
    reading.hand_force = {0.0, 0.0};
    return reading;
  }
  void write(dvec2 force) noexcept override { lever.write(force); }
  void set_device_walls(const LeverWalls& walls) noexcept override { lever.set_device_walls(walls); }
  void release() noexcept override { lever.release(); }

  SimulatedLever lever;
  dvec2 truth{0.0};  // [N]

 private:
  DeviceSpec spec_;
};

struct Sensorless {
  Sensorless(SimulatedLeverConfig config, HandDriver& hand)
      : device(ideal(config), hand), loop(HapticConfig{}, plain_aisle(0.06, kWall), device, load, inputs) {
    loop.arm();
  }
  static SimulatedLeverConfig ideal(SimulatedLeverConfig config) {
    config.force_sensor.resolution_gw = 0.0;
    config.actuator.continuous_force = config.actuator.peak_force;  // no overheating here
    return config;
  }
  void run(int cycles) {
    for (int i = 0; i < cycles; ++i) {
      loop.cycle(now += kPeriodNs, 0);
      estimated = estimated && (loop.snapshot().flags & kFlagPushEstimated) != 0;
    }
  }
  dvec2 error() const { return loop.snapshot().f_h - device.truth; }

  SensorlessLever device;
  NoLoad load;
  LoopInputs inputs;
  HapticLoop loop;
  std::int64_t now = 0;
  bool estimated = true;  // in every cycle
};

SimulatedLeverConfig lever_of(const HandImpedance& hand, int delay = 0, double own = 0.0) {
  SimulatedLeverConfig config;
  config.hand = hand;
  config.delay = delay;
  config.device_wall_stiffness = own;
  return config;
}

struct Means {
  double truth = 0.0, estimate = 0.0, worst = 0.0;  // [N] along the shift axis
};

Means over(Sensorless& rig, int cycles) {
  Means means;
  for (int i = 0; i < cycles; ++i) {
    rig.run(1);
    means.truth += rig.device.truth.y / cycles;
    means.estimate += rig.loop.snapshot().f_h.y / cycles;
    means.worst = std::max(means.worst, std::abs(rig.error().y));
  }
  return means;
}

void print(const std::string& what, const Means& means) {
  MESSAGE(what << ": true " << means.truth << " N, estimated " << means.estimate << " N, worst error of a sample "
               << means.worst << " N");
}

}  // namespace

// At an acceleration a, the estimate's error is (m + b tau) a: the estimate neglects the handle's mass m and multiplies
// the damping b by a velocity that lags by tau, at most 5 ms (4 ms of smoothing plus one period). In addition, each
// encoder count makes the smoothed velocity jump.
TEST_CASE("in free space the estimate's error is the neglected inertia") {
  const std::vector<HandStroke> strokes{{{0.04, 0.005}, 0.3, 0.2}, {{-0.04, -0.005}, 0.4, 0.2}, {{0.0, 0.0}, 0.2, 0.2}};
  ScriptedHand hand({}, strokes, 0.001);
  Sensorless rig(lever_of(kGripHand), hand);
  double worst = 0.0, acceleration = 0.0, largest = 0.0;
  for (int i = 0; i < 1500; ++i) {
    const double before = rig.device.lever.true_velocity().x;
    rig.run(1);
    acceleration = std::max(acceleration, 1e3 * std::abs(rig.device.lever.true_velocity().x - before));
    worst = std::max(worst, std::abs(rig.error().x));
    largest = std::max(largest, std::abs(rig.device.truth.x));
  }
  const double count = 0.221 * 75e-6 / 0.001;  // [m/s] velocity jump due to one count; 0.221 = 1 - exp(-1 ms / 4 ms)
  MESSAGE("free, up to " << largest << " N at " << acceleration << " m/s^2: worst error of a sample " << worst << " N");
  CHECK(worst < (0.095 + 3.0 * 0.005) * acceleration + 3.0 * count);
  CHECK(rig.estimated);
}

TEST_CASE("pressed into a wall without saturation: within 3 %, whichever part renders the wall") {
  for (const double own : {0.0, 1000.0}) {
    for (const double push : {5.0, 10.0, 20.0, 30.0}) {
      PushingHand hand([push](double time, dvec2) { return dvec2{0.0, push * std::min(1.0, time)}; });
      Sensorless rig(lever_of(kBareHand, own > 0.0 ? 3 : 0, own), hand);
      rig.run(2500);
      const Means means = over(rig, 50);
      print("wall, " + std::string(own > 0.0 ? "partly the device's, " : "") + std::to_string(static_cast<int>(push)) +
                " N",
            means);
      CHECK(means.truth == doctest::Approx(push).epsilon(0.02));  // along the arc
      CHECK(means.estimate == doctest::Approx(means.truth).epsilon(0.03));
      CHECK(rig.estimated);
    }
  }
}

// The hands aim at a point 64 mm behind the wall. The motors can resist with at most 31.7 N, so the lever rests where
// the hand's spring force has fallen to this value. The estimate is the force that the wall would exert at this depth
// with stronger motors. It exceeds the push, so the warning comes early.
TEST_CASE("with saturated motors: never estimated below the push, and the warning of an estimated push comes") {
  for (const double own : {0.0, 1000.0, 3000.0}) {
    for (const double stiffness : {600.0, 700.0, 1400.0}) {
      ScriptedHand hand({}, {{{0.0, 0.0737}, 1.0, 5.0}}, 0.001);
      Sensorless rig(lever_of({0.15, 10.0, stiffness}, own > 0.0 ? 3 : 0, own), hand);
      rig.run(3000);
      const Means means = over(rig, 50);
      const double depth = rig.device.lever.true_position().y - kWall;
      print(std::string(own > 0.0 ? "partly the device's, " : "") + "hand of " +
                std::to_string(static_cast<int>(stiffness)) + " N/m, " + std::to_string(1e3 * depth) + " mm deep",
            means);
      CHECK(depth == doctest::Approx(0.0637 - 31.7 / stiffness).epsilon(0.05));
      CHECK((rig.loop.snapshot().flags & kFlagSaturated) != 0);
      CHECK(means.truth > 0.99 * 31.7);
      CHECK(means.estimate >= means.truth);
      CHECK(((rig.loop.snapshot().flags & kFlagOverPush) != 0) == (means.estimate > 60.0));
      CHECK(rig.estimated);
    }
  }
}

TEST_CASE("a lever with a sensor does not report an estimate, except while the sensor's value is invalid") {
  PressedRig rig(plain_aisle(0.06, kWall));
  const auto estimated = [&rig] { return (rig.loop.snapshot().flags & kFlagPushEstimated) != 0; };
  CHECK_FALSE(estimated());
  CHECK(rig.loop.snapshot().f_h.y == doctest::Approx(15.0).epsilon(0.05));
  rig.lever.sabotage = [](LeverReading& reading) { reading.hand_force = {kNan, 0.0}; };
  rig.run(10);
  CHECK(estimated());
  CHECK(rig.loop.snapshot().f_h.y == doctest::Approx(15.0).epsilon(0.05));
  rig.lever.sabotage = nullptr;
  rig.run(1);
  CHECK_FALSE(estimated());
}
