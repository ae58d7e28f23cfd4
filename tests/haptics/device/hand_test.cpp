#include <algorithm>
#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <stdexcept>
#include <vector>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "haptics/device/scripted_hand.h"
#include "haptics/device/simulated_lever.h"
#include "haptics/device/smoothed_hand.h"

using namespace gearshift::haptics;

namespace {

HandStroke stroke_to(glm::dvec2 to, double duration, double dwell) {
  HandStroke stroke;
  stroke.to = to;
  stroke.duration = duration;
  stroke.dwell = dwell;
  return stroke;
}

}  // namespace

TEST_CASE("a minimum-jerk stroke is half way at half time with 15/8 of its mean speed") {
  const glm::dvec2 a{0.01, -0.02}, b{0.05, 0.04};
  const HandTarget middle = minimum_jerk(a, b, 0.2, 0.4);
  CHECK(glm::length(middle.position - 0.5 * (a + b)) < 1e-16);
  CHECK(glm::length(middle.velocity - 15.0 / 8.0 * (b - a) / 0.4) < 1e-15);
  CHECK(minimum_jerk(a, b, -1.0, 0.4).position == a);
  CHECK(minimum_jerk(a, b, 9.0, 0.4).position == b);
  CHECK(minimum_jerk(a, b, 9.0, 0.4).velocity == glm::dvec2(0.0));

  // A stroke of duration T from a to b starts without acceleration: for small t it has moved by 10 (b - a) (t/T)^3.
  CHECK(minimum_jerk(a, b, 4e-5, 0.4).position.x - a.x == doctest::Approx(10.0 * 0.04 * 1e-12).epsilon(1e-3));
}

TEST_CASE("the stroke's velocity is the derivative of its position") {
  const glm::dvec2 a{0.0, 0.0}, b{0.05, -0.04};
  for (int i = 1; i < 24; ++i) {
    const double t = 0.0125 * i;
    const glm::dvec2 slope =
        (minimum_jerk(a, b, t + 1e-6, 0.3).position - minimum_jerk(a, b, t - 1e-6, 0.3).position) / 2e-6;
    CHECK(glm::length(minimum_jerk(a, b, t, 0.3).velocity - slope) < 1e-8);
  }
}

TEST_CASE("strokes follow each other without a jump, dwell at their aim and end at the last") {
  ScriptedHand hand({}, {stroke_to({0.04, 0.0}, 0.3, 0.1), stroke_to({0.04, 0.03}, 0.2, 0.05)}, 1e-3);
  CHECK(hand.duration() == doctest::Approx(0.65));
  glm::dvec2 last{0.0};
  for (int ms = 0; ms <= 800; ++ms) {
    const HandTarget target = hand.next(ms * 1e-3, last);
    CHECK(glm::length(target.position - last) <= 15.0 / 8.0 * 0.04 / 0.2 * 1e-3);
    if (ms >= 300 && ms < 400) CHECK(target.position == glm::dvec2(0.04, 0.0));
    last = target.position;
  }
  CHECK(last == glm::dvec2(0.04, 0.03));
}

TEST_CASE("aims scatter with the stated deviation, once per stroke, and the seed decides how") {
  const int n = 4000;
  std::vector<HandStroke> strokes(n, stroke_to({0.02, -0.01}, 0.01, 0.01));
  ScriptedHandConfig config;
  config.aim_noise = 0.0015;
  ScriptedHand hand(config, strokes, 1e-3), twin(config, strokes, 1e-3);
  double squares = 0.0;
  for (int i = 0; i < n; ++i) {
    const double time = i * 0.02 + 0.015;  // in the dwell
    const glm::dvec2 aim = hand.next(time, {}).position;
    CHECK(twin.next(time, {}).position == aim);
    squares += glm::dot(aim - glm::dvec2(0.02, -0.01), aim - glm::dvec2(0.02, -0.01));
  }
  CHECK(std::sqrt(squares / (2 * n)) == doctest::Approx(0.0015).epsilon(4.0 / std::sqrt(4.0 * n)));
}

TEST_CASE("effort grows as gain x lag x time up to its limit, and fades within 50 ms of arrival") {
  ScriptedHandConfig config;
  config.start = {0.0, 0.010};  // [m] the hand's target; the test keeps the lever at 0, which is 10 mm behind
  config.effort_gain = 2000.0;
  config.effort_limit = 12.0;
  ScriptedHand hand(config, {}, 1e-3);
  for (int ms = 1; ms <= 1000; ++ms) {
    const glm::dvec2 push = hand.next(ms * 1e-3, {}).push;
    CHECK(push.x == 0.0);
    CHECK(push.y == doctest::Approx(std::min(12.0, 2000.0 * 0.010 * ms * 1e-3)));
  }
  double push = 0.0;
  for (int ms = 1; ms <= 100; ++ms) push = hand.next(1.0 + ms * 1e-3, {0.0, 0.0095}).push.y;
  CHECK(push == doctest::Approx(12.0 * std::exp(-100.0 / 50.0)));
}

TEST_CASE("a soft hand that lags 30 mm at most pulls through 12 N with effort, and not without") {
  const auto pulls_through = [](double gain) {
    ScriptedHandConfig script;
    script.effort_gain = gain;
    script.effort_limit = 15.0;
    ScriptedHand hand(script, {stroke_to({0.0, 0.030}, 0.3, 1.2)}, 1e-3);
    SimulatedLeverConfig config;
    config.hand = kLightHand;  // 200 N/m, so 6 N at a lag of 30 mm
    SimulatedLever lever(config, 1'000'000, hand);
    for (std::int64_t ms = 0; ms < 1500; ++ms) {
      const double y = lever.read(ms * 1'000'000).position.y;
      const bool in_detent = y > 0.002 && y < 0.008;
      lever.write({0.0, in_detent ? -12.0 * std::min(1.0, (y - 0.002) / 0.003) : 0.0});
    }
    return std::abs(lever.true_position().y - 0.030) < 0.0035;
  };
  CHECK_FALSE(pulls_through(0.0));
  CHECK(pulls_through(1500.0));
}

TEST_CASE("a person's hand is led from where the lever is, by a critically damped step") {
  LatestValue<HandTarget> channel;
  const double tau = 0.020;
  SmoothedHand hand(channel, 1e-3, tau);
  HandTarget wanted;
  wanted.position = {0.05, -0.01};
  wanted.pressed_down = true;
  channel.write(wanted);
  const glm::dvec2 lever{0.01, 0.02};
  for (int ms = 1; ms <= 200; ++ms) {
    const double t = ms * 1e-3, left = (1.0 + t / tau) * std::exp(-t / tau);
    const HandTarget target = hand.next(t, lever);
    CHECK(glm::length(target.position - (wanted.position + left * (lever - wanted.position))) < 1e-14);
    const glm::dvec2 speed = (wanted.position - lever) * (t / (tau * tau) * std::exp(-t / tau));
    CHECK(glm::length(target.velocity - speed) < 1e-12);
    CHECK(target.pressed_down);
  }
}

TEST_CASE("a person's hand ignores targets that are not finite") {
  LatestValue<HandTarget> channel;
  SmoothedHand hand(channel, 1e-3);
  HandTarget bad;
  bad.position = {std::nan(""), 0.0};
  channel.write(bad);
  for (int i = 0; i < 100; ++i) CHECK(hand.next(0.0, {0.01, 0.02}).position.x == doctest::Approx(0.01));
  bad.position = {1e308, 0.0};
  channel.write(bad);
  for (int i = 0; i < 1000; ++i) CHECK(std::isfinite(hand.next(0.0, {}).position.x));
}

TEST_CASE("a person's hand refuses a period or a smoothing out of range") {
  LatestValue<HandTarget> channel;
  CHECK_THROWS_WITH_AS(SmoothedHand(channel, 0.0), "SmoothedHand: period = 0: must be between 1e-06 and 1 s",
                       std::invalid_argument);
  CHECK_THROWS_WITH_AS(SmoothedHand(channel, 1e-3, 2.0), "SmoothedHand: smoothing = 2: must be between 0.001 and 1 s",
                       std::invalid_argument);
}

TEST_CASE("a hand is a name, three numbers, or six for an elastic hand, and nothing else") {
  CHECK(parse_hand("grip")->stiffness == 500.0);
  CHECK(parse_hand("pinch") == kPinchHand);
  CHECK(parse_hand("1,2,3,4,5,6") == HandImpedance{1.0, 2.0, 3.0, 4.0, 5.0, 6.0});
  for (const HandImpedance& hand :
       {kGripHand, kElasticHand, HandImpedance{0.3, 0.1, 7.0}, HandImpedance{1, 2, 3, 0, 0, 6}})
    CHECK(parse_hand(hand_text(hand)) == hand);
  CHECK(parse_hand("arm")->mass == 0.8);
  CHECK(parse_hand(".15,10,5e2")->stiffness == 500.0);
  for (const char* text :
       {"", "Grip", "grip ", "1,2", "1,2,3,4", "1,2,3,4,5", "1,2,3,4,5,0", "0,2,3,4,5,6", "1,2,3,4,5,6,7", "1,2,3 ",
        "1;2;3", "-1,2,3", "nan,1,1", "1,inf,1", "1,,1", "1,2,1e999", ",,", "0x1,1,1"}) {
    CAPTURE(text);
    CHECK_FALSE(parse_hand(text).has_value());
  }
}

TEST_CASE("a bad script is refused with the stroke's number and the allowed range") {
  CHECK_THROWS_WITH_AS(ScriptedHand({}, {stroke_to({}, 0.3, 0.1), stroke_to({}, 0.0, 0.1)}, 1e-3),
                       "ScriptedHand: stroke 1 duration = 0: must be between 0.001 and 10000 s", std::invalid_argument);
  ScriptedHandConfig config;
  config.effort_limit = std::nan("");
  CHECK_THROWS_AS(ScriptedHand(config, {}, 1e-3), std::invalid_argument);
  CHECK_THROWS_AS(ScriptedHand({}, {}, 0.0), std::invalid_argument);
}
