#include "app/training/shift_meter.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

#include "app/training/gate_path.h"
#include "app/training/guided_world.h"
#include "app/training/step_order.h"
#include "haptics/gate/gate_feel.h"

namespace gearshift {
namespace {

// All [engineering value]s but the 5 % and the 2 s, which shift_record.h states.
constexpr double kTorqueWindow = 0.5;  // [s] before a shift: long enough to hold the lift of the throttle
constexpr double kTorqueGapShare = 0.05;
constexpr double kLeastTorque = 5.0;   // [N m] at the wheels; without drive before there is no gap
constexpr double kFirstTorque = 1.0;   // [N m] of the clutch: above the drag of an open one
constexpr double kGivesUp = 2.0;       // [s] with the clutch up and nothing done
constexpr double kTries = 3.0;         // [N] against ring or dogs: still tried
constexpr double kStirs = 0.002;       // [m] that a lever must move to be taken up again
constexpr double kSlipsForEver = 5.0;  // [s] gear and clutch in without locking: the shift is over all the same
constexpr double kThrottleOn = 0.08;   // [1]
constexpr double kThrottleOff = 0.04;  // [1]
constexpr double kTogether = 0.2;      // [s] both feet at once: a pedal's whole way, in either order
constexpr double kChord = 5e-4;        // [m] of the lever's way: seven counts of the paper's encoder
constexpr double kLeastWay = 0.005;    // [m] shorter ways have no efficiency

double area(double before, double now, double dt) noexcept {
  return 0.5 * (before + now) * dt;
}

double fourth(double a) noexcept {
  return a * a * a * a;
}

double penetration(const DriveSample& sample) noexcept {
  return glm::distance(sample.lever.lever, sample.lever.proxy);
}

}  // namespace

ShiftMeter::ShiftMeter(const CarSpec& car, const Gate& gate)
    : car_(car), gate_(gate), pedal_(car.clutch.bite), torque_(kTorqueWindow) {}

std::optional<ShiftRecord> ShiftMeter::add(const DriveSample& sample) {
  std::optional<ShiftRecord> ended;
  const double time = sample.time();
  const double dt = first_ ? 0.0 : std::clamp(time - last_.time(), 0.0, kLongestSample);
  if (first_) {
    gear_ = sample.car.gear;
    last_ = sample;
  }
  first_ = false;
  const bool throttle_was_on = throttle_on_;
  throttle_on_ = sample.car.throttle > (throttle_on_ ? kThrottleOff : kThrottleOn);
  pedal_.update(sample.car.clutch, time);
  filter_.update(sample.car.acceleration, dt);

  if (stage_ == Stage::settling) {
    feel(sample, dt);
    if (time >= open_.record.end + kJerkSettles || begins_anew(sample)) ended = close();
  } else if (stage_ == Stage::open && begins_anew(sample)) {
    end(last_);
    ended = close();
  }
  if (sample.controls.guidance > 0.0) guided_at_ = time;
  if (!stays(sample)) left_slot_ = kNoSlot;
  if (stage_ == Stage::idle && begins(sample)) {
    begin(sample, throttle_was_on);
    follow(sample, 0.0, throttle_was_on);
  } else if (stage_ == Stage::open) {
    follow(sample, dt, throttle_was_on);
  }
  torque_.add(sample.car.drive_torque, dt);
  last_ = sample;
  return ended;
}

// The lever rests in the gear whose dogs are in.
bool ShiftMeter::rests_in(const DriveSample& now, int gear) const noexcept {
  const int index = slot_at(gate_, now.lever.proxy);
  if (now.car.gear != gear || index == kNoSlot) return false;
  const Slot& slot = slot_of(gate_, index);
  return slot.gear == gear && std::abs(now.lever.proxy.y) >= slot.engage_depth;
}

// The slot that the lever is in, behind its mouth.
int ShiftMeter::slot_proper(const DriveSample& now) const noexcept {
  const bool behind = std::abs(now.lever.proxy.y) > gate_.half_aisle + gate_.chamfer;
  return behind ? slot_at(gate_, now.lever.proxy) : kNoSlot;
}

// The lever is at ring or dogs of a gear that it did not come from.
bool ShiftMeter::tries_another(const DriveSample& now) const noexcept {
  const int slot = slot_proper(now);
  return touches_dogs(now) && slot != kNoSlot && slot_of(gate_, slot).gear != open_.record.from;
}

// Pressed against ring or dogs.
bool ShiftMeter::pushes_on(const DriveSample& now) const noexcept {
  return touches_dogs(now) && glm::length(now.lever.f_h) > kTries;
}

// The lever is where it was left when the last shift was given up.
bool ShiftMeter::stays(const DriveSample& now) const noexcept {
  return left_slot_ != kNoSlot && slot_at(gate_, now.lever.proxy) == left_slot_ &&
         std::abs(std::abs(now.lever.proxy.y) - left_depth_) < kStirs;
}

bool ShiftMeter::begins(const DriveSample& now) const noexcept {
  if (pedal_.went_down()) return true;
  if (stays(now)) return now.car.gear != gear_ || pushes_on(now);
  if (gear_ != kNeutralGear) return !rests_in(now, gear_);
  return slot_proper(now) != kNoSlot || now.car.gear != kNeutralGear;
}

// While the last shift settles, or waits for a clutch that still slips.
bool ShiftMeter::begins_anew(const DriveSample& now) const noexcept {
  return (open_.coupled || stage_ == Stage::settling) && (pedal_.went_down() || now.car.gear != open_.record.to);
}

void ShiftMeter::begin(const DriveSample& now, bool throttle_was_on) {
  open_ = Open{};
  open_.record.number = number_;
  open_.record.begin = open_.rest_since = now.time();
  open_.record.from = open_.record.to = gear_;
  open_.record.engine_speed = now.car.engine_speed;
  open_.torque_before = torque_.value();
  open_.slip_before = last_.car.slip_energy;
  open_.way = {now.lever.proxy, now.lever.lever, 0.0};
  // The force fades for a while after it was asked for.
  open_.record.guided = now.time() - guided_at_ <= kGuidanceFades;
  if (!throttle_was_on) open_.record.steps.push_back(ShiftStep::throttle_off);
  stage_ = Stage::open;
}

void ShiftMeter::follow(const DriveSample& now, double dt, bool throttle_was_on) {
  follow_clutch(now);
  follow_lever(now);
  follow_steps(now, throttle_was_on);
  follow_gear(now);
  take_torque(now);
  integrate(now, dt);
  feel(now, dt);
  walk(now);
  follow_rest(now);
  if (is_taken_back()) stage_ = Stage::idle;
  if (stage_ == Stage::idle || !has_ended(now)) return;
  if (open_.rest == Rest::given_up) {
    left_slot_ = slot_at(gate_, now.lever.proxy);
    left_depth_ = std::abs(now.lever.proxy.y);
  }
  if (is_shift()) end(now);
  stage_ = is_shift() ? Stage::settling : Stage::idle;
}

void ShiftMeter::follow_clutch(const DriveSample& now) {
  if (pedal_.went_down()) {
    if (!open_.clutch_used) open_.clutch_down_at = pedal_.down_at();
    open_.clutch_used = true;
    open_.flare_base = now.car.engine_speed;
  }
  if (pedal_.is_down()) {
    open_.record.flare = std::max(open_.record.flare, now.car.engine_speed - open_.flare_base);
  }
  if (pedal_.went_up() && open_.early_up_at == 0.0 && tries_another(now)) open_.early_up_at = pedal_.up_at();
  open_.record.guided = open_.record.guided || now.controls.guidance > 0.0;
}

// Out of a gear the lever is left when it leaves the gear's rest, out of neutral when it enters a slot.
void ShiftMeter::follow_lever(const DriveSample& now) {
  const int slot = slot_proper(now);
  const bool is_out = open_.record.from == kNeutralGear ? slot != kNoSlot : !rests_in(now, open_.record.from);
  if (is_out && !open_.left) open_.left_at = now.time();
  if (is_out || !(open_.dogs_out || open_.tried)) open_.left = is_out;
  if (slot != kNoSlot) {
    const Slot& entered = slot_of(gate_, slot);
    if (slot != open_.last_slot) ++open_.entered[static_cast<std::size_t>(slot)];
    const bool is_try = std::abs(now.lever.proxy.y) >= entered.release_depth || touches_dogs(now);
    if (is_try && entered.gear != open_.record.from) {
      open_.tried = true;
      open_.tried_gear = entered.gear;
    }
  }
  open_.last_slot = slot;
}

// What one sample shows at once counts in the order that is taught, and so do two feet that move together.
void ShiftMeter::follow_steps(const DriveSample& now, bool throttle_was_on) {
  auto& steps = open_.record.steps;
  const int gear = now.car.gear, before = last_.car.gear;
  const auto ends_with = [&](ShiftStep step) { return !steps.empty() && steps.back() == step; };
  if (throttle_was_on && !throttle_on_) {
    const bool together = ends_with(ShiftStep::clutch_down) && now.time() - pedal_.down_at() <= kTogether;
    steps.insert(together ? steps.end() - 1 : steps.end(), ShiftStep::throttle_off);
  }
  if (pedal_.went_down()) steps.push_back(ShiftStep::clutch_down);
  if (gear != before && before != kNeutralGear) steps.push_back(ShiftStep::neutral);
  if (gear != before && gear != kNeutralGear) steps.push_back(ShiftStep::gear);
  if (pedal_.went_up()) {
    const bool together = ends_with(ShiftStep::throttle_on) && pedal_.up_at() - open_.throttle_on_at <= kTogether;
    steps.insert(together ? steps.end() - 1 : steps.end(), ShiftStep::clutch_up);
  }
  if (!throttle_was_on && throttle_on_) {
    steps.push_back(ShiftStep::throttle_on);
    open_.throttle_on_at = now.time();
  }
}

void ShiftMeter::follow_gear(const DriveSample& now) {
  const int gear = now.car.gear;
  if (gear != open_.record.from) open_.dogs_out = true;
  if (gear != open_.record.to) {
    open_.record.to = gear;
    open_.gear_in = gear != kNeutralGear;
    open_.took_torque = false;
    if (open_.gear_in) {
      open_.gear_in_at = now.time();
      const int slot = slot_of_gear(gate_, gear);
      if (slot != kNoSlot) open_.engaged[static_cast<std::size_t>(slot)] = true;
      arrive(now);
    }
  }
  open_.coupled = open_.gear_in && !pedal_.is_down();
}

// The engine against what the new gear asks of it, just before the clutch takes hold.
void ShiftMeter::take_torque(const DriveSample& now) {
  if (!open_.gear_in || open_.took_torque) return;
  const bool locks = now.car.clutch_locked && !pedal_.is_down();
  if (!locks && std::abs(now.car.clutch_torque) <= kFirstTorque) return;
  open_.took_torque = true;
  open_.record.rev_error = last_.car.engine_speed - shaft_per_road(car_, open_.record.to) * last_.car.road_speed;
}

void ShiftMeter::integrate(const DriveSample& now, double dt) {
  ShiftRecord& record = open_.record;
  const double force = glm::length(now.lever.f_h), before = glm::length(last_.lever.f_h);
  record.force_peak = std::max(record.force_peak, force);
  record.impulse += area(before, force, dt);
  record.overshoot = std::max(record.overshoot, penetration(now));
  const double deeper = penetration(now) - penetration(last_);
  if (deeper > 0.0 && dt > 0.0) {
    record.wall_work += area(glm::length(last_.lever.wall_force), glm::length(now.lever.wall_force), deeper);
  }
  record.slip_power_peak = std::max(record.slip_power_peak, now.car.slip_power);
  record.slip_energy = now.car.slip_energy - open_.slip_before;
  record.grind_energy += area(last_.car.grind_power, now.car.grind_power, dt);
  if (now.car.grinding) record.grind_time += dt;
  if (now.car.sync == SyncPhase::synchronising) record.block_time += dt;
  if (open_.clutch_is_down) record.clutch_time += dt;
  open_.clutch_is_down = pedal_.is_past();
  const double drive = std::copysign(1.0, open_.torque_before) * now.car.drive_torque;
  const double size = std::abs(open_.torque_before);
  if (size > kLeastTorque && drive < kTorqueGapShare * size) record.torque_gap += dt;
}

// Comfort, also while the filter's answer to the end of the shift is still to come.
void ShiftMeter::feel(const DriveSample& now, double dt) {
  open_.record.jerk_peak = std::max(open_.record.jerk_peak, std::abs(filter_.jerk()));
  open_.fourth_power += area(fourth(last_.car.acceleration), fourth(now.car.acceleration), dt);
}

void ShiftMeter::walk(const DriveSample& now) {
  if (open_.gear_in) return;
  const double chord = glm::distance(now.lever.lever, open_.way.anchor);
  if (chord < kChord) return;
  open_.way.length += chord;
  open_.way.anchor = now.lever.lever;
}

void ShiftMeter::arrive(const DriveSample& now) {
  open_.record.path_length = open_.way.length + glm::distance(now.lever.lever, open_.way.anchor);
  const double shortest = shortest_way(gate_, open_.way.begin, now.lever.proxy);
  open_.record.path_efficiency = shortest > kLeastWay ? std::max(1.0, open_.record.path_length / shortest) : 1.0;
}

bool ShiftMeter::is_taken_back() const noexcept {
  return !pedal_.is_down() && !open_.left && !open_.dogs_out && !open_.tried;
}

bool ShiftMeter::is_shift() const noexcept {
  return open_.dogs_out || open_.tried;
}

// Wherever the lever is: also in a mouth, or off the rest of a gear that is still in.
void ShiftMeter::follow_rest(const DriveSample& now) {
  Rest rest = pedal_.is_down() || pushes_on(now) ? Rest::busy : Rest::given_up;
  if (open_.coupled) rest = Rest::coupled;
  if (rest != open_.rest) open_.rest_since = now.time();
  open_.rest = rest;
}

bool ShiftMeter::has_ended(const DriveSample& now) const noexcept {
  const double rested = now.time() - open_.rest_since;
  if (open_.rest == Rest::coupled) return now.car.clutch_locked || rested > kSlipsForEver;
  return open_.rest == Rest::given_up && rested > kGivesUp;
}

// whole: false where the drive ends before the shift does.
void ShiftMeter::end(const DriveSample& at, bool whole) {
  ShiftRecord& record = open_.record;
  record.end = at.time();
  const auto was_in = [this](int gear) {
    const int slot = slot_of_gear(gate_, gear);
    return slot != kNoSlot && open_.engaged[static_cast<std::size_t>(slot)];
  };
  record.missed = record.to == kNeutralGear ? open_.tried && !was_in(open_.tried_gear) : record.to == record.from;
  if (open_.gear_in) record.lever_time = open_.gear_in_at - open_.left_at;
  if (open_.clutch_used && open_.left) record.clutch_lead = open_.left_at - open_.clutch_down_at;
  // Who presses it again, because the gear would not go in, was early all the same.
  const double last_up = !whole && pedal_.is_down() ? at.time() : pedal_.up_at();
  const double up_at = open_.early_up_at > 0.0 ? open_.early_up_at : last_up;
  if (open_.clutch_used && open_.gear_in) record.clutch_lag = up_at - open_.gear_in_at;
  if (!open_.gear_in) arrive(at);
  record.steps_out_of_place = steps_out_of_place(record.steps, record.from, record.to, whole);
  const int goal = record.to == kNeutralGear || record.missed ? open_.tried_gear : record.to;
  for (std::size_t i = 0; i < open_.entered.size(); ++i) {
    const int gear = gate_.slot[i].gear;
    if (gear != record.from && gear != goal && !open_.engaged[i]) record.wrong_columns += open_.entered[i];
  }
}

std::optional<ShiftRecord> ShiftMeter::finish() {
  const bool in_progress = stage_ == Stage::open && is_shift();
  if (in_progress) end(last_, false);
  if (in_progress || stage_ == Stage::settling) return close();
  stage_ = Stage::idle;
  return std::nullopt;
}

ShiftRecord ShiftMeter::close() {
  open_.record.vibration_dose = std::pow(open_.fourth_power, 0.25);
  gear_ = open_.record.to;
  ++number_;
  stage_ = Stage::idle;
  return open_.record;
}

}  // namespace gearshift
