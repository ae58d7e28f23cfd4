// A stick that is held open: through the real driver and its thread, to an emulated one.
#include "app/devices/stick_lever.h"

#include <chrono>
#include <thread>

#include <doctest/doctest.h>

#include "tests/app/devices/held_stick.h"

using namespace gearshift;

namespace {

// Until it holds, at most ten seconds.
template <class Condition>
bool comes_true(const Condition& condition) {
  for (int i = 0; i < 2000 && !condition(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(5));
  return condition();
}

}  // namespace

TEST_CASE("one that reports otherwise than when it was calibrated is not driven, and says what to do") {
  KnownStick other{sidewinder_calibration(), {}};
  EmulatedStickConfig config;
  config.family = StickFamily::openffboard;
  RestingHand nobody;
  other.report_descriptor = EmulatedStick(config, nobody).report_descriptor();
  HeldStick held(other);
  std::optional<std::string> news;
  CHECK(comes_true([&] { return news.has_value() || (news = held.lever->take_news()).has_value(); }));
  CHECK(news->find("gearshift devices --calibrate 045e:001b") != std::string::npos);
  CHECK_FALSE(held.lever->connected());
}

TEST_CASE("a stand-in is the same device, and what it is told moves nothing") {
  HeldStick held;
  REQUIRE(comes_true([&] { return held.lever->connected(); }));
  const auto lever = held.lever->lever(1e-3), stand_in = held.lever->stand_in(1e-3);
  CHECK(stand_in->spec().delay == lever->spec().delay);
  CHECK(stand_in->spec().max_force == lever->spec().max_force);
  CHECK(stand_in->spec().workspace == glm::dvec2(0.07));
  for (int i = 0; i < 100; ++i) {
    (void)stand_in->read(0);
    stand_in->write({10.0, 10.0});
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  CHECK(held.force() == 0.0);
}

TEST_CASE("a force comes and goes with its lever; when the stick is let go its motors are off") {
  HeldStick held;
  REQUIRE(comes_true([&] { return held.lever->connected(); }));
  auto lever = held.lever->lever(1e-3);
  const auto pushes = [&] {
    (void)lever->read(0);
    lever->write({5.0, 0.0});
    return held.force() > 4.0;
  };
  CHECK(comes_true(pushes));
  lever->release();
  CHECK(comes_true([&] { return held.force() == 0.0; }));
  CHECK(comes_true(pushes));
  lever.reset();
  held.lever.reset();
  CHECK(held.force() == 0.0);
  CHECK_FALSE(held.actuators_on());
}
