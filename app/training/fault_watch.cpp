#include "app/training/fault_watch.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include <glm/geometric.hpp>

#include "app/training/fault_rules.h"

namespace gearshift {
namespace {

// [engineering value]s.
constexpr double kStallWindow = 1.0;    // [s] the engine's speed before it died is the highest of this
constexpr double kLugLoad = 0.7;        // [1] share of the torque that the engine could give
constexpr double kTellRiding = 6.0;     // [s] told at the latest, though it goes on
constexpr double kFootRests = 0.08;     // [1] pedal
constexpr double kHandLeans = 3.0;      // [N]
constexpr double kDriving = 4.0;        // [m/s] below that a driver may want the clutch to stop, or to creep
constexpr double kBraking = 0.05;       // [1] pedal
constexpr double kPushes = 3.0;         // [N] against a synchroniser
constexpr double kStands = 0.01;        // [m/s]
constexpr double kLongestPeriod = 0.1;  // [s]

bool touches_dogs(const DriveSample& sample) noexcept {
  return sample.car.sync != SyncPhase::free && sample.car.sync != SyncPhase::meshed;
}

bool is_moving(double speed) noexcept {
  return std::abs(speed) > kDriving;
}

double least(FaultKind kind) noexcept {
  return fault_rule(kind).raise;
}

}  // namespace

FaultWatch::FaultWatch(const CarSpec& car, const Gate& gate, ShiftBand band)
    : car_(car),
      gate_(gate),
      band_(band),
      release_(car),
      engine_(kStallWindow),
      over_rev_{FaultKind::over_rev, Measure::peak, Episode(0.0)},
      lugging_{FaultKind::lugging, Measure::length, Episode(least(FaultKind::lugging))},
      riding_clutch_{FaultKind::riding_clutch, Measure::length, Episode(least(FaultKind::riding_clutch), kTellRiding)},
      riding_lever_{FaultKind::riding_lever, Measure::length, Episode(least(FaultKind::riding_lever), kTellRiding)},
      over_push_{FaultKind::over_push, Measure::peak, Episode(0.0)},
      grind_{FaultKind::grind, Measure::sum, Episode(0.0)},
      block_{FaultKind::blocked, Measure::length, Episode(least(FaultKind::blocked))} {}

void FaultWatch::add(const DriveSample& sample, int wanted_gear, bool shifting) {
  if (first_) {
    last_ = sample;
    last_gear_ = sample.car.gear;
    highest_ = sample.car.distance;
  }
  first_ = false;
  wanted_gear_ = wanted_gear;
  const double dt = std::clamp(sample.time() - last_.time(), 0.0, kLongestPeriod);
  watch_engine(sample, dt);
  shift_moved_ = shifting && (shift_moved_ || sample.car.gear != last_.car.gear);
  watch_feet(sample, dt);
  watch_hand(sample, shifting, dt);
  watch_dogs(sample, dt);
  watch_direction(sample);
  watch_gear(sample, wanted_gear);
  watch_rollback(sample);
  last_ = sample;
}

void FaultWatch::watch_engine(const DriveSample& now, double dt) {
  const double speed = now.car.engine_speed;
  if (last_.car.running && !now.car.running && now.car.ignition) tell_if(FaultKind::stall, now.time(), engine_.value());
  engine_.add(speed, dt);
  const FaultRule& red = fault_rule(FaultKind::over_rev);
  const double limit = car_.engine.red_line * (over_rev_.episode.is_open() ? red.clear : red.raise);
  goes_on(over_rev_, speed > limit, speed, now.time(), dt);
  const bool labours = now.car.running && now.car.gear != kNeutralGear && now.car.clutch_locked &&
                       now.car.engine_load > kLugLoad && speed < car_.engine.lug_below;
  goes_on(lugging_, labours, 0.0, now.time(), dt);
}

// A foot that slows nothing and shifts nothing: the lever at rest in its gear, the clutch open or closed, not slipping.
// After a shift an open clutch makes the shift slow: that is said.
void FaultWatch::watch_feet(const DriveSample& now, double dt) {
  if (const auto fault = release_.add(now, dt)) faults_.push_back(*fault);
  const int slot = now.lever.slot;
  const bool at_rest = slot != kNoSlot && slot_of(gate_, slot).gear == now.car.gear &&
                       std::abs(now.lever.proxy.y) >= slot_of(gate_, slot).engage_depth;
  const bool needs_none = at_rest && is_moving(now.car.road_speed) && now.car.brake < kBraking;
  const bool slips = !now.car.clutch_locked && now.car.clutch < car_.clutch.bite;
  const bool rides = now.car.clutch > kFootRests && needs_none && !slips && !shift_moved_;
  goes_on(riding_clutch_, rides, 0.0, now.time(), dt);
}

void FaultWatch::watch_hand(const DriveSample& now, bool shifting, double dt) {
  const double push = glm::length(now.lever.f_h);
  const bool leans = push > kHandLeans && !shifting && now.car.gear != kNeutralGear && is_moving(now.car.road_speed);
  goes_on(riding_lever_, leans, push, now.time(), dt);
  const FaultRule& rule = fault_rule(FaultKind::over_push);
  const bool over = push > (over_push_.episode.is_open() ? rule.clear : rule.raise);
  goes_on(over_push_, over, push, now.time(), dt);
}

// The gear whose slot the lever is in beyond its mouth, or the one whose ring or dogs it touches.
int FaultWatch::gear_reached_for(const DriveSample& now) const noexcept {
  if (now.lever.slot == kNoSlot) return kNeutralGear;
  const Slot& slot = slot_of(gate_, now.lever.slot);
  return touches_dogs(now) || std::abs(now.lever.proxy.y) >= slot.release_depth ? slot.gear : kNeutralGear;
}

// Pushed against the ring with the clutch down it is blocked; with the clutch up it is a shift without clutch.
void FaultWatch::watch_dogs(const DriveSample& now, double dt) {
  const bool open = now.car.clutch >= car_.clutch.bite;
  const bool touching = touches_dogs(now);
  const int gear = gear_reached_for(now);
  if (gear != kNeutralGear && gear != now.car.gear) tried_gear_ = gear;
  if (touching && !touching_ && !open && gear != kNeutralGear) {
    const double error = now.car.engine_speed - shaft_per_road(car_, gear) * now.car.road_speed;
    if (std::abs(error) > std::abs(touch_error_)) touch_error_ = error;
  }
  touching_ = touching;
  const bool pushes = now.car.sync == SyncPhase::synchronising && open && glm::length(now.lever.f_h) > kPushes;
  goes_on(block_, pushes, 0.0, now.time(), dt);
  goes_on(grind_, now.car.grinding, now.car.grind_power, now.time(), dt);
}

// Reverse at forward speed, or forward at backward speed: once per visit to the slot.
void FaultWatch::watch_direction(const DriveSample& now) {
  const int gear = gear_reached_for(now);
  if (gear == kNeutralGear) wrong_way_ = false;
  const double against = gear == kReverseGear ? now.car.road_speed : -now.car.road_speed;
  const bool arrives = gear != kNeutralGear && gear != last_gear_;
  if (arrives && !wrong_way_) wrong_way_ = tell_if(FaultKind::wrong_direction, now.time(), against);
}

// A gear that was not asked for; the one that was just left does not count, nor does a missed shift to it.
void FaultWatch::watch_gear(const DriveSample& now, int wanted_gear) {
  const int gear = now.car.gear;
  const bool engaged = gear != last_.car.gear && gear != kNeutralGear;
  if (engaged && wanted_gear != kNeutralGear && gear != wanted_gear && gear != last_gear_) {
    tell_if(FaultKind::wrong_gear, now.time(), gear);
  }
  if (gear != kNeutralGear) last_gear_ = gear;
}

// Backwards without being in reverse, or rolling on out of it.
void FaultWatch::watch_rollback(const DriveSample& now) {
  const bool rolls = now.car.road_speed < -kStands && last_gear_ != kReverseGear;
  if (rolls) return;
  tell_rollback(now.time());
  highest_ = now.car.distance;
}

void FaultWatch::tell_rollback(double time) {
  tell_if(FaultKind::rollback, time, highest_ - last_.car.distance);
}

void FaultWatch::goes_on(Lasting& lasting, bool on, double value, double time, double dt) {
  if (lasting.episode.update(on, value, time, dt)) tell_lasting(lasting);
}

void FaultWatch::tell_lasting(const Lasting& lasting) {
  const Episode& episode = lasting.episode;
  double value = episode.length();
  if (lasting.measure == Measure::peak) value = episode.peak();
  if (lasting.measure == Measure::sum) value = episode.sum();
  const bool is_share = lasting.kind == FaultKind::over_rev;
  const double rule_value = is_share ? value / car_.engine.red_line : value;
  if (rule_value >= least(lasting.kind)) {
    faults_.push_back({lasting.kind, fault_severity(lasting.kind, rule_value), episode.begin(), value});
  }
}

void FaultWatch::finish() {
  for (Lasting* lasting : {&over_rev_, &lugging_, &riding_clutch_, &riding_lever_, &over_push_, &grind_, &block_}) {
    if (lasting->episode.finish()) tell_lasting(*lasting);
  }
  tell_rollback(last_.time());
  highest_ = last_.car.distance;
  if (const auto fault = release_.finish()) faults_.push_back(*fault);
}

void FaultWatch::judge(const ShiftRecord& record) {
  const std::size_t before = faults_.size();
  const bool without_clutch = judge_clutch(record);
  // Not reached for want of a clutch: that was said.
  const int missed = tried_gear_ != kNeutralGear ? tried_gear_ : wanted_gear_;
  if (record.missed && !without_clutch && missed != kNeutralGear) {
    tell_if(FaultKind::missed_shift, record.end, missed, record.number);
  }
  tell_if(FaultKind::wrong_column, record.end, record.wrong_columns, record.number);
  judge_engine(record);
  judge_order(record, before);
  tried_gear_ = kNeutralGear;
  touch_error_ = 0.0;
}

// True where it was shifted without the clutch and without matched revs.
bool FaultWatch::judge_clutch(const ShiftRecord& record) {
  if (record.clutch_time == 0.0) {
    const double error = std::max(std::abs(touch_error_), std::abs(record.rev_error));
    return tell_if(FaultKind::no_clutch, record.begin, error, record.number);
  }
  tell_if(FaultKind::clutch_late, record.begin, -record.clutch_lead, record.number);
  tell_if(FaultKind::clutch_early, record.end, -record.clutch_lag, record.number);
  return false;
}

// What the engine must rise by for the gear that it went to: a blip of the throttle is no flare.
double FaultWatch::flare_needed(const ShiftRecord& record) const noexcept {
  const double asked = shaft_per_road(car_, record.to) * last_.car.road_speed;
  return std::max(0.0, asked - record.engine_speed);
}

void FaultWatch::judge_engine(const ShiftRecord& record) {
  const bool between_gears = record.from != kNeutralGear && record.to != kNeutralGear && !record.missed;
  if (!between_gears || !is_moving(last_.car.road_speed)) return;
  const bool flared =
      tell_if(FaultKind::throttle_in_shift, record.begin, record.flare - flare_needed(record), record.number);
  // Below idle the clutch has to slip, and revs that flared do not match either: that was said.
  const double asked = shaft_per_road(car_, record.to) * last_.car.road_speed;
  if (!flared && record.clutch_time > 0.0 && asked > car_.engine.idle) {
    tell_if(FaultKind::rev_mismatch, record.end, std::abs(record.rev_error), record.number);
  }
  tell_if(FaultKind::too_slow, record.end, std::max(record.clutch_time, record.lever_time), record.number);
  if (record.to <= record.from || record.from == kReverseGear) return;
  const double speed = record.engine_speed;
  if (speed < band_.from) tell_if(FaultKind::early_shift, record.begin, speed, record.number);
  if (speed > band_.to) tell_if(FaultKind::late_shift, record.begin, speed, record.number);
}

// Only between gears and driving: pulling away wants the throttle before the clutch. Clutch and throttle out of time
// are out of order too: that was said.
void FaultWatch::judge_order(const ShiftRecord& record, std::size_t faults_before) {
  const bool between_gears = record.from != kNeutralGear && record.to != kNeutralGear && !record.missed;
  if (!between_gears || !is_moving(last_.car.road_speed)) return;
  const auto said = [](const DriveFault& fault) {
    return fault.kind == FaultKind::no_clutch || fault.kind == FaultKind::clutch_early ||
           fault.kind == FaultKind::clutch_late || fault.kind == FaultKind::throttle_in_shift;
  };
  const auto first = faults_.begin() + static_cast<std::ptrdiff_t>(faults_before);
  if (std::any_of(first, faults_.end(), said)) return;
  // What is exchanged within the tolerance of the clutch's timing is in order.
  const int forgiven = (record.clutch_lead < 0.0 ? 2 : 0) + (record.clutch_lag < 0.0 ? 2 : 0);
  tell_if(FaultKind::step_order, record.begin, record.steps_out_of_place - forgiven, record.number);
}

bool FaultWatch::tell_if(FaultKind kind, double time, double value, std::int64_t shift) {
  if (!(value >= least(kind))) return false;  // nor is what is no number
  faults_.push_back({kind, fault_severity(kind, value), time, value, shift});
  return true;
}

std::vector<DriveFault> FaultWatch::take() {
  return std::exchange(faults_, {});
}

}  // namespace gearshift
