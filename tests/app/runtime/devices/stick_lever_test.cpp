// StickLever with its real driver and thread, connected to an emulated device.
#include "app/runtime/devices/stick_lever.h"

#include <chrono>
#include <thread>

#include <doctest/doctest.h>

#include "tests/app/runtime/devices/open_stick_rig.h"

using namespace gearshift::haptics;
using namespace gearshift::runtime;
using namespace gearshift::test;

namespace {

// Polls until the condition holds, for at most ten seconds.
template <class Condition>
bool becomes_true(const Condition& condition) {
  for (int i = 0; i < 2000 && !condition(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(5));
  return condition();
}

}  // namespace

TEST_CASE("a stick whose reports differ from its calibration is not driven, and the message names the remedy") {
  KnownStick other{sidewinder_calibration(), {}};
  EmulatedStickConfig config;
  config.family = StickFamily::openffboard;
  IdleHand idle_hand;
  other.report_descriptor = EmulatedStick(config, idle_hand).report_descriptor();
  HeldStick held(other);
  std::optional<std::string> news;
  CHECK(becomes_true([&] { return news.has_value() || (news = held.lever->take_message()).has_value(); }));
  CHECK(news->find("gearshift devices --calibrate 045e:001b") != std::string::npos);
  CHECK_FALSE(held.lever->connected());
}

TEST_CASE("a calibration of an older version is used, and a message says what it lacks and what that costs") {
  DeviceCalibration old = sidewinder_calibration();
  old.select.constant_limit = 0.0;
  old.select.spring_sign = old.shift.spring_sign = 1;
  EmulatedStickConfig config;
  IdleHand idle_hand;
  HeldStick held(KnownStick{old, EmulatedStick(config, idle_hand).report_descriptor()});
  CHECK(
      held.lever->take_message() ==
      "the calibration of SideWinder lacks the strength of forces, so they may be too strong or too weak, and the "
      "springs' dead band, so springs are not used and walls are softer; run: gearshift devices --calibrate 045e:001b");
  CHECK(held.lever->lever(1e-3)->spec().max_force == glm::dvec2(20.0));
  HeldStick whole;
  CHECK_FALSE(whole.lever->take_message().has_value());
}

TEST_CASE("a detached lever has the stick's limits, and commands to it move nothing") {
  HeldStick held;
  REQUIRE(becomes_true([&] { return held.lever->connected(); }));
  const auto lever = held.lever->lever(1e-3), detached_lever = held.lever->detached_lever(1e-3);
  CHECK(detached_lever->spec().delay == lever->spec().delay);
  CHECK(detached_lever->spec().max_force == lever->spec().max_force);
  CHECK(detached_lever->spec().workspace == glm::dvec2(0.07));
  for (int i = 0; i < 100; ++i) {
    (void)detached_lever->read(0);
    detached_lever->write({10.0, 10.0});
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  CHECK(held.force() == 0.0);
}

TEST_CASE("a force is applied only while its lever exists; when the stick is released its motors are off") {
  HeldStick held;
  REQUIRE(becomes_true([&] { return held.lever->connected(); }));
  auto lever = held.lever->lever(1e-3);
  const auto pushes = [&] {
    (void)lever->read(0);
    lever->write({5.0, 0.0});
    return held.force() > 4.0;
  };
  CHECK(becomes_true(pushes));
  lever->release();
  CHECK(becomes_true([&] { return held.force() == 0.0; }));
  CHECK(becomes_true(pushes));
  lever.reset();
  held.lever.reset();
  CHECK(held.force() == 0.0);
  CHECK_FALSE(held.actuators_on());
}
