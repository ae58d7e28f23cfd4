// This work is based on:
// Laszlo Lovas, Daniel Play, Janos Marialigeti, Jean-Francois Rigal. Mechanical behaviour simulation for synchromesh
//   mechanism improvements. 2006 (phases; the second bump and its dispersion)
// Guy L. Steele, Doug Lea, Christine H. Flood. Fast Splittable Pseudorandom Number Generators. 2014
#include "app/vehicle/synchroniser.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace gearshift::vehicle {
namespace {

// Stations as fractions of a way. The ring of an H gate blocks at a third of the lever's whole way from neutral to the
// gear, as in real cars. No source was found for the other stations. The dogs are close behind the ring, so that the
// speeds cannot drift apart on the way from ring to dogs.
struct StationFractions {
  double block, out, dogs, home;
};
constexpr StationFractions kFromMouth{0.10, 0.20, 0.24, 0.50};  // of the way from the end of the mouth to rest
// Fractions of the way from the detent's crest to the depth at which the gear counts. The drum of a sequential gate turns a new
// sleeve in only behind the crest; a place of a mechanism has no mouth.
constexpr StationFractions kFromCrest{0.20, 0.35, 0.45, 0.95};

constexpr double kContactTolerance = 1e-6;  // [m] a lever closer than this to a wall counts as touching it
constexpr double kStrutForce = 80.0;        // [N] force of the spring struts on the ring while the sleeve passes
constexpr double kBackTaper = 0.07;         // [1] tangent of the dogs' back taper, which holds the sleeve under load
// [N s/m] damping of the sleeve while a pull above the holding force draws it out
constexpr double kDrawOutDamping = 20.0;
constexpr double kMinLockForce = 0.2;         // [N] a smaller holding force cannot be felt and is dropped
constexpr double kPushFilterTime = 0.010;     // [s] time constant of the push filter
constexpr double kBumpFraction = 1.0 / 3.0;   // [1] largest force of the second bump divided by the peak push
constexpr double kMaxBumpStiffness = 2000.0;  // [N/m] largest slope of the bump
// [kg] 0.35 times the lever's mass. A lever that no hand holds does not buzz if the stiffness is at most kQuietMass /
// (cycle time)^2 (haptic_config.h).
constexpr double kQuietMass = 0.03;
constexpr double kRattleFraction = 0.25;   // [1] peak of the rattle divided by the push
constexpr double kMinRattle = 0.01;        // [N] rattle force below which the rattle ends
constexpr double kMaxRattle = 4.0;         // [N]
constexpr double kMaxRattleRate = 120.0;   // [Hz] a hand cannot feel a faster rattle
constexpr double kMinRattleSamples = 8.0;  // [cycles] smallest period of a rattle

double smooth_step(double u) noexcept {
  u = std::clamp(u, 0.0, 1.0);
  return u * u * (3.0 - 2.0 * u);
}

// Next pseudorandom number of SplitMix64, in the range from 0 (included) to 1 (excluded).
double draw(std::uint64_t& state) noexcept {
  std::uint64_t z = state += 0x9E3779B97F4A7C15;
  z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9;
  z = (z ^ (z >> 27)) * 0x94D049BB133111EB;
  return static_cast<double>((z ^ (z >> 31)) >> 11) * 0x1.0p-53;
}

}  // namespace

SleeveStations sleeve_stations(const haptics::Gate& gate, const haptics::Slot& slot) noexcept {
  const bool has_mouth = !haptics::is_sequential(gate) && !haptics::is_mechanism(gate);
  const StationFractions& fraction = has_mouth ? kFromMouth : kFromCrest;
  const double index = has_mouth ? gate.half_aisle + gate.chamfer : slot.release_depth;
  const double length = (has_mouth ? slot.rest : slot.engage_depth) - index;
  return {index, index + fraction.block * length, index + fraction.out * length, index + fraction.dogs * length,
          index + fraction.home * length};
}

// Cone torque divided by the force F on the sleeve. The torque of n cones is (n F mu R) / sin a, with friction mu,
// radius R and half-angle a.
double cone_gain(const SynchroSpec& synchro) noexcept {
  return synchro.cones * synchro.friction * synchro.radius / std::sin(synchro.cone_angle);
}

// Torque of the ring's teeth divided by the force F on the sleeve. The torque is F R (cos b - mu sin b) / (sin b + mu
// cos b), with the teeth's radius R, pointing angle b and friction mu.
double index_gain(const SynchroSpec& synchro) noexcept {
  const double sine = std::sin(synchro.pointing_angle), cosine = std::cos(synchro.pointing_angle);
  const double mu = synchro.index_friction;
  return synchro.index_radius * (cosine - mu * sine) / (sine + mu * cosine);
}

Synchroniser::Synchroniser(const SynchroSpec& synchro, const haptics::Gate& gate, double force_scale, int meshed,
                           std::uint64_t seed)
    : synchro_(synchro),
      gate_(gate),
      scale_(force_scale),
      cone_gain_(cone_gain(synchro)),
      ring_can_block_(cone_gain(synchro) > index_gain(synchro)),
      random_(seed),
      meshed_(meshed) {}

SleeveOutput Synchroniser::step(const SleeveInput& in, double period) noexcept {
  if (!has_started_ || in.slot != slot_) enter_slot(in.slot);
  has_started_ = true;
  filter_push(in, period);
  if (slot_ != haptics::kNoSlot) update_mesh(in);
  SleeveOutput out;
  out.depth_max = std::numeric_limits<double>::max();
  out.meshed = meshed_;
  out.phase = phase(in);
  if (slot_ != haptics::kNoSlot && !is_meshed()) {
    out.cone_torque = cone_torque(in) + rattle_torque(in);
    out.cone_gear = out.cone_torque > 0.0 ? haptics::slot_of(gate_, slot_).gear : haptics::kNeutralGear;
    out.depth_max = ring_blocks(in) ? at_.block : at_.dogs;
    out.grind_power = rattle_torque(in) * std::abs(in.difference);
  }
  if (is_meshed()) hold_under_load(in, period, out);
  out.rattle = -rattle_force(in, period);
  out.force = bump_force(in.depth) + out.rattle;
  return out;
}

void Synchroniser::enter_slot(int slot) noexcept {
  slot_ = slot;
  if (!is_meshed()) meshed_ = haptics::kNeutralGear;
  at_ = slot != haptics::kNoSlot ? sleeve_stations(gate_, haptics::slot_of(gate_, slot)) : SleeveStations{};
  has_passed_ring_ = false;
  peak_push_ = bump_ = held_depth_ = 0.0;
}

// Tracks the sleeve in its slot: through the ring, into the dogs and out of them.
void Synchroniser::update_mesh(const SleeveInput& in) noexcept {
  if (is_meshed()) {
    if (in.depth < at_.out) meshed_ = haptics::kNeutralGear;
    if (in.depth >= at_.home) bump_ = 0.0;
    has_passed_ring_ = true;
  }
  if (in.depth < at_.block) has_passed_ring_ = false;
  if (in.depth > at_.block + kContactTolerance && !ring_blocks(in)) has_passed_ring_ = true;
  peak_push_ = in.depth < at_.index ? 0.0 : std::max(peak_push_, push_);
  if (!is_meshed() && in.depth >= at_.dogs - kContactTolerance && speeds_match(in)) mesh(in.depth);
}

// Engages the slot's gear and sets the force of the second bump. That force depends on the teeth's relative position,
// which is random: the sleeve must turn the gear by up to half a tooth in either direction.
void Synchroniser::mesh(double depth) noexcept {
  meshed_ = haptics::slot_of(gate_, slot_).gear;
  held_depth_ = depth;
  const double aside = std::abs(2.0 * draw(random_) - 1.0);
  const double stiffness = std::min(kMaxBumpStiffness, kQuietMass / (period_ * period_));
  const double limit = stiffness * (at_.home - at_.dogs) / std::numbers::pi;  // see bump_force
  bump_ = depth < at_.home ? std::min(kBumpFraction * peak_push_ * aside, limit) : 0.0;
}

void Synchroniser::filter_push(const SleeveInput& in, double period) noexcept {
  if (period != period_) {
    period_ = period;
    filter_gain_ = 1.0 - std::exp(-period / kPushFilterTime);
  }
  push_ += (std::max(0.0, in.push) - push_) * filter_gain_;
}

bool Synchroniser::is_meshed() const noexcept {
  return slot_ != haptics::kNoSlot && meshed_ == haptics::slot_of(gate_, slot_).gear;
}

bool Synchroniser::speeds_match(const SleeveInput& in) const noexcept {
  return std::abs(in.difference) <= synchro_.dog_speed;
}

// The cone torque keeps the ring in the sleeve's way as long as the speeds differ. A lever that jumps past the ring
// within one cycle has not passed it: the ring still blocks, and a wall holds the lever at the ring's depth. Reverse
// has no ring.
bool Synchroniser::ring_blocks(const SleeveInput& in) const noexcept {
  return ring_can_block_ && !has_passed_ring_ && !speeds_match(in) &&
         haptics::slot_of(gate_, slot_).gear != haptics::kReverseGear;
}

bool Synchroniser::dogs_clash(const SleeveInput& in) const noexcept {
  return slot_ != haptics::kNoSlot && !is_meshed() && in.depth >= at_.dogs - kContactTolerance && !ring_blocks(in);
}

SyncPhase Synchroniser::phase(const SleeveInput& in) const noexcept {
  if (slot_ == haptics::kNoSlot || in.depth < at_.index) return SyncPhase::free;
  if (is_meshed()) return bump_ > 0.0 ? SyncPhase::second_bump : SyncPhase::meshed;
  if (dogs_clash(in)) return SyncPhase::clashing;
  if (haptics::slot_of(gate_, slot_).gear == haptics::kReverseGear) return SyncPhase::free;
  if (has_passed_ring_) return SyncPhase::passing;
  if (in.depth < at_.block - kContactTolerance) return SyncPhase::indexing;
  return ring_blocks(in) ? SyncPhase::synchronising : SyncPhase::passing;
}

// Force on the sleeve of the real gearbox [N] that corresponds to a push on the device's knob [N].
double Synchroniser::sleeve_force(double push) const noexcept {
  return std::max(0.0, push) / scale_ * synchro_.lever_ratio * synchro_.efficiency;
}

// The cone torque is proportional to the push. It fades in smoothly from the mouth to the depth at which the ring blocks. While the sleeve moves through the ring, the spring struts press on the ring with enough force to hold the
// shaft's speed against oil drag.
double Synchroniser::cone_torque(const SleeveInput& in) const noexcept {
  if (haptics::slot_of(gate_, slot_).gear == haptics::kReverseGear || in.depth < at_.index) return 0.0;
  if (has_passed_ring_) return cone_gain_ * kStrutForce;
  return cone_gain_ * sleeve_force(in.push) * smooth_step((in.depth - at_.index) / (at_.block - at_.index));
}

// Torque of clashing dogs, which rub until their speeds match. So with the clutch down, even reverse or a gear with a
// worn synchroniser eventually goes in.
double Synchroniser::rattle_torque(const SleeveInput& in) const noexcept {
  if (!dogs_clash(in)) return 0.0;
  return synchro_.index_friction * synchro_.index_radius * sleeve_force(in.push);
}

// Force at the device's knob [N] needed to pull the gear out, against friction and back taper of the loaded dogs.
double Synchroniser::lock_force(const SleeveInput& in) const noexcept {
  if (in.clutch_open) return 0.0;
  const double sleeve = std::abs(in.load) * (synchro_.index_friction + kBackTaper) / synchro_.index_radius;
  return scale_ * sleeve / (synchro_.lever_ratio * synchro_.efficiency);
}

// Renders the friction that holds a loaded sleeve as a wall. The wall follows the lever inwards, and yields outwards
// only to a pull above lock_force().
void Synchroniser::hold_under_load(const SleeveInput& in, double period, SleeveOutput& out) noexcept {
  const double lock = lock_force(in);
  out.torque_locked = lock > scale_ * kMaxHandForce;
  held_depth_ = std::max(held_depth_, in.depth);
  const double beyond = -(in.push + in.feel) - lock;
  if (beyond > 0.0 && !out.torque_locked) held_depth_ = std::max(0.0, held_depth_ - period * beyond / kDrawOutDamping);
  if (lock < kMinLockForce) held_depth_ = in.depth;
  out.depth_min = lock < kMinLockForce ? 0.0 : held_depth_;
}

// Force of the second bump, only on the way in. It follows sin^2 of the depth, so its slope is continuous. The largest
// slope is pi * peak / width.
double Synchroniser::bump_force(double depth) const noexcept {
  if (bump_ == 0.0 || depth <= at_.dogs || depth >= at_.home) return 0.0;
  const double sine = std::sin(std::numbers::pi * (depth - at_.dogs) / (at_.home - at_.dogs));
  return -bump_ * sine * sine;
}

// Magnitude of the rattle force of clashing dogs. It oscillates at the rate at which the teeth pass, but no faster than
// a hand can feel. step() applies the force outwards.
double Synchroniser::rattle_force(const SleeveInput& in, double period) noexcept {
  const bool on = dogs_clash(in);
  const double target = on ? std::min(kRattleFraction * push_, kMaxRattle) : 0.0;
  rattle_ += (target - rattle_) * filter_gain_;
  if (!on && rattle_ < kMinRattle) return rattle_ = 0.0;
  const double teeth_pass = std::abs(in.difference) * synchro_.teeth / (2.0 * std::numbers::pi);
  const double limit = period > 0.0 ? std::min(kMaxRattleRate, 1.0 / (kMinRattleSamples * period)) : kMaxRattleRate;
  if (on) rattle_phase_ += 2.0 * std::numbers::pi * period * std::min(teeth_pass, limit);
  rattle_phase_ = std::remainder(rattle_phase_, 2.0 * std::numbers::pi);
  return 0.5 * rattle_ * (1.0 - std::cos(rattle_phase_));
}

}  // namespace gearshift::vehicle
