// This work is based on:
// G. L. Steele, D. Lea, C. H. Flood. Fast Splittable Pseudorandom Number Generators. 2014
#include "app/lab/campaign/campaign_case.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "app/lab/campaign/chance.h"
#include "app/lab/contact/contact_campaign.h"

namespace gearshift::lab {
namespace {

constexpr std::uint64_t kWideSeed = 0x8f14e45fceea167a;  // makes the draws of widen() independent of all other draws
constexpr std::uint64_t kGripSeed = 0x5851f42d4c957f2d;  // makes the grips' draws independent of all other draws
constexpr std::uint64_t kHandSeed = 0x2ab7e1516289d2f3;  // makes the draws of any hand independent of all other draws
constexpr double kElasticFraction = 0.3;                 // [1] of the cases with a hand
constexpr double kCountPerDegree =
    haptics::YokeGeometry{}.radius * std::numbers::pi / 180.0;  // [m] motion of the tip per degree

haptics::HandImpedance hand_of(CaseHand kind, Chance& chance) {
  switch (kind) {
    case CaseHand::bare:
      return haptics::kBareHand;
    case CaseHand::light:
      return haptics::kLightHand;
    case CaseHand::arm:
      return haptics::kArmHand;
    case CaseHand::heavy:
      return {chance.between(1.0, 3.0), chance.between(10.0, 40.0), chance.between(500.0, 1500.0)};
    case CaseHand::stiff:
      return {chance.between(0.1, 0.4), chance.between(15.0, 40.0), chance.between(1000.0, 3000.0)};
    case CaseHand::grip:
    case CaseHand::nervous:
    case CaseHand::hasty:
    case CaseHand::any:
      return haptics::kGripHand;
  }
  return haptics::kGripHand;
}

CaseManner manner_of(CaseHand kind, Chance& chance) {
  CaseManner manner;
  const bool is_hasty = kind == CaseHand::hasty;
  manner.pace = is_hasty ? chance.between(0.4, 1.2) : chance.between(0.15, 0.35);
  manner.aim_noise = is_hasty || chance.happens(0.3) ? chance.between(0.0, 0.003) : 0.0;
  manner.overshoot = is_hasty ? chance.between(0.002, 0.010) : 0.0;
  manner.tremor = kind == CaseHand::nervous ? chance.decades(0.02, 0.3) : 0.0;
  manner.tremor_rate = chance.between(8.0, 12.0);
  manner.wrong_aims = chance.happens(0.5) ? chance.between(0.0, 0.3) : 0.0;
  manner.side_pushes = chance.between(0.0, 0.3);
  manner.hardest_push = chance.decades(5.0, 150.0);
  manner.last_push = chance.decades(5.0, 150.0);
  manner.leans_aside = chance.happens(0.5);
  return manner;
}

// Each value keeps its default with probability 0.5.
haptics::HapticTuning tuning_of(Chance& chance) {
  haptics::HapticTuning tuning;
  if (chance.happens(0.5)) tuning.wall_stiffness = chance.decades(100.0, 20000.0);
  if (chance.happens(0.5)) tuning.wall_damping = chance.between(0.0, 100.0);
  if (chance.happens(0.5)) tuning.feel_scale = chance.between(0.0, 4.0);
  if (chance.happens(0.5)) tuning.aisle_damping = chance.between(0.0, 50.0);
  if (chance.happens(0.5)) tuning.speed_limit = chance.decades(0.05, 5.0);
  if (chance.happens(0.5)) tuning.limit_damping = chance.between(0.0, 50.0);
  return tuning;
}

haptics::ContactConfig contact_of(Chance& chance) {
  haptics::ContactConfig contact;
  if (chance.happens(0.3)) contact.hold = static_cast<haptics::ContactHold>(chance.below(4));
  if (chance.happens(0.25)) contact.energy_control = haptics::EnergyControl::energy_bounding;
  if (chance.happens(0.02)) contact.energy_control = haptics::EnergyControl::passivity_controller;  // must be rejected
  return contact;
}

haptics::HapticConfig haptics_of(Chance& chance) {
  haptics::HapticConfig config;
  config.rate = chance.decades(250.0, 4000.0);
  config.tuning = tuning_of(chance);
  config.contact = contact_of(chance);
  if (chance.happens(0.2)) config.estimator.smoothing = chance.decades(1e-5, 1.0);
  if (chance.happens(0.02))
    config.estimator.window = 1 + chance.below(haptics::kMaxWindow);  // a window above 1 needs allow_unstable
  if (chance.happens(0.2)) config.guard.slew = chance.decades(1.5, 100.0);
  config.guard.ramp_time = chance.decades(0.001, 0.5);
  if (chance.happens(0.2)) config.guard.stale_time = chance.decades(0.001, 1.0);
  if (chance.happens(0.2)) config.guard.position_margin = chance.between(0.0, 0.05);
  if (chance.happens(0.2)) config.gear_debounce = chance.between(0.0, 0.2);
  return config;
}

// Multiplies mass, damping and stiffness by random factors from 0.5 to 2.
haptics::AxisModel other_axis(haptics::AxisModel axis, Chance& chance) {
  axis.mass *= chance.decades(0.5, 2.0);
  axis.damping *= chance.decades(0.5, 2.0);
  axis.stiffness *= chance.decades(0.5, 2.0);
  return axis;
}

haptics::SimulatedLeverConfig lever_of(CaseHand kind, std::uint64_t seed, Chance& chance) {
  haptics::SimulatedLeverConfig lever;
  lever.seed = seed;
  lever.hand = hand_of(kind, chance);
  lever.delay = chance.below(4);
  const bool is_promised = chance.happens(0.7);  // true: within the stability check's 5 % plant error and 10 % jitter
  lever.model_error = chance.between(0.0, is_promised ? 0.05 : 0.2);
  if (chance.happens(0.6)) lever.period_jitter = chance.between(0.0, is_promised ? 0.1 : 0.5);
  if (chance.happens(0.7)) lever.encoder_counts = kCountPerDegree / chance.decades(1e-6, 0.5e-3);
  if (chance.happens(0.05)) lever.encoder_counts = 0.0;
  if (chance.happens(0.15)) lever.coulomb_friction = chance.between(0.0, 1.0);
  if (chance.happens(0.15)) lever.device_wall_stiffness = chance.between(100.0, 3000.0);
  if (chance.happens(0.2)) lever.axis_x = other_axis(lever.axis_x, chance);
  if (chance.happens(0.2)) lever.axis_y = other_axis(lever.axis_y, chance);
  if (chance.happens(0.15)) lever.actuator.peak_force = chance.between(15.0, 60.0);
  if (chance.happens(0.8)) lever.actuator.overload_time = 1e4;  // [s] never overheats
  return lever;
}

// Draws further settings from their whole allowed ranges. The functions above draw them from narrower ranges or not at
// all.
// The estimator's speed limit is at least 10 m/s: the motors can accelerate a bare handle to that speed between the
// stops, and a reading above the limit is a fault.
void widen(CampaignCase& drawn, Chance& chance) {
  drawn.is_wide = true;
  haptics::HapticConfig& haptics = drawn.haptics;
  haptics.rate = chance.decades(100.0, 4000.0);
  haptics.gear_debounce = chance.between(0.0, 0.5);
  haptics.ghost_offset = chance.between(0.0, 1.0);
  haptics.guard.ramp_time = chance.decades(0.001, 60.0);
  haptics.guard.fade_time = chance.decades(0.001, 1.0);
  haptics.guard.overruns_in_row = 1 + chance.below(1000);
  haptics.guard.damped_damping = chance.between(0.0, 50.0);
  haptics.guard.position_margin = chance.between(0.0, 1.0);
  haptics.over_push.warn_above = chance.decades(1.0, 1000.0);
  haptics.over_push.clear_below = chance.between(0.0, haptics.over_push.warn_above);
  if (chance.happens(0.2)) haptics.estimator.speed_limit = chance.decades(10.0, 1000.0);
  drawn.lever.delay = chance.below(9);
  if (chance.happens(0.3)) drawn.lever.model_error = chance.between(0.0, 0.5);
  drawn.has_car = chance.happens(0.5);
}

}  // namespace

std::uint64_t case_seed(std::uint64_t campaign_seed, std::uint64_t number) noexcept {
  std::uint64_t z = campaign_seed + (number + 1) * 0x9e3779b97f4a7c15;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
  z = (z ^ (z >> 27)) * 0x94d049bb133111eb;
  return z ^ (z >> 31);
}

CampaignCase drawn_case(std::uint64_t campaign_seed, std::uint64_t number, int shipped_gates) {
  CampaignCase drawn;
  drawn.number = number;
  drawn.seed = case_seed(campaign_seed, number);
  Chance chance(drawn.seed);
  if (chance.happens(0.2)) drawn.shipped_gate = chance.below(shipped_gates);
  drawn.hand = static_cast<CaseHand>(chance.below(static_cast<int>(CaseHand::any)));
  if (drawn.hand == CaseHand::bare) drawn.shifts = 0;
  drawn.manner = manner_of(drawn.hand, chance);
  drawn.haptics = haptics_of(chance);
  drawn.lever = lever_of(drawn.hand, drawn.seed, chance);
  Chance wide_chance(drawn.seed ^ kWideSeed);
  if (number % kWideEvery == kFirstWide) widen(drawn, wide_chance);
  if (drawn.hand != CaseHand::bare && number % kAnyHandEvery == kFirstAnyHand) {
    Chance hand_chance(drawn.seed ^ kHandSeed);
    const double mass = hand_chance.between(0.0, 1.0), stiffness = hand_chance.between(0.0, 1.0);
    drawn.hand = CaseHand::any;
    drawn.lever.hand = any_hand({mass, stiffness, hand_chance.between(0.0, 1.0)});
  }
  Chance grip_chance(drawn.seed ^ kGripSeed);
  drawn.is_elastic = drawn.hand != CaseHand::bare && grip_chance.happens(kElasticFraction);
  const std::array<double, 3> grip{grip_chance.between(0.0, 1.0), grip_chance.between(0.0, 1.0),
                                   grip_chance.between(0.0, 1.0)};
  if (drawn.is_elastic) drawn.lever.hand = with_grip(drawn.lever.hand, grip);
  return drawn;
}

bool is_forbidden(const CampaignCase& drawn) noexcept {
  const haptics::HapticConfig& config = drawn.haptics;
  return config.estimator.window > 1 || config.contact.energy_control == haptics::EnergyControl::passivity_controller ||
         config.guard.slew < 2.0;
}

double count_of(const CampaignCase& drawn) noexcept {
  return drawn.lever.encoder_counts > 0.0 ? kCountPerDegree / drawn.lever.encoder_counts : 0.0;
}

}  // namespace gearshift::lab
