#include "app/lessons/assessment/shift_meter.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

#include "app/lessons/assessment/gate_path.h"
#include "app/lessons/assessment/step_order.h"
#include "app/vehicle/hand_guidance.h"
#include "haptics/gate/gate_feel.h"

namespace gearshift::lessons {
namespace {

// Engineering values, except 5 % (kTorqueGapFraction) and 2 s (kGiveUpTime), which shift_record.h defines.
constexpr double kTorqueWindow = 0.5;  // [s] window for the torque before a shift; includes the release of the throttle
constexpr double kTorqueGapFraction = 0.05;
constexpr double kMinTorque = 5.0;         // [N m] wheel torque before the shift below which no torque gap is measured
constexpr double kFirstTorque = 1.0;       // [N m] clutch torque that counts as engaged; exceeds an open clutch's drag
constexpr double kGiveUpTime = 2.0;        // [s] a shift is given up after this time with the clutch up and no attempt
constexpr double kMinPush = 3.0;           // [N] smallest force on ring or dogs that counts as an attempt
constexpr double kMinLeverMotion = 0.002;  // [m] smallest lever movement that may begin a shift after an abandoned one
constexpr double kMaxSlipTime = 5.0;       // [s] a shift ends after this much slip with the gear in and the pedal up
constexpr double kThrottleOn = 0.08;       // [1]
constexpr double kThrottleOff = 0.04;      // [1]
constexpr double kPedalOverlap = 0.2;      // [s] pedal steps within this time, one full stroke, count as simultaneous
constexpr double kMinChord = 5e-4;         // [m] shortest lever movement that counts; longer than the encoder's noise
constexpr double kMinPath = 0.005;         // [m] path efficiency is not computed for shorter paths

double area(double before, double now, double dt) noexcept {
  return 0.5 * (before + now) * dt;
}

}  // namespace

ShiftMeter::ShiftMeter(const vehicle::CarSpec& car, const haptics::Gate& gate)
    : car_(car), gate_(gate), pedal_(car.clutch.bite), torque_(kTorqueWindow) {}

std::optional<ShiftRecord> ShiftMeter::add(const vehicle::DriveSample& sample) {
  std::optional<ShiftRecord> ended;
  const double time = sample.time();
  const double dt = first_ ? 0.0 : std::clamp(time - last_.time(), 0.0, vehicle::kMaxSampleInterval);
  if (first_) {
    gear_ = sample.car.gear;
    last_ = sample;
  }
  first_ = false;
  const bool throttle_was_on = throttle_on_;
  throttle_on_ = sample.car.pedals.throttle > (throttle_on_ ? kThrottleOff : kThrottleOn);
  pedal_.update(sample.car.pedals.clutch, time);
  filter_.update(sample.car.acceleration, dt);

  if (stage_ == Stage::settling) {
    measure_jerk();
    if (time >= open_.record.end + kJerkSettlingTime || begins_next(sample)) ended = close();
  } else if (stage_ == Stage::open && begins_next(sample)) {
    end(last_);
    ended = close();
  }
  if (sample.controls.guidance > 0.0) guided_at_ = time;
  if (!is_where_abandoned(sample)) left_slot_ = haptics::kNoSlot;
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

// True if `gear` is engaged and the lever rests in its slot. In a sequential gate, the lever rests in no slot.
bool ShiftMeter::rests_in(const vehicle::DriveSample& now, int gear) const noexcept {
  const int index = haptics::slot_at(gate_, now.lever.proxy);
  if (haptics::is_sequential(gate_)) return now.car.gear == gear;
  if (now.car.gear != gear || index == haptics::kNoSlot) return false;
  const haptics::Slot& slot = haptics::slot_of(gate_, index);
  return slot.gear == gear && std::abs(now.lever.proxy.y) >= slot.engage_depth;
}

// The slot through which the lever goes into `gear`.
int ShiftMeter::slot_to(int gear) const noexcept {
  if (!haptics::is_sequential(gate_)) return haptics::slot_of_gear(gate_, gear);
  return haptics::slot_of_gear(gate_, gear > open_.record.from ? haptics::kNextGear : haptics::kPreviousGear);
}

// Returns the slot that the lever is in, if the lever is past the slot's chamfered entry. Otherwise returns kNoSlot.
int ShiftMeter::slot_past_mouth(const vehicle::DriveSample& now) const noexcept {
  const bool behind = std::abs(now.lever.proxy.y) > gate_.half_aisle + gate_.chamfer;
  return behind ? haptics::slot_at(gate_, now.lever.proxy) : haptics::kNoSlot;
}

// True if the lever touches ring or dogs of a gear other than the old gear.
bool ShiftMeter::is_trying_another(const vehicle::DriveSample& now) const noexcept {
  const int slot = slot_past_mouth(now);
  return vehicle::touches_dogs(now) && slot != haptics::kNoSlot &&
         haptics::gear_behind(gate_, slot, open_.record.from) != open_.record.from;
}

// True if the lever pushes against ring or dogs.
bool ShiftMeter::is_pushing(const vehicle::DriveSample& now) const noexcept {
  return vehicle::touches_dogs(now) && glm::length(now.lever.f_h) > kMinPush;
}

// True if the lever is still where the last shift was abandoned.
bool ShiftMeter::is_where_abandoned(const vehicle::DriveSample& now) const noexcept {
  return left_slot_ != haptics::kNoSlot && haptics::slot_at(gate_, now.lever.proxy) == left_slot_ &&
         std::abs(std::abs(now.lever.proxy.y) - left_depth_) < kMinLeverMotion;
}

bool ShiftMeter::begins(const vehicle::DriveSample& now) const noexcept {
  if (pedal_.went_down()) return true;
  if (is_where_abandoned(now)) return now.car.gear != gear_ || is_pushing(now);
  if (gear_ != haptics::kNeutralGear) return !rests_in(now, gear_);
  return slot_past_mouth(now) != haptics::kNoSlot || now.car.gear != haptics::kNeutralGear;
}

// True if the next shift begins before the previous record was returned. Either that record is pending, or the gear is
// in and the pedal is up (`coupled`), but the clutch still slips.
bool ShiftMeter::begins_next(const vehicle::DriveSample& now) const noexcept {
  return (open_.coupled || stage_ == Stage::settling) && (pedal_.went_down() || now.car.gear != open_.record.to);
}

void ShiftMeter::begin(const vehicle::DriveSample& now, bool throttle_was_on) {
  open_ = OpenShift{};
  open_.record.number = number_;
  open_.record.begin = open_.rest_since = now.time();
  open_.record.from = open_.record.to = gear_;
  open_.record.engine_speed = now.car.engine_speed;
  open_.torque_before = torque_.value();
  open_.slip_before = last_.car.slip_energy;
  open_.lever_path = {now.lever.proxy, now.lever.lever, 0.0};
  // After the last request for guidance, the force fades for kGuidanceFadeTime. A shift that begins in this time still
  // counts as guided.
  open_.record.guided = now.time() - guided_at_ <= vehicle::kGuidanceFadeTime;
  if (!throttle_was_on) open_.record.steps.push_back(ShiftStep::throttle_off);
  stage_ = Stage::open;
}

void ShiftMeter::follow(const vehicle::DriveSample& now, double dt, bool throttle_was_on) {
  follow_clutch(now);
  follow_lever(now);
  follow_steps(now, throttle_was_on);
  follow_gear(now);
  measure_rev_error(now);
  integrate(now, dt);
  measure_jerk();
  integrate_path(now);
  update_rest(now);
  if (is_cancelled()) stage_ = Stage::idle;
  if (stage_ == Stage::idle || !has_ended(now)) return;
  if (open_.rest == Rest::given_up) {
    left_slot_ = haptics::slot_at(gate_, now.lever.proxy);
    left_depth_ = std::abs(now.lever.proxy.y);
  }
  if (is_shift()) end(now);
  stage_ = is_shift() ? Stage::settling : Stage::idle;
}

void ShiftMeter::follow_clutch(const vehicle::DriveSample& now) {
  if (pedal_.went_down()) {
    if (!open_.clutch_used) open_.clutch_down_at = pedal_.down_at();
    open_.clutch_used = true;
    open_.flare_base = now.car.engine_speed;
  }
  if (pedal_.is_down()) {
    open_.record.flare = std::max(open_.record.flare, now.car.engine_speed - open_.flare_base);
  }
  if (pedal_.went_up() && open_.early_up_at == 0.0 && is_trying_another(now)) open_.early_up_at = pedal_.up_at();
  open_.record.guided = open_.record.guided || now.controls.guidance > 0.0;
}

// Records when the lever leaves the old gear, and which slots it enters. A gear counts as left when the lever leaves
// the gear's rest position; neutral counts as left when the lever enters a slot.
void ShiftMeter::follow_lever(const vehicle::DriveSample& now) {
  const int slot = slot_past_mouth(now);
  const bool is_out =
      open_.record.from == haptics::kNeutralGear ? slot != haptics::kNoSlot : !rests_in(now, open_.record.from);
  if (is_out && !open_.left) open_.left_at = now.time();
  if (is_out || !(open_.dogs_out || open_.tried)) open_.left = is_out;
  if (slot != haptics::kNoSlot) {
    const haptics::Slot& entered = haptics::slot_of(gate_, slot);
    if (slot != open_.last_slot) ++open_.entered[static_cast<std::size_t>(slot)];
    const bool is_try = std::abs(now.lever.proxy.y) >= entered.release_depth || vehicle::touches_dogs(now);
    const int gear = haptics::gear_behind(gate_, slot, open_.record.from);
    if (is_try && gear != open_.record.from) {
      open_.tried = true;
      open_.tried_gear = gear;
    }
  }
  open_.last_slot = slot;
}

// Records the steps of the shift. Steps that happen within one sample, and two pedals moved together, are recorded in
// the taught order.
void ShiftMeter::follow_steps(const vehicle::DriveSample& now, bool throttle_was_on) {
  auto& steps = open_.record.steps;
  const int gear = now.car.gear, before = last_.car.gear;
  const auto ends_with = [&](ShiftStep step) { return !steps.empty() && steps.back() == step; };
  if (throttle_was_on && !throttle_on_) {
    const bool together = ends_with(ShiftStep::clutch_down) && now.time() - pedal_.down_at() <= kPedalOverlap;
    steps.insert(together ? steps.end() - 1 : steps.end(), ShiftStep::throttle_off);
  }
  if (pedal_.went_down()) steps.push_back(ShiftStep::clutch_down);
  if (gear != before && before != haptics::kNeutralGear) steps.push_back(ShiftStep::neutral);
  if (gear != before && gear != haptics::kNeutralGear) steps.push_back(ShiftStep::gear);
  if (pedal_.went_up()) {
    const bool together = ends_with(ShiftStep::throttle_on) && pedal_.up_at() - open_.throttle_on_at <= kPedalOverlap;
    steps.insert(together ? steps.end() - 1 : steps.end(), ShiftStep::clutch_up);
  }
  if (!throttle_was_on && throttle_on_) {
    steps.push_back(ShiftStep::throttle_on);
    open_.throttle_on_at = now.time();
  }
}

void ShiftMeter::follow_gear(const vehicle::DriveSample& now) {
  const int gear = now.car.gear;
  if (gear != open_.record.from) open_.dogs_out = true;
  if (gear != open_.record.to) {
    open_.record.to = gear;
    open_.gear_in = gear != haptics::kNeutralGear;
    open_.has_rev_error = false;
    if (open_.gear_in) {
      open_.gear_in_at = now.time();
      const int slot = slot_to(gear);
      if (slot != haptics::kNoSlot) open_.engaged[static_cast<std::size_t>(slot)] = true;
      end_path(now);
    }
  }
  open_.coupled = open_.gear_in && !pedal_.is_down();
}

// Records the difference between the speeds of engine and new gear just before the clutch transmits torque.
void ShiftMeter::measure_rev_error(const vehicle::DriveSample& now) {
  if (!open_.gear_in || open_.has_rev_error) return;
  const bool locks = now.car.clutch_locked && !pedal_.is_down();
  if (!locks && std::abs(now.car.clutch_torque) <= kFirstTorque) return;
  open_.has_rev_error = true;
  open_.record.rev_error =
      last_.car.engine_speed - vehicle::shaft_per_road(car_, open_.record.to) * last_.car.road_speed;
}

void ShiftMeter::integrate(const vehicle::DriveSample& now, double dt) {
  ShiftRecord& record = open_.record;
  const double force = glm::length(now.lever.f_h), before = glm::length(last_.lever.f_h);
  record.force_peak = std::max(record.force_peak, force);
  record.impulse += area(before, force, dt);
  record.slip_energy = now.car.slip_energy - open_.slip_before;
  record.grind_energy += area(last_.car.grind_power, now.car.grind_power, dt);
  if (now.car.grinding) record.grind_time += dt;
  if (now.car.sync == vehicle::SyncPhase::synchronising) record.block_time += dt;
  if (open_.clutch_is_down) record.clutch_time += dt;
  open_.clutch_is_down = pedal_.is_past();
  const double drive = std::copysign(1.0, open_.torque_before) * now.car.drive_torque;
  const double size = std::abs(open_.torque_before);
  if (size > kMinTorque && drive < kTorqueGapFraction * size) record.torque_gap += dt;
}

// Also called after the end of the shift, while the jerk filter settles.
void ShiftMeter::measure_jerk() {
  open_.record.jerk_peak = std::max(open_.record.jerk_peak, std::abs(filter_.jerk()));
}

void ShiftMeter::integrate_path(const vehicle::DriveSample& now) {
  if (open_.gear_in) return;
  const double chord = glm::distance(now.lever.lever, open_.lever_path.anchor);
  if (chord < kMinChord) return;
  open_.lever_path.length += chord;
  open_.lever_path.anchor = now.lever.lever;
}

void ShiftMeter::end_path(const vehicle::DriveSample& now) {
  open_.record.path_length = open_.lever_path.length + glm::distance(now.lever.lever, open_.lever_path.anchor);
  const double shortest = shortest_path_length(gate_, open_.lever_path.begin, now.lever.proxy);
  open_.record.path_efficiency = shortest > kMinPath ? std::max(1.0, open_.record.path_length / shortest) : 1.0;
}

bool ShiftMeter::is_cancelled() const noexcept {
  return !pedal_.is_down() && !open_.left && !open_.dogs_out && !open_.tried;
}

bool ShiftMeter::is_shift() const noexcept {
  return open_.dogs_out || open_.tried;
}

// Updates how the shift could end now, if at all (`rest`), and since when (`rest_since`). Ignores the lever's position,
// because a shift can also end with the lever in a slot's mouth or away from the engaged gear's rest position.
void ShiftMeter::update_rest(const vehicle::DriveSample& now) {
  Rest rest = pedal_.is_down() || is_pushing(now) ? Rest::busy : Rest::given_up;
  if (open_.coupled) rest = Rest::coupled;
  if (rest != open_.rest) open_.rest_since = now.time();
  open_.rest = rest;
}

bool ShiftMeter::has_ended(const vehicle::DriveSample& now) const noexcept {
  const double rested = now.time() - open_.rest_since;
  if (open_.rest == Rest::coupled) return now.car.clutch_locked || rested > kMaxSlipTime;
  return open_.rest == Rest::given_up && rested > kGiveUpTime;
}

// `is_complete`: false if the drive ends before the shift does.
void ShiftMeter::end(const vehicle::DriveSample& at, bool is_complete) {
  ShiftRecord& record = open_.record;
  record.end = at.time();
  const auto was_in = [this](int gear) {
    const int slot = slot_to(gear);
    return slot != haptics::kNoSlot && open_.engaged[static_cast<std::size_t>(slot)];
  };
  record.missed =
      record.to == haptics::kNeutralGear ? open_.tried && !was_in(open_.tried_gear) : record.to == record.from;
  if (open_.gear_in) record.lever_time = open_.gear_in_at - open_.left_at;
  if (open_.clutch_used && open_.left) record.clutch_lead = open_.left_at - open_.clutch_down_at;
  // A clutch release before the gear was in counts, even if the driver then pressed the clutch again.
  const double last_up = !is_complete && pedal_.is_down() ? at.time() : pedal_.up_at();
  const double up_at = open_.early_up_at > 0.0 ? open_.early_up_at : last_up;
  if (open_.clutch_used && open_.gear_in) record.clutch_lag = up_at - open_.gear_in_at;
  if (!open_.gear_in) end_path(at);
  record.steps_out_of_place = steps_out_of_place(record.steps, record.from, record.to, is_complete);
  const int goal = record.to == haptics::kNeutralGear || record.missed ? open_.tried_gear : record.to;
  for (std::size_t i = 0; i < haptics::slots(gate_).size(); ++i) {
    const int gear = haptics::gear_behind(gate_, static_cast<int>(i), record.from);
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
  gear_ = open_.record.to;
  ++number_;
  stage_ = Stage::idle;
  return open_.record;
}

}  // namespace gearshift::lessons
