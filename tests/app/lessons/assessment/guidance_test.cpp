// Compares the guidance policy with its equations, which the test computes separately, and checks its invariants.
#include "app/lessons/assessment/guidance.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <doctest/doctest.h>

using namespace gearshift::lessons;

TEST_CASE("the gain follows g <- clamp(f g + k error), with f falling as skill grows") {
  const GuidanceConfig config;
  GuidancePolicy policy(1);
  double g = config.start, skill = 0.0;
  for (int n = 0; n < 60; ++n) {
    const double error = std::exp(-n / 12.0);
    const double e = std::min(1.0, error / 0.4);
    const double f = config.forgetting * (1.0 - skill) + config.forgetting_skilled * skill;
    g = std::clamp(f * g + config.per_error * e, 0.0, 1.0);
    skill = config.skill_memory * skill + (1.0 - config.skill_memory) * (1.0 - e);
    policy.learn(error, error, 0.0);
    CHECK(policy.gain() == doctest::Approx(g).epsilon(1e-12));
    CHECK(policy.skill() == doctest::Approx(skill).epsilon(1e-12));
  }
}

TEST_CASE("without errors help fades: the gain is the product of all f") {
  GuidanceConfig config;
  config.start = 1.0;
  config.skill_memory = 1.0;  // the skill stays 0, so the fade factor f is constant
  GuidancePolicy policy(1, config);
  for (int n = 0; n < 20; ++n) policy.learn(0.0, 0.0, 0.0);
  CHECK(policy.gain() == doctest::Approx(std::pow(config.forgetting, 20)).epsilon(1e-12));
}

TEST_CASE("a constant error e keeps the gain at k e / (1 - f), and an error beyond any pass grade at its maximum") {
  GuidanceConfig config;
  config.skill_memory = 1.0;
  GuidancePolicy policy(1, config);
  for (int n = 0; n < 400; ++n) policy.learn(0.1, 0.1, 0.0);
  CHECK(policy.gain() == doctest::Approx(config.per_error * 0.25 / (1.0 - config.forgetting)).epsilon(1e-9));
  for (int n = 0; n < 400; ++n) policy.learn(0.4, 0.4, 0.0);
  CHECK(policy.gain() == 1.0);
}

TEST_CASE("help for a limb follows its own errors only, and hints stay as long as anything fails") {
  GuidancePolicy feet_fail(1), hand_fails(1);
  CHECK(feet_fail.next().guidance + feet_fail.next().pedal_help == 0.0);  // nothing went wrong yet
  for (int n = 0; n < 30; ++n) hand_fails.learn(1.0, 1.0, 0.0);
  CHECK(hand_fails.gain() == 1.0);
  CHECK(hand_fails.pedal_gain() == 0.0);
  for (int n = 0; n < 30; ++n) feet_fail.learn(1.0, 0.0, 1.0);
  CHECK(feet_fail.gain() == 0.0);
  CHECK(feet_fail.pedal_gain() == 1.0);
  CHECK(feet_fail.skill() == 0.0);
  int helped = 0;
  for (int n = 0; n < 8; ++n) {
    const TrialPlan plan = feet_fail.next();
    CHECK(plan.guidance == 0.0);
    helped += plan.pedal_help == 1.0 ? 1 : 0;
  }
  CHECK(helped == 4);
}

TEST_CASE("guidance fades faster for a skilled learner") {
  GuidancePolicy skilled(1), novice(1);
  for (int n = 0; n < 3; ++n) skilled.learn(0.4, 0.4, 0.0), novice.learn(0.4, 0.4, 0.0);
  for (int n = 0; n < 10; ++n) skilled.learn(0.02, 0.02, 0.0), novice.learn(0.35, 0.35, 0.0);
  CHECK(skilled.skill() > 0.8);
  CHECK(novice.skill() < 0.2);
  CHECK(skilled.gain() < 0.1);
  CHECK(novice.gain() > 0.9);
}

TEST_CASE("two of every four trials are unguided, in an order that depends on the seed") {
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    GuidancePolicy policy(seed);
    int guided = 0;
    for (int n = 1; n <= 400; ++n) {
      policy.learn(1.0, 1.0, 0.0);
      guided += policy.next().guidance > 0.0 ? 1 : 0;
      if (n % 4 == 0) CHECK(guided == n / 2);
    }
  }
  std::vector<int> first(4, 0);
  for (std::uint64_t seed = 0; seed < 4000; ++seed) {
    GuidancePolicy policy(seed);
    policy.learn(1.0, 1.0, 0.0);
    for (int& count : first) count += policy.next().guidance > 0.0 ? 1 : 0;
  }
  // Half of the 4000 policies should guide each trial; the tolerance of 6 % is about 4 standard deviations.
  for (const int count : first) CHECK(count == doctest::Approx(2000).epsilon(0.06));
}

TEST_CASE("with one lost point per trial, half of the trials stay guided for long; without lost points guidance ends") {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    GuidancePolicy policy(seed);
    int guided = 0;
    const auto drive = [&](int trials, double error) {
      guided = 0;
      for (int n = 0; n < trials; ++n) {
        guided += policy.next().guidance > 0.0 ? 1 : 0;
        policy.learn(error, error, 0.0);
      }
    };
    drive(24, 0.1);
    CHECK(guided >= 11);  // the first trial has no help, because nothing failed before it
    drive(8, 0.0);
    drive(8, 0.0);
    CHECK(guided == 0);
  }
}

TEST_CASE("equal seeds and errors give equal plans, different seeds different plans") {
  const auto plans = [](std::uint64_t seed) {
    GuidancePolicy policy(seed);
    std::vector<double> list;
    for (int n = 0; n < 40; ++n) {
      list.push_back(policy.next().guidance);
      policy.learn(0.5, 0.5, 0.0);
    }
    return list;
  };
  CHECK(plans(5) == plans(5));
  CHECK(plans(5) != plans(6));
}

TEST_CASE("a guided trial has the gain, an unguided one none, and a tiny gain counts as none") {
  GuidancePolicy policy(3);
  for (int n = 0; n < 40; ++n) {
    const double gain = policy.gain();
    const TrialPlan plan = policy.next();
    if (plan.guidance != 0.0) CHECK(plan.guidance == gain);
    if (plan.guidance != 0.0) CHECK(gain >= GuidanceConfig().min_gain);
    policy.learn(0.0, 0.0, 0.0);
  }
  CHECK(policy.gain() < GuidanceConfig().min_gain);
  for (int n = 0; n < 8; ++n) CHECK(policy.next().guidance == 0.0);
}

TEST_CASE("a retention test is unguided, with hints only at the end") {
  GuidancePolicy policy(3);
  CHECK(policy.retention().guidance == 0.0);
  CHECK(policy.retention().hints == HintStyle::summary);
}

TEST_CASE("hints change from prescriptive to bandwidth to summary as skill grows, and back when it is lost") {
  GuidancePolicy policy(3);
  std::vector<HintStyle> styles{policy.next().hints};
  const auto go_on = [&](double error) {
    for (int n = 0; n < 12; ++n) {
      policy.learn(error, error, 0.0);
      const HintStyle style = policy.next().hints;
      if (style != styles.back()) styles.push_back(style);
    }
  };
  go_on(0.0);
  CHECK(styles == std::vector<HintStyle>{HintStyle::prescriptive, HintStyle::bandwidth, HintStyle::summary});
  go_on(1.0);
  CHECK(styles.back() == HintStyle::prescriptive);
}

TEST_CASE("invalid errors do not change the policy, and errors are clamped to 1") {
  GuidancePolicy policy(3);
  policy.learn(std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::quiet_NaN(), 0.0);
  policy.learn(-1.0, -1.0, 0.0);
  CHECK(policy.gain() == GuidanceConfig().start);
  GuidancePolicy one(3), many(3);
  one.learn(1.0, 1.0, 0.0);
  many.learn(50.0, 50.0, 0.0);
  CHECK(one.gain() == many.gain());
  CHECK(one.skill() == many.skill());
}
