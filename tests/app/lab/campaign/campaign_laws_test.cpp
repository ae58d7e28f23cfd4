// Each law of the campaign detects a violation that is planted on purpose, and accepts a correct case.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <initializer_list>
#include <limits>
#include <stdexcept>
#include <string>

#include <doctest/doctest.h>

#include "app/lab/campaign/shift_campaign.h"
#include "haptics/gate/gate_feel.h"
#include "tests/app/lab/campaign/campaign_fixtures.h"
#include "tests/support/gates.h"
#include "tests/support/temp_folder.h"

using namespace gearshift::haptics;
using namespace gearshift::lab;
using namespace gearshift::test;
using glm::dvec2;

namespace {

// Two consecutive cycles of a lever at rest in the neutral aisle of the paper's gate.
struct TwoCycles {
  HapticSnapshot before, now;
  TwoCycles() {
    before.guard = now.guard = GuardState::running;
    now.time_ns = 1'000'000;
  }
  CyclePair pair() const { return {now, before, false, false}; }
};

// Moves the displayed lever (proxy) through the gate's first lockout whose kind is in `kinds`.
TwoCycles through_lockout(const Gate& gate, std::initializer_list<LockoutKind> kinds) {
  const auto all = lockouts(gate);
  const auto lockout = std::find_if(all.begin(), all.end(), [&](const Lockout& one) {
    return std::find(kinds.begin(), kinds.end(), one.kind) != kinds.end();
  });
  REQUIRE(lockout != all.end());
  const Slot& slot = slot_of(gate, lockout->slot);
  const double x = lockout->lateral ? lockout->barrier : column_of(gate, slot.column).center;
  const double mouth = lockout->lateral ? 0.0 : static_cast<int>(slot.side) * (gate.half_aisle + gate.chamfer);
  const dvec2 step =
      lockout->lateral ? dvec2(1e-4 * lockout->beyond, 0.0) : dvec2(0.0, 1e-4 * static_cast<int>(slot.side));
  TwoCycles through;
  through.before.proxy = dvec2(x, mouth) - step;
  through.now.proxy = dvec2(x, mouth) + step;
  return through;
}

}  // namespace

TEST_CASE("planted: checks that reject an allowed configuration") {
  CampaignCase drawn = plain_case(5);
  drawn.haptics.rate = 50.0;  // never drawn
  CHECK_THROWS_AS(run_case(drawn, layouts()), std::runtime_error);
  drawn = plain_case(5);
  drawn.haptics.guard.slew = 1.9;
  CHECK(run_case(drawn, layouts()).refused.find("slew") != std::string::npos);
}

TEST_CASE("planted: with energy bounding a force may drop to zero at once, but not beyond") {
  LawLimits limits;
  limits.max_force = dvec2(31.7);
  limits.slew = 5.0;
  limits.can_drop_at_once = true;
  TwoCycles turn;
  turn.before.commanded = {30.0, 0.0};
  LawRecord record;
  for (const double now : {0.0, -4.9, 34.9}) {
    turn.now.commanded = {now, 0.0};
    slew_law(turn.pair(), limits, record);
    CHECK_FALSE(record.result(CampaignLaw::slew).broken());
  }
  turn.now.commanded = {-30.0, 0.0};
  slew_law(turn.pair(), limits, record);
  CHECK(record.result(CampaignLaw::slew).broken());
}

TEST_CASE("a law broken by NaN stays broken") {
  LawRecord record;
  record.note(CampaignLaw::slew, std::numeric_limits<double>::quiet_NaN(), 1.0, 0.1);
  record.note(CampaignLaw::slew, 0.5, 1.0, 0.2);
  CHECK(record.result(CampaignLaw::slew).broken());
  CHECK(record.result(CampaignLaw::slew).time == 0.1);
  // A bound that is NaN also breaks the law.
  record.note(CampaignLaw::quiet, 0.0, std::numeric_limits<double>::quiet_NaN(), 0.1);
  record.note(CampaignLaw::quiet, 0.5, 1.0, 0.2);
  CHECK(record.result(CampaignLaw::quiet).broken());
}

TEST_CASE("planted: a true motion of NaN breaks the energy law") {
  LawLimits limits;
  limits.energy_bounded = true;
  limits.damping = limits.min_damping = {5.0, 5.0};
  limits.period = limits.max_period = 0.001;
  LawRecord record;
  EnergyLaw law;
  TwoCycles cycles;
  cycles.now.guard = GuardState::running;
  law.update(cycles.pair(), {1e-5, 0.0}, limits, record);
  CHECK_FALSE(record.result(CampaignLaw::energy).broken());
  law.update(cycles.pair(), {std::numeric_limits<double>::quiet_NaN(), 0.0}, limits, record);
  CHECK(record.result(CampaignLaw::energy).broken());
}

TEST_CASE("planted: the paper's 5000 N/m at 100 Hz, forced with allow_unstable, is not quiet, and its trace replays") {
  CampaignCase drawn = plain_case(1);
  drawn.haptics.rate = 100.0;
  drawn.haptics.contact = {ContactHold::zero_order, EnergyControl::none, false, true};
  const TempFolder folder;
  const std::filesystem::path trace = folder / "case.trace";
  const CaseOutcome outcome = run_case(drawn, layouts(), trace);
  CAPTURE(outcome.ripple);
  CHECK(broken(outcome, CampaignLaw::quiet));
  CHECK(replays(trace));
}

TEST_CASE("a swing decays in every case: at half the rate of handle and hand, or to the width of a tremor") {
  CampaignCase drawn = plain_case(1);
  drawn.lever.hand = {2.19, 12.2, 1468.0};
  const LawLimits limits = law_limits(drawn.haptics, drawn.lever, DeviceSpec{});
  const double decay = (12.2 + 2.9) / (2.0 * (2.19 + 0.086));  // [1/s] decay rate damping / (2 mass) of the slower axis
  CHECK(limits.remaining_swing == doctest::Approx(std::exp(-0.5 * decay)));
  const auto is_broken = [&](double before, double after) {
    LawRecord record;
    fades_law(before, after, limits, 1.0, record);
    return record.result(CampaignLaw::fades).broken();
  };
  CHECK(is_broken(2.19e-3, 2.19e-3));
  CHECK(is_broken(1e-5, 1e-3));
  CHECK(is_broken(0.0, std::numeric_limits<double>::quiet_NaN()));
  CHECK_FALSE(is_broken(20e-3, 3.7e-3));
  CHECK_FALSE(is_broken(0.7e-3, 0.75e-3));
}

TEST_CASE("planted: a heavy hand in the paper's 5000 N/m at 100 Hz: nothing is promised, but its swing is detected") {
  CampaignCase drawn = plain_case(1);
  drawn.hand = CaseHand::heavy;
  drawn.lever.hand = {1.0, 10.0, 1000.0};
  drawn.haptics.rate = 100.0;
  drawn.haptics.contact = {ContactHold::zero_order, EnergyControl::none, false, true};
  const CaseOutcome outcome = run_case(drawn, layouts());
  CAPTURE(outcome.ripple);
  CHECK_FALSE(outcome.promised);
  CHECK(broken(outcome, CampaignLaw::fades));
}

TEST_CASE("a heavy hand that leans on the end of a slot, against the lock's spring, comes to rest") {
  const CampaignCase drawn = drawn_case(1, 297, static_cast<int>(layouts().size()));
  REQUIRE(drawn.hand == CaseHand::heavy);
  const CaseOutcome outcome = run_case(drawn, layouts());
  CHECK(outcome.ripple < 0.3e-3);
  CHECK_FALSE(broken(outcome, CampaignLaw::fades));
}

TEST_CASE("planted: a lever that still chatters after the last softening is stopped by the guard") {
  CampaignCase drawn = plain_case(1);
  drawn.haptics.rate = 250.0;
  drawn.haptics.contact = {ContactHold::zero_order, EnergyControl::none, true, true};
  drawn.haptics.tuning.aisle_damping = 50.0;  // unstable whatever the wall's stiffness
  drawn.haptics.tuning.limit_damping = 50.0;
  drawn.lever.delay = 3;
  CHECK(broken(run_case(drawn, layouts()), CampaignLaw::guard));
}

TEST_CASE("planted: a wall without energy bounding generates more than the damping dissipated; with it, never") {
  CampaignCase drawn = plain_case(2);
  const auto set_bounded = [](LawLimits& limits) { limits.energy_bounded = true; };
  CHECK(broken(run_case(drawn, layouts(), {}, set_bounded), CampaignLaw::energy));
  drawn.haptics.contact.energy_control = EnergyControl::energy_bounding;
  CHECK_FALSE(broken(run_case(drawn, layouts()), CampaignLaw::energy));
}

TEST_CASE("planted: a device of 60 N instead of 31.7 N, and a slew above its limit") {
  CampaignCase drawn = plain_case(3);
  drawn.lever.actuator.peak_force = 60.0;
  drawn.manner.last_push = 70.0;
  const auto set_bounded = [](LawLimits& limits) {
    limits.max_force = dvec2(31.7);
    limits.slew = 0.5;
  };
  const CaseOutcome outcome = run_case(drawn, layouts(), {}, set_bounded);
  CHECK(broken(outcome, CampaignLaw::force));
  CHECK(broken(outcome, CampaignLaw::slew));
  CHECK_FALSE(run_case(drawn, layouts()).laws.any_broken());
}

TEST_CASE("planted: a proxy in a wall, a proxy that moves through a wall, and NaN") {
  const Gate gate = paper_gate();
  LawLimits limits;
  LawRecord record;
  TwoCycles inside_wall;
  inside_wall.now.proxy = {0.5 * (gate.column[0].center + gate.column[1].center), gate.half_aisle + 0.005};
  REQUIRE_FALSE(in_free_space(gate, inside_wall.now.proxy));
  free_space_law(inside_wall.pair(), gate, record);
  CHECK(record.result(CampaignLaw::free_space).broken());

  // The lever jumps from one slot to the next in one cycle. Both positions are in free space, with a wall between them.
  TwoCycles through;
  const double deep = gate.half_aisle + 0.02;
  through.before.proxy = through.before.lever = {gate.column[0].center, deep};
  through.now.proxy = through.now.lever = {gate.column[1].center, deep};
  REQUIRE(in_free_space(gate, through.before.proxy));
  REQUIRE(in_free_space(gate, through.now.proxy));
  no_wall_law(through.pair(), gate, limits, record);
  CHECK(record.result(CampaignLaw::no_wall).broken());

  // The lever jumps between a point deep in a slot and the aisle in front of the next slot, in both directions. A
  // corner of the wall is between the points.
  for (const bool is_back : {false, true}) {
    LawRecord round;
    TwoCycles corner = through;
    (is_back ? corner.before : corner.now).proxy.y = (is_back ? corner.before : corner.now).lever.y = 0.0;
    no_wall_law(corner.pair(), gate, limits, round);
    CHECK(round.result(CampaignLaw::no_wall).broken());
  }

  // A path from just inside the slot's mouth to the line between slot and aisle (to within rounding) is allowed, and so
  // is the reverse path. Such a path occurs in case 6661 of the campaign with seed 1.
  for (const bool is_back : {false, true}) {
    LawRecord along;
    TwoCycles mouth;
    const double x = gate.column[0].center;
    mouth.before.proxy = mouth.before.lever = {x, gate.half_aisle + 1.1e-6};
    mouth.now.proxy = mouth.now.lever = {x + 1e-4, gate.half_aisle + 1.5e-10};
    if (is_back) std::swap(mouth.before, mouth.now);
    limits.period = 0.0;
    no_wall_law(mouth.pair(), gate, limits, along);
    CHECK_FALSE(along.result(CampaignLaw::no_wall).broken());
  }

  TwoCycles none;
  none.now.commanded.x = std::numeric_limits<double>::quiet_NaN();
  finite_law(none.pair(), record);
  CHECK(record.result(CampaignLaw::finite).broken());
}

TEST_CASE("planted: through a closed lockout; passing one that the hand opens is allowed") {
  const Gate gate = shipped_gate("six_speed_r_left_up");
  const TwoCycles through = through_lockout(gate, {LockoutKind::push_down, LockoutKind::lift});
  LawRecord record;
  LockoutLaw law;
  law.update({through.now, through.before, true, true}, gate, record);
  CHECK_FALSE(record.result(CampaignLaw::lockout).broken());
  law.update(through.pair(), gate, record);
  CHECK(record.result(CampaignLaw::lockout).broken());
}

// In dog_leg_five.toml, the lockout closes above 20 km/h and opens below 15 km/h.
TEST_CASE("planted: through a lockout that the road speed closed and has not opened yet") {
  const Gate gate = shipped_gate("dog_leg_five");
  TwoCycles through = through_lockout(gate, {LockoutKind::speed});
  // speeds: [km/h], the lever passes the lockout at the last speed.
  const auto is_broken = [&](std::initializer_list<double> speeds) {
    LawRecord record;
    LockoutLaw law;
    TwoCycles stays = through;
    stays.now.proxy = stays.before.proxy;
    for (const double& speed : speeds) {
      const bool is_last = &speed == speeds.end() - 1;
      TwoCycles& cycles = is_last ? through : stays;
      cycles.before.road_speed = speed / 3.6;
      law.update({cycles.now, cycles.before, true, true}, gate, record);
    }
    return record.result(CampaignLaw::lockout).broken();
  };
  CHECK_FALSE(is_broken({0.0}));
  CHECK(is_broken({21.0}));
  CHECK(is_broken({-21.0}));
  CHECK(is_broken({21.0, 18.0}));
  CHECK_FALSE(is_broken({19.0, 18.0}));
  CHECK_FALSE(is_broken({21.0, 14.0, 18.0}));
}

TEST_CASE("planted: a gear that toggles while nothing moves") {
  const Gate gate = paper_gate();
  TwoCycles flicker;
  flicker.now.proxy = flicker.before.proxy = rest_position(gate, 1);
  flicker.now.gear = 1;
  LawRecord record;
  GearLaw law;
  law.update(flicker.pair(), gate, false, record);  // engages
  CHECK_FALSE(record.result(CampaignLaw::gear_holds).broken());
  std::swap(flicker.now, flicker.before);
  law.update(flicker.pair(), gate, false, record);
  std::swap(flicker.now, flicker.before);
  law.update(flicker.pair(), gate, false, record);  // the gear engages again although the lever has not left the slot
  CHECK(record.result(CampaignLaw::gear_holds).broken());
}

TEST_CASE("a hand has enough time for its effort to exceed an aisle spring of four times its force") {
  const CampaignCase drawn = drawn_case(1, 6714, static_cast<int>(layouts().size()));
  REQUIRE(drawn.haptics.tuning.feel_scale > 3.5);
  CHECK_FALSE(broken(run_case(drawn, layouts()), CampaignLaw::reached));
}

TEST_CASE("planted: a stuck lever misses gears that are cleanly aimed at") {
  CampaignCase drawn = plain_case(4);
  CHECK_FALSE(broken(run_case(drawn, layouts()), CampaignLaw::reached));
  drawn.lever.coulomb_friction = 100.0;
  CHECK(broken(run_case(drawn, layouts()), CampaignLaw::reached));
}
