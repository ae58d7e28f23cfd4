// This work is based on:
// Laszlo Lovas, Daniel Play, Janos Marialigeti, Jean-Francois Rigal. Mechanical behaviour simulation for synchromesh
//   mechanism improvements. 2006 (phases; the second bump and its dispersion)
// Guy L. Steele, Doug Lea, Christine H. Flood. Fast Splittable Pseudorandom Number Generators. 2014
#include "app/vehicle/synchroniser.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace gearshift {
namespace {

// Stations as shares of the way from the detent's crest to where the gear counts.
constexpr double kBlock = 0.20;
constexpr double kOut = 0.35;
constexpr double kDogs = 0.45;
constexpr double kHome = 0.95;

constexpr double kTouch = 1e-6;            // [m] a lever this near to a wall is at it
constexpr double kStrutForce = 80.0;       // [N] on the ring by its struts, while the sleeve is on its way through it
constexpr double kBackTaper = 0.07;        // [1] of the dogs, tangent: holds the sleeve under load
constexpr double kDrawOut = 20.0;          // [N s/m] a pull beyond the load's friction draws the sleeve out that slowly
constexpr double kLeastLock = 0.2;         // [N] nobody feels less
constexpr double kPushTime = 0.010;        // [s] of the filter of the push
constexpr double kBumpShare = 1.0 / 3.0;   // [1] of the effort, the most that the second bump may have
constexpr double kBumpStiffness = 2000.0;  // [N/m] the most that the bump rises by
constexpr double kQuietMass = 0.03;        // [kg] 0.35 of the lever's: K <= 0.35 m / T^2 keeps a bare lever quiet
constexpr double kRattleShare = 0.25;      // [1] of the push
constexpr double kLeastRattle = 0.01;      // [N] and then it is over
constexpr double kRattleMost = 4.0;        // [N]
constexpr double kRattleRate = 120.0;      // [Hz] a hand feels nothing above
constexpr double kRattleSamples = 8.0;     // [cycles] of a rattle's period, at least

double smooth_step(double u) noexcept {
  u = std::clamp(u, 0.0, 1.0);
  return u * u * (3.0 - 2.0 * u);
}

// SplitMix64: the next number of a row, 0 to 1.
double draw(std::uint64_t& state) noexcept {
  std::uint64_t z = state += 0x9E3779B97F4A7C15;
  z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9;
  z = (z ^ (z >> 27)) * 0x94D049BB133111EB;
  return static_cast<double>((z ^ (z >> 31)) >> 11) * 0x1.0p-53;
}

}  // namespace

SleeveStations sleeve_stations(const Slot& slot) noexcept {
  const double way = slot.engage_depth - slot.release_depth;
  const auto at = [&](double share) { return slot.release_depth + share * way; };
  return {slot.release_depth, at(kBlock), at(kOut), at(kDogs), at(kHome)};
}

// T_c = n F mu R / sin a
double cone_gain(const SynchroSpec& synchro) noexcept {
  return synchro.cones * synchro.friction * synchro.radius / std::sin(synchro.cone_angle);
}

// T_I = F R_I (cos b - mu_I sin b) / (sin b + mu_I cos b)
double index_gain(const SynchroSpec& synchro) noexcept {
  const double sine = std::sin(synchro.pointing_angle), cosine = std::cos(synchro.pointing_angle);
  const double mu = synchro.index_friction;
  return synchro.index_radius * (cosine - mu * sine) / (sine + mu * cosine);
}

// Both torques grow with the push: which of them is larger does not depend on it.
double critical_friction(const SynchroSpec& synchro) noexcept {
  return synchro.friction * index_gain(synchro) / cone_gain(synchro);
}

Synchroniser::Synchroniser(const SynchroSpec& synchro, const Gate& gate, double force_scale, int meshed,
                           std::uint64_t seed)
    : synchro_(synchro),
      gate_(gate),
      scale_(force_scale),
      cone_gain_(cone_gain(synchro)),
      ring_holds_(cone_gain(synchro) > index_gain(synchro)),
      chance_(seed),
      meshed_(meshed) {}

SleeveOutput Synchroniser::step(const SleeveInput& in, double period) noexcept {
  if (!started_ || in.slot != slot_) enter(in.slot);
  started_ = true;
  filter(in, period);
  if (slot_ != kNoSlot) follow(in);
  SleeveOutput out;
  out.depth_max = std::numeric_limits<double>::max();
  out.meshed = meshed_;
  out.phase = phase(in);
  if (slot_ != kNoSlot && !is_meshed()) {
    out.cone_torque = cone_torque(in) + rattle_torque(in);
    out.cone_gear = out.cone_torque > 0.0 ? slot_of(gate_, slot_).gear : kNeutralGear;
    out.depth_max = ring_blocks(in) ? at_.block : at_.dogs;
    out.grind_power = rattle_torque(in) * std::abs(in.difference);
  }
  if (is_meshed()) hold_under_load(in, period, out);
  out.rattle = -rattle_force(in, period);
  out.force = bump_force(in.depth) + out.rattle;
  return out;
}

void Synchroniser::enter(int slot) noexcept {
  slot_ = slot;
  if (!is_meshed()) meshed_ = kNeutralGear;
  at_ = slot != kNoSlot ? sleeve_stations(slot_of(gate_, slot)) : SleeveStations{};
  passed_ = false;
  effort_ = bump_ = hold_ = 0.0;
}

// The sleeve's history in its slot: through the ring, in the dogs, out of them.
void Synchroniser::follow(const SleeveInput& in) noexcept {
  if (is_meshed()) {
    if (in.depth < at_.out) meshed_ = kNeutralGear;
    if (in.depth >= at_.home) bump_ = 0.0;
    passed_ = true;
  }
  if (in.depth < at_.block) passed_ = false;
  if (in.depth > at_.block + kTouch && !ring_blocks(in)) passed_ = true;
  effort_ = in.depth < at_.crest ? 0.0 : std::max(effort_, push_);
  if (!is_meshed() && in.depth >= at_.dogs - kTouch && matches(in)) mesh(in.depth);
}

// Where tooth meets tooth is chance: the gear has to be turned aside by up to half a tooth, one way or the other.
void Synchroniser::mesh(double depth) noexcept {
  meshed_ = slot_of(gate_, slot_).gear;
  hold_ = depth;
  const double aside = std::abs(2.0 * draw(chance_) - 1.0);
  const double stiffness = std::min(kBumpStiffness, kQuietMass / (period_ * period_));
  const double most = stiffness * (at_.home - at_.dogs) / std::numbers::pi;  // see bump_force
  bump_ = depth < at_.home ? std::min(kBumpShare * effort_ * aside, most) : 0.0;
}

void Synchroniser::filter(const SleeveInput& in, double period) noexcept {
  if (period != period_) {
    period_ = period;
    follows_ = 1.0 - std::exp(-period / kPushTime);
  }
  push_ += (std::max(0.0, in.push) - push_) * follows_;
}

bool Synchroniser::is_meshed() const noexcept {
  return slot_ != kNoSlot && meshed_ == slot_of(gate_, slot_).gear;
}

bool Synchroniser::matches(const SleeveInput& in) const noexcept {
  return std::abs(in.difference) <= synchro_.dog_speed;
}

// The cone's torque keeps the ring turned into the sleeve's way as long as there is a difference of speeds. A lever that
// is past it within one cycle was not let through: it is held where it is. Reverse has no ring.
bool Synchroniser::ring_blocks(const SleeveInput& in) const noexcept {
  return ring_holds_ && !passed_ && !matches(in) && slot_of(gate_, slot_).gear != kReverseGear;
}

bool Synchroniser::clashes(const SleeveInput& in) const noexcept {
  return slot_ != kNoSlot && !is_meshed() && in.depth >= at_.dogs - kTouch && !ring_blocks(in);
}

SyncPhase Synchroniser::phase(const SleeveInput& in) const noexcept {
  if (slot_ == kNoSlot || in.depth < at_.crest) return SyncPhase::free;
  if (is_meshed()) return bump_ > 0.0 ? SyncPhase::second_bump : SyncPhase::meshed;
  if (clashes(in)) return SyncPhase::clashing;
  if (slot_of(gate_, slot_).gear == kReverseGear) return SyncPhase::free;
  if (passed_) return SyncPhase::passing;
  if (in.depth < at_.block - kTouch) return SyncPhase::indexing;
  return ring_blocks(in) ? SyncPhase::synchronising : SyncPhase::passing;
}

// [N] on the sleeve in the real box, by a push at the device's knob.
double Synchroniser::sleeve_force(double push) const noexcept {
  return std::max(0.0, push) / scale_ * synchro_.lever_ratio * synchro_.efficiency;
}

// The push, once the detent has given way, growing smoothly until the ring blocks; then, on the way through the ring,
// what its struts press: enough to hold the shaft's speed against the oil.
double Synchroniser::cone_torque(const SleeveInput& in) const noexcept {
  if (slot_of(gate_, slot_).gear == kReverseGear || in.depth < at_.crest) return 0.0;
  if (passed_) return cone_gain_ * kStrutForce;
  return cone_gain_ * sleeve_force(in.push) * smooth_step((in.depth - at_.crest) / (at_.block - at_.crest));
}

// Dogs that slip on each other rub. So reverse goes in at last with the clutch down, and a worn gear too.
double Synchroniser::rattle_torque(const SleeveInput& in) const noexcept {
  if (!clashes(in)) return 0.0;
  return synchro_.index_friction * synchro_.index_radius * sleeve_force(in.push);
}

// [N] at the device's knob, to draw the gear out against the friction and the taper of its loaded dogs.
double Synchroniser::lock_force(const SleeveInput& in) const noexcept {
  if (in.clutch_open) return 0.0;
  const double sleeve = std::abs(in.load) * (synchro_.index_friction + kBackTaper) / synchro_.index_radius;
  return scale_ * sleeve / (synchro_.lever_ratio * synchro_.efficiency);
}

// A friction that holds the sleeve where it is: a wall that follows the lever inwards, and gives way outwards only to a
// pull that overcomes it.
void Synchroniser::hold_under_load(const SleeveInput& in, double period, SleeveOutput& out) noexcept {
  const double lock = lock_force(in);
  out.torque_locked = lock > scale_ * kHandMost;
  hold_ = std::max(hold_, in.depth);
  const double beyond = -(in.push + in.feel) - lock;
  if (beyond > 0.0 && !out.torque_locked) hold_ -= period * beyond / kDrawOut;
  if (lock < kLeastLock) hold_ = in.depth;
  out.depth_min = lock < kLeastLock ? 0.0 : hold_;
}

// A bump sin^2 over depth, continuous with its slope, felt on the way in alone: steepest pi peak / width.
double Synchroniser::bump_force(double depth) const noexcept {
  if (bump_ == 0.0 || depth <= at_.dogs || depth >= at_.home) return 0.0;
  const double sine = std::sin(std::numbers::pi * (depth - at_.dogs) / (at_.home - at_.dogs));
  return -bump_ * sine * sine;
}

// Of dogs that clash, at the rate at which teeth pass, as far as a hand feels it. It only ever pushes back.
double Synchroniser::rattle_force(const SleeveInput& in, double period) noexcept {
  const bool on = clashes(in);
  const double target = on ? std::min(kRattleShare * push_, kRattleMost) : 0.0;
  rattle_ += (target - rattle_) * follows_;
  if (!on && rattle_ < kLeastRattle) return rattle_ = 0.0;
  const double teeth_pass = std::abs(in.difference) * synchro_.teeth / (2.0 * std::numbers::pi);
  const double most = period > 0.0 ? std::min(kRattleRate, 1.0 / (kRattleSamples * period)) : kRattleRate;
  if (on) rattle_phase_ += 2.0 * std::numbers::pi * period * std::min(teeth_pass, most);
  rattle_phase_ = std::remainder(rattle_phase_, 2.0 * std::numbers::pi);
  return 0.5 * rattle_ * (1.0 - std::cos(rattle_phase_));
}

}  // namespace gearshift
