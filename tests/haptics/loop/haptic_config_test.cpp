// Which numbers the cycle accepts, and what a device admits of them.
#include "haptics/loop/haptic_config.h"

#include <algorithm>
#include <initializer_list>
#include <limits>
#include <set>
#include <stdexcept>
#include <string>
#include <tuple>

#include <doctest/doctest.h>

#include "haptics/analysis/sampled_loop.h"
#include "haptics/device/hand.h"
#include "haptics/gate/gate_feel.h"
#include "tests/support/gates.h"
#include "tests/support/whole_campaign.h"

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
  config.guard.slew = 1.9;  // a wall whose force comes that slowly swings
  CHECK(refusal(config).find("slew_n_per_cycle = 1.9: must be between 2 and 100") != std::string::npos);
  config = {};
  config.guard.fade_time = 0.0;
  CHECK(refusal(config).find("fade_time_s") != std::string::npos);
  config = {};
  config.over_push.clear_below = 61.0;  // above the warning: no hysteresis left
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
  return admit_tuning(config, spec, paper_gate());
}

}  // namespace

TEST_CASE("quiet: K <= 0.35 m / tau^2 (observer 0.58), B <= 0.35 m / tau, tau = (delay + 1) T, m the lighter axis") {
  HapticTuning wanted;
  wanted.wall_stiffness = 20000.0;
  wanted.wall_damping = 100.0;
  wanted.aisle_damping = 50.0;
  wanted.limit_damping = 50.0;
  for (const double rate : {100.0, 200.0, 500.0, 1000.0, 4000.0}) {
    for (const int delay : {0, 1, 3}) {
      for (const ContactHold hold : {ContactHold::half_sample, ContactHold::observer}) {
        const double tau = (delay + 1) / rate, share = hold == ContactHold::observer ? 0.58 : 0.35;
        const HapticTuning used = admitted(wanted, rate, delay, hold).tuning;
        CHECK(used.wall_stiffness <= std::min(20000.0, share * 0.086 / (tau * tau)) * (1.0 + 1e-12));
        // An observed hold has 50 N s/m of its own, and a slow one is not admitted at all.
        const bool observed = used.wall_damping >= 50.0 && hold == ContactHold::observer;
        if (!observed) CHECK(used.wall_damping == doctest::Approx(std::min(100.0, 0.35 * 0.086 / tau)));
        CHECK(used.aisle_damping == doctest::Approx(std::min(50.0, 0.35 * 0.086 / tau)));
        CHECK(used.limit_damping == doctest::Approx(std::min(50.0, 0.35 * 0.086 / tau)));
      }
    }
  }
}

TEST_CASE("automatic: the observer where delay keeps the half-sample hold from the wanted stiffness, up to 4.5 ms") {
  CHECK(admitted({}, 1000.0, 0).hold == ContactHold::half_sample);
  CHECK(admitted({}, 1000.0, 1).hold == ContactHold::half_sample);
  CHECK(admitted({}, 1000.0, 2).hold == ContactHold::observer);
  CHECK(admitted({}, 1000.0, 2).tuning.wall_stiffness == 5000.0);
  CHECK(admitted({}, 1000.0, 2).tuning.wall_damping == 50.0);
  CHECK(admitted({}, 1000.0, 3).hold == ContactHold::observer);
  CHECK(admitted({}, 1000.0, 4).hold == ContactHold::half_sample);  // 5 ms
  CHECK(admitted({}, 500.0, 1).hold == ContactHold::observer);
  CHECK(admitted({}, 200.0, 0).hold == ContactHold::half_sample);
}

TEST_CASE("whatever is admitted is stable: in the wall, in every softer one, in free space, slow and fast, each hand") {
  HapticTuning damped;
  damped.wall_stiffness = 20000.0;
  damped.wall_damping = 100.0;
  damped.aisle_damping = 50.0;
  damped.limit_damping = 50.0;
  std::set<std::tuple<ContactHold, double, double, double, int, double>> seen;  // what two tunings both come to
  const auto check = [&seen](ContactHold as, double stiffness, double damping, double free, int delay, double rate) {
    if (!seen.insert({as, stiffness, damping, free, delay, rate}).second) return;
    const ContactLaw law{as, stiffness, damping, 1, free, 0.004, delay};
    for (const NamedHand& named : kNamedHands)
      for (const AxisModel& axis : {kPaperAxisX, kPaperAxisY})
        CHECK(spectral_radius(axis, named.hand, law, 1.0 / rate) < 1.0);
  };
  for (const HapticTuning& wanted : {HapticTuning{}, damped}) {
    for (const double rate : {100.0, 200.0, 500.0, 1000.0, 2000.0, 4000.0}) {
      for (int delay = 0; delay <= 8; delay += is_whole_campaign() ? 1 : 2) {
        for (const ContactHold hold : {ContactHold::zero_order, ContactHold::half_sample, ContactHold::observer}) {
          const AdmittedTuning used = admitted(wanted, rate, delay, hold);
          const HapticTuning& t = used.tuning;
          for (const double share : {1.0, 0.75, 0.5, 0.1}) {
            const double stiffness = share * t.wall_stiffness;
            check(used.hold, stiffness, t.wall_damping, t.aisle_damping, delay, rate);
            check(used.hold, stiffness, t.wall_damping, t.aisle_damping + t.limit_damping, delay, rate);
          }
          check(ContactHold::zero_order, 0.0, 0.0, t.aisle_damping + t.limit_damping, delay, rate);
        }
      }
    }
  }
}

TEST_CASE("what only a study may have is refused without one") {
  HapticConfig config;
  config.estimator.window = 15;
  CHECK_THROWS_WITH_AS(admit_tuning(config, {}, paper_gate()), doctest::Contains("window"), std::invalid_argument);
  config = {};
  config.contact.reversal_limiter = false;
  CHECK_THROWS_WITH_AS(admit_tuning(config, {}, paper_gate()), doctest::Contains("limiter"), std::invalid_argument);
  config = {};
  config.contact.energy_control = EnergyControl::passivity_controller;
  CHECK_THROWS_WITH_AS(admit_tuning(config, {}, paper_gate()), doctest::Contains("passivity"), std::invalid_argument);
  config.contact.energy_control = EnergyControl::energy_bounding;
  CHECK_NOTHROW(admit_tuning(config, {}, paper_gate()));
}

TEST_CASE("a device that describes itself as nonsense is refused") {
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
  refused([](DeviceSpec& s) { s.own_stiffness.x = -1.0; });
  refused([](DeviceSpec& s) { s.own_stiffness.y = std::numeric_limits<double>::quiet_NaN(); });
  refused([](DeviceSpec& s) { s.delay = 16; });
  refused([](DeviceSpec& s) { s.delay = -1; });
  refused([](DeviceSpec& s) { s.axis_x.mass = 0.0; });
  refused([](DeviceSpec& s) { s.axis_y.damping = -1.0; });
  refused([](DeviceSpec& s) { s.axis_y.stiffness = std::numeric_limits<double>::infinity(); });
}

TEST_CASE("a textbook spring is held below the exact boundary, and the hand that decides is named") {
  HapticTuning spring;
  spring.wall_stiffness = 20000.0;
  spring.wall_damping = 0.0;
  spring.aisle_damping = 0.0;
  const AdmittedTuning used = admitted(spring, 1000.0, 0, ContactHold::zero_order);
  // The exact limit, stability_table_test: 6032 N/m on the X axis, bare; Y is 2 b / T = 5800 and the same 32 beyond it.
  CHECK(used.tuning.wall_stiffness == doctest::Approx(5832.0 / 1.1).epsilon(0.001));
  REQUIRE(used.limited.size() >= 1);
  CHECK(used.limited[0].hand == "bare");
  CHECK(used.limited[0].wanted == 20000.0);
  CHECK(used.limited[0].bound == used.tuning.wall_stiffness);
}

TEST_CASE("the default is admitted whole at 1 kHz; at 100 Hz everything that was limited is said") {
  CHECK(admitted({}, 1000.0, 0).limited.empty());
  const AdmittedTuning slow = admitted({}, 100.0, 0);
  REQUIRE(slow.limited.size() >= 2);
  for (const Limited& limited : slow.limited) {
    CHECK(limited.used < limited.wanted);
    CHECK(limited.used == limited.bound);
    CHECK_FALSE(limited.law.empty());
  }
}

TEST_CASE("a study uses what is wanted, says all the same what is not stable, and is refused on real devices") {
  HapticConfig config;
  config.rate = 100.0;
  config.contact.study = true;
  config.contact.hold = ContactHold::zero_order;
  DeviceSpec spec;
  CHECK_THROWS_WITH_AS(admit_tuning(config, spec, paper_gate()), doctest::Contains("study"), std::invalid_argument);
  spec.simulated = true;
  const AdmittedTuning used = admit_tuning(config, spec, paper_gate());
  CHECK(used.tuning == config.tuning);
  REQUIRE_FALSE(used.limited.empty());
  for (const Limited& limited : used.limited) CHECK(limited.used == limited.wanted);
}

TEST_CASE("no feel stiffer than the wall that carries the proxy") {
  HapticTuning wanted;
  wanted.feel_scale = 4.0;
  const HapticTuning used = admitted(wanted, 1000.0, 0).tuning;
  CHECK(used.feel_scale * stiffest_feel(paper_gate()) <= used.wall_stiffness * (1.0 + 1e-12));
}

namespace {

AdmittedTuning admitted_beside(double own, double wanted, int delay, ContactHold hold = ContactHold::automatic) {
  HapticConfig config;
  config.tuning.wall_stiffness = wanted;
  config.contact.hold = hold;
  DeviceSpec spec;
  spec.delay = delay;
  spec.own_stiffness = {own, own};
  return admit_tuning(config, spec, paper_gate());
}

const Limited* limit_of(const std::string& what, const AdmittedTuning& admitted) {
  for (const Limited& limited : admitted.limited)
    if (limited.what == what) return &limited;
  return nullptr;
}
const Limited* limit_of_wall(const AdmittedTuning& admitted) {
  return limit_of("wall_stiffness_n_per_m", admitted);
}

// A device that is late and keeps dampers.
DeviceSpec damping_itself(double own, int delay) {
  DeviceSpec spec;
  spec.delay = delay;
  spec.own_damping = {own, own + 1.0};  // what both axes have counts
  return spec;
}
AdmittedTuning admitted_with(const DeviceSpec& spec, double damping, ContactHold hold) {
  HapticConfig config;
  config.tuning.wall_damping = damping;
  config.contact.hold = hold;
  return admit_tuning(config, spec, paper_gate());
}

}  // namespace

TEST_CASE("what the device keeps of a wall the loop does not make: wanted less own, never below none") {
  DeviceSpec spec;
  spec.own_stiffness = {400.0, 500.0};
  const HapticTuning wanted{.wall_stiffness = 1000.0};
  CHECK(loop_stiffness(wanted, spec) == 600.0);  // what both axes have counts
  CHECK(loop_stiffness({.wall_stiffness = 300.0}, spec) == 0.0);
  spec.own_stiffness.x = 0.0;
  CHECK(loop_stiffness(wanted, spec) == 1000.0);

  // Without delay all of it is admitted, and the wall is the wanted one, whoever keeps it.
  const AdmittedTuning prompt = admitted_beside(1000.0, 5000.0, 0);
  CHECK(prompt.tuning.wall_stiffness == 5000.0);
  CHECK(limit_of_wall(prompt) == nullptr);
}

TEST_CASE("where the loop may not make the rest, the wall is its part and the device's, and that is said") {
  const double quiet = 0.35 * 0.086 / 16e-6;  // 3 samples of delay at 1 kHz
  const AdmittedTuning used = admitted_beside(400.0, 5000.0, 3, ContactHold::half_sample);
  CHECK(used.tuning.wall_stiffness == doctest::Approx(quiet + 400.0));
  const Limited* wall = limit_of_wall(used);
  REQUIRE(wall != nullptr);
  CHECK(wall->wanted == 5000.0);
  CHECK(wall->used == used.tuning.wall_stiffness);
  CHECK(wall->bound == used.tuning.wall_stiffness);
  CHECK(wall->law ==
        "quiet half-sample hold: K <= 0.35 m / tau^2, tau = (delay + 1) T; and 400 N/m that the device "
        "keeps itself");
  // Where the two make what is wanted, nothing was limited. The simpler hold does then.
  const AdmittedTuning both = admitted_beside(1000.0, quiet + 900.0, 3);
  CHECK(both.tuning.wall_stiffness == quiet + 900.0);
  CHECK(limit_of_wall(both) == nullptr);
  CHECK(both.hold == ContactHold::half_sample);
}

TEST_CASE(
    "of a wall's damping the loop makes what the device does not; together they make more than the loop alone may") {
  const double quiet = 0.35 * 0.086 / 0.006;  // [N s/m] 5.0: 5 samples of delay at 1 kHz
  const DeviceSpec little = damping_itself(3.0, 5), much = damping_itself(20.0, 5), none = damping_itself(0.0, 5);
  const AdmittedTuning alone = admitted_with(none, 10.0, ContactHold::half_sample);
  CHECK(alone.tuning.wall_damping == doctest::Approx(quiet));

  const AdmittedTuning both = admitted_with(little, 10.0, ContactHold::half_sample);
  CHECK(both.tuning.wall_damping == doctest::Approx(quiet + 3.0));
  CHECK(contact_law({}, both, little).damping == doctest::Approx(quiet));
  const Limited* told = limit_of("wall_damping_n_s_per_m", both);
  REQUIRE(told != nullptr);
  CHECK(told->wanted == 10.0);
  CHECK(told->used == both.tuning.wall_damping);
  CHECK(told->law ==
        "quiet half-sample hold: B <= 0.35 m / tau, tau = (delay + 1) T; and 3 N s/m that the device keeps itself");

  const AdmittedTuning device_alone = admitted_with(much, 10.0, ContactHold::half_sample);
  CHECK(device_alone.tuning.wall_damping == 10.0);
  CHECK(contact_law({}, device_alone, much).damping == 0.0);
  CHECK(limit_of("wall_damping_n_s_per_m", device_alone) == nullptr);

  const AdmittedTuning observed = admitted_with(damping_itself(20.0, 3), 10.0, ContactHold::observer);
  REQUIRE(observed.hold == ContactHold::observer);
  CHECK(contact_law({}, observed, much).damping == observed.tuning.wall_damping);  // it would take it for the hand's
}

TEST_CASE("feel is the loop's alone: a wall that the device keeps does not let it be stiffer") {
  HapticConfig config;
  config.tuning.feel_scale = 4.0;
  DeviceSpec spec;
  spec.delay = 3;
  spec.own_stiffness = {4000.0, 4000.0};
  const AdmittedTuning used = admit_tuning(config, spec, paper_gate());
  CHECK(used.tuning.wall_stiffness > 4000.0);
  CHECK(used.tuning.feel_scale * stiffest_feel(paper_gate()) <= 0.35 * 0.086 / 16e-6 * (1.0 + 1e-12));
}

TEST_CASE("whatever is admitted beside own dampers is stable with all of these, half of them and none") {
  for (const double own : {3.0, 10.0, 60.0}) {
    for (const int delay : {0, 1, 3, 6, 8}) {
      CAPTURE(own);
      CAPTURE(delay);
      const DeviceSpec spec = damping_itself(own, delay);
      const AdmittedTuning used = admitted_with(spec, 10.0, ContactHold::half_sample);
      const ContactLaw in_wall = contact_law({}, used, spec);
      for (const double share : {0.0, 0.5, 1.0}) {
        for (NamedHand named : kNamedHands) {
          named.hand.damping += share * std::min(own, 10.0);
          for (const AxisModel& axis : {kPaperAxisX, kPaperAxisY})
            CHECK(spectral_radius(axis, named.hand, in_wall, 0.001) < 1.0);
        }
      }
    }
  }
}

TEST_CASE("whatever is admitted beside own walls is stable with all of these, half of them and none") {
  for (const double own : {400.0, 3000.0, 20000.0}) {
    for (const int delay : {0, 1, 3, 6, 8}) {
      for (const ContactHold hold : {ContactHold::half_sample, ContactHold::observer}) {
        CAPTURE(own);
        CAPTURE(delay);
        const AdmittedTuning used = admitted_beside(own, 5000.0, delay, hold);
        const HapticTuning& t = used.tuning;
        DeviceSpec spec;
        spec.own_stiffness = {own, own};
        const double kept = std::min(own, t.wall_stiffness), loops = loop_stiffness(t, spec);
        for (const double share : {0.0, 0.5, 1.0}) {
          for (const double free : {t.aisle_damping, t.aisle_damping + t.limit_damping}) {
            for (NamedHand named : kNamedHands) {
              named.hand.stiffness += share * kept;  // the loop knows of it no more than of a hand
              for (const AxisModel& axis : {kPaperAxisX, kPaperAxisY}) {
                const ContactLaw in_wall{used.hold, loops, t.wall_damping, 1, free, 0.004, delay};
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
