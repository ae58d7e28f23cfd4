#include "app/training/fault_watch.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include <glm/geometric.hpp>

#include "app/training/fault_rules.h"
#include "app/training/step_order.h"

namespace gearshift {
namespace {

// [engineering value]s.
constexpr double kStallWindow = 1.0;  // [s] the engine's speed before it died is the highest of this
constexpr double kLugLoad = 0.7;      // [1] share of the torque that the engine could give
constexpr double kTellRiding = 6.0;   // [s] told at the latest, though it goes on
constexpr double kFootRests = 0.08;   // [1] pedal
constexpr double kHandLeans = 3.0;    // [N]
constexpr double kDriving = 4.0;      // [m/s] below that a driver may want the clutch to stop, or to creep
constexpr double kBraking = 0.05;     // [1] pedal
constexpr double kBrakingHard = 0.5;  // [1] pedal: it is to stand, from any speed
constexpr double kStillShifts = 6.0;  // [s] longer is no shift any more, though the clutch is down
constexpr double kReachesUp = 1.2;    // [1] of the car's shift_high
constexpr double kPushes = 3.0;       // [N] against a synchroniser
constexpr double kStands = 0.01;      // [m/s]
constexpr double kJustStarted = 1.0;  // [s] in which an engine that was started finds its idle
constexpr double kNearly = 0.07;      // [1] a speed is met: before it, as a needle is read
// [m/s] and beyond it: who brakes at 1.5 m/s^2 loses 12 km/h while he reads (1.05 s, Green 2000) and shifts (1.2 s).
constexpr double kBeyond = 12.0 / kKmhPerMps;

bool is_moving(double speed) noexcept {
  return std::abs(speed) > kDriving;
}

double least(FaultKind kind) noexcept {
  return fault_rule(kind).raise;
}

bool has(const std::vector<int>& gears, int gear) {
  return std::find(gears.begin(), gears.end(), gear) != gears.end();
}

void note(std::vector<int>& gears, int gear) {
  std::erase(gears, gear);
  gears.push_back(gear);
}

bool is_between_gears(const ShiftRecord& record) noexcept {
  return record.from != kNeutralGear && record.to != kNeutralGear && !record.missed;
}

bool is_down(const ShiftRecord& record) noexcept {
  return is_between_gears(record) && record.to >= 1 && record.to < record.from;
}

// The foot was off the throttle before the clutch went down: what flares then is a blip.
bool lifted_first(const ShiftRecord& record) {
  const auto first = std::find_if(record.steps.begin(), record.steps.end(), [](ShiftStep step) {
    return step == ShiftStep::throttle_off || step == ShiftStep::clutch_down;
  });
  return first != record.steps.end() && *first == ShiftStep::throttle_off;
}

}  // namespace

double suits_up_to(const CarSpec& car, const ShiftBand& band) noexcept {
  return band.to < car.engine.limiter ? band.to : kReachesUp * car.engine.shift_high;
}

FaultWatch::FaultWatch(const CarSpec& car, const Gate& gate, ShiftBand band, double reading)
    : car_(car),
      gate_(gate),
      band_(band),
      reading_(reading),
      release_(car),
      engine_(kStallWindow),
      over_rev_{FaultKind::over_rev, Measure::peak, Episode(0.0)},
      lugging_{FaultKind::lugging, Measure::length, Episode(least(FaultKind::lugging))},
      riding_clutch_{FaultKind::riding_clutch, Measure::length, Episode(least(FaultKind::riding_clutch), kTellRiding)},
      riding_lever_{FaultKind::riding_lever, Measure::length, Episode(least(FaultKind::riding_lever), kTellRiding)},
      over_push_{FaultKind::over_push, Measure::peak, Episode(0.0)},
      grind_{FaultKind::grind, Measure::sum, Episode(0.0)},
      block_{FaultKind::blocked, Measure::length, Episode(least(FaultKind::blocked))},
      coasting_{FaultKind::coasting, Measure::length, Episode(least(FaultKind::coasting), kTellRiding)} {}

void FaultWatch::add(const DriveSample& sample, int wanted_gear, bool shifting, double at) {
  if (first_) {
    last_ = sample;
    last_gear_ = driven_gear_ = sample.car.gear;
    highest_ = sample.car.distance;
  }
  first_ = false;
  wanted_gear_ = wanted_gear;
  const double dt = std::clamp(sample.time() - last_.time(), 0.0, kLongestSample);
  watch_engine(sample, dt);
  follow_shift(sample, shifting, dt);
  watch_feet(sample, dt);
  watch_drive(sample, dt);
  watch_hand(sample, shifting, dt);
  watch_dogs(sample, dt);
  watch_direction(sample);
  watch_gear(sample, wanted_gear, at);
  watch_rollback(sample);
  last_ = sample;
}

void FaultWatch::follow_shift(const DriveSample& now, bool shifting, double dt) noexcept {
  const bool moves = shifting && now.car.gear != last_.car.gear;
  if (shifting && !shifting_) {
    rolled_before_ = std::exchange(rolled_, {});
    shift_began_ = now.time();
  }
  if (shifting) follow_roll(now, moves, dt);
  const bool dead = !now.car.running || now.time() - runs_since_ < kJustStarted;
  rolled_.dead = rolled_.dead || (shifting && dead);
  if (moves && !shift_moved_) shift_moved_at_ = now.time();
  shift_moved_ = shifting && (shift_moved_ || moves);
  shifting_ = shifting;
}

void FaultWatch::follow_roll(const DriveSample& now, bool moves, double dt) noexcept {
  if (is_moving(now.car.road_speed)) {
    rolled_.all += dt;
  } else {
    const bool stops = now.car.brake > kBraking && now.car.clutch >= car_.clutch.bite;
    rolled_.to_a_stand = rolled_.to_a_stand || stops;
  }
  if (moves && !shift_moved_) rolled_.left = rolled_.all;
  if (moves) rolled_.in = rolled_.all;
}

void FaultWatch::watch_engine(const DriveSample& now, double dt) {
  const double speed = now.car.engine_speed;
  // An engine that fires under the starter and dies as the key is let go has not started yet.
  has_run_ = has_run_ || (now.car.running && speed >= car_.engine.stall);
  const bool died = last_.car.running && !now.car.running && now.car.ignition;
  if (died && has_run_) has_stalled_ = tell_if(FaultKind::stall, now.time(), engine_.value());
  if (now.car.running && !last_.car.running) runs_since_ = now.time();
  has_run_ = has_run_ && now.car.running;
  engine_.add(speed, dt);
  const FaultRule& red = fault_rule(FaultKind::over_rev);
  const double limit = car_.engine.red_line * (over_rev_.episode.is_open() ? red.clear : red.raise);
  goes_on(over_rev_, speed > limit, speed, now.time(), dt);
  const bool labours = now.car.running && now.car.gear != kNeutralGear && now.car.clutch_locked &&
                       now.car.engine_load > kLugLoad && speed < car_.engine.lug_below;
  goes_on(lugging_, labours, 0.0, now.time(), dt);
}

// A foot that slows nothing and shifts nothing: the lever at rest in its gear, the clutch not slipping. Open it coasts,
// and after a shift an open clutch makes the shift slow: that is said.
void FaultWatch::watch_feet(const DriveSample& now, double dt) {
  if (const auto fault = release_.add(now, dt)) faults_.push_back(*fault);
  const int slot = now.lever.slot;
  const bool at_rest = slot != kNoSlot && slot_of(gate_, slot).gear == now.car.gear &&
                       std::abs(now.lever.proxy.y) >= slot_of(gate_, slot).engage_depth;
  const bool needs_none = at_rest && is_moving(now.car.road_speed) && now.car.brake < kBraking;
  const bool rests = now.car.clutch > kFootRests && now.car.clutch < car_.clutch.bite && now.car.clutch_locked;
  const bool rides = rests && needs_none && !shift_moved_;
  goes_on(riding_clutch_, rides, 0.0, now.time(), dt);
}

// Braked hard, or braked in a gear that could no longer be driven so slowly.
bool FaultWatch::comes_to_stand(const DriveSample& now) const noexcept {
  const double turns = std::abs(shaft_per_road(car_, driven_gear_) * now.car.road_speed);
  return now.car.brake > kBrakingHard || (now.car.brake > kBraking && turns < car_.engine.lug_below);
}

// Rolls with nothing between engine and wheels, for nothing.
void FaultWatch::watch_drive(const DriveSample& now, double dt) {
  if (now.car.gear != kNeutralGear && now.car.clutch_locked) driven_gear_ = now.car.gear;
  const bool open = now.car.gear == kNeutralGear || now.car.clutch >= car_.clutch.bite;
  const bool shifts = shift_moved_ && now.time() - shift_moved_at_ < kStillShifts;
  const bool coasts = open && !shifts && now.car.running && is_moving(now.car.road_speed) && !comes_to_stand(now);
  if (coasting_.episode.update(coasts, 0.0, now.time(), dt)) tell_coasting();
}

// One press of the clutch is one deed: out of a shift that turns out too slow it is not told.
void FaultWatch::tell_coasting() {
  const double began = coasting_.episode.begin();
  if (began >= slow_from_ && began <= slow_to_) return;
  const std::size_t before = faults_.size();
  tell_lasting(coasting_);
  if (faults_.size() == before) return;
  if (!shift_moved_) {
    coasted_at_ = began;
    return;
  }
  coasted_.push_back(faults_.back());
  faults_.pop_back();
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
  if (gear != kNeutralGear && gear != now.car.gear) note(tried_, gear);
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
void FaultWatch::watch_gear(const DriveSample& now, int wanted_gear, double at) {
  const int gear = now.car.gear;
  const bool engaged = gear != last_.car.gear && gear != kNeutralGear;
  const bool other = wanted_gear != kNeutralGear && gear != wanted_gear && gear != last_gear_;
  if (engaged && gear == wanted_gear && now.car.running) has_stalled_ = false;
  if (engaged && other && !moves_off_again(gear, wanted_gear)) {
    tell_if(FaultKind::wrong_gear, now.time(), gear);
    faults_.back().wanted = wanted_gear;
  }
  if (engaged) {
    note(engaged_, gear);
    asked_ = shaft_per_road(car_, gear) * now.car.road_speed;
    if (gear == wanted_gear && at > 0.0 && gear != last_gear_) judge_speed(now, at);
  }
  if (gear != kNeutralGear) last_gear_ = gear;
}

// After a stall one begins anew: in first, and up to where it was.
bool FaultWatch::moves_off_again(int gear, int wanted_gear) const noexcept {
  return has_stalled_ && gear >= 1 && gear <= wanted_gear;
}

// A gear that went in before the speed for which it was meant, or long after it.
void FaultWatch::judge_speed(const DriveSample& now, double at) {
  const double speed = now.car.road_speed;
  const bool up = now.car.gear > last_gear_;
  const double least_speed = up ? (1.0 - kNearly) * at : at - kBeyond;
  const double most_speed = up ? at + kBeyond : (1.0 + kNearly) * at;
  if (speed >= least_speed && speed <= most_speed) return;
  const bool early = up ? speed < least_speed : speed > most_speed;
  FaultKind kind = FaultKind::late_shift;
  if (early) kind = up ? FaultKind::early_shift : FaultKind::early_downshift;
  const bool by_share = kind == FaultKind::early_downshift;
  const double turned = shaft_per_road(car_, last_gear_) * speed;
  const Severity severity = fault_severity(kind, by_share ? asked_ / suits_up_to(car_, band_) : turned);
  faults_.push_back({kind, severity, now.time(), by_share ? asked_ : turned});
  faults_.back().wanted = at;
  told_speed_ = true;
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
  if (coasting_.episode.finish()) tell_coasting();
  faults_.insert(faults_.end(), coasted_.begin(), coasted_.end());
  coasted_.clear();
  tell_rollback(last_.time());
  highest_ = last_.car.distance;
  if (const auto fault = release_.finish()) faults_.push_back(*fault);
}

void FaultWatch::judge(const ShiftRecord& record) {
  const std::size_t before = faults_.size();
  const bool without_clutch = judge_clutch(record);
  // Not reached for want of a clutch: that was said.
  const int missed = missed_gear(record);
  if (record.missed && !without_clutch && missed != kNeutralGear) {
    tell_if(FaultKind::missed_shift, record.end, missed, record.number);
  }
  tell_if(FaultKind::wrong_column, record.end, record.wrong_columns, record.number);
  judge_engine(record);
  judge_gear(record);
  judge_order(record, before);
  if (record.end >= shift_began_) rolled_ = {};
  tried_.clear();
  engaged_.clear();
  touch_error_ = 0.0;
  told_speed_ = false;
}

// The last that was tried and never in; without one, what the lesson wants. Not the gear that was left: on its way out
// the lever passes there too.
int FaultWatch::missed_gear(const ShiftRecord& record) const noexcept {
  const auto missed = [&](int gear) { return gear != record.from && gear != record.to && !has(engaged_, gear); };
  const auto tried = std::find_if(tried_.rbegin(), tried_.rend(), missed);
  if (tried != tried_.rend()) return *tried;
  return missed(wanted_gear_) ? wanted_gear_ : kNeutralGear;
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

const FaultWatch::Rolled& FaultWatch::rolled_in(const ShiftRecord& record) const noexcept {
  return record.end < shift_began_ ? rolled_before_ : rolled_;
}

// At a stand there is time, and on the way there the clutch is down to stop: of that the lever's way alone counts. What
// was told as coasting is not told again.
void FaultWatch::judge_time(const ShiftRecord& record, const Rolled& rolled) {
  const double took = std::min(rolled.counts(), std::max(record.clutch_time, record.lever_time));
  const bool coasted = coasted_at_ >= record.begin && coasted_at_ <= record.end;
  if (coasted || took - reading_ < least(FaultKind::too_slow)) return;
  tell_if(FaultKind::too_slow, record.end, took, record.number);
  slow_from_ = record.begin;
  slow_to_ = record.end;
  coasted_.clear();
}

void FaultWatch::judge_engine(const ShiftRecord& record) {
  const Rolled rolled = rolled_in(record);
  if (is_between_gears(record) && !rolled.dead) judge_time(record, rolled);
  faults_.insert(faults_.end(), coasted_.begin(), coasted_.end());
  coasted_.clear();
  if (!is_between_gears(record) || rolled.dead || !is_moving(last_.car.road_speed)) return;
  judge_revs(record);
  if (record.to <= record.from || record.from == kReverseGear || told_speed_) return;
  const double speed = record.engine_speed;
  if (speed < band_.from) tell_if(FaultKind::early_shift, record.begin, speed, record.number);
  if (speed > band_.to) tell_if(FaultKind::late_shift, record.begin, speed, record.number);
}

// A throttle that is still open and revs that do not match are two deeds. A blip into a lower gear is wanted: whether it
// was right, the revs tell.
void FaultWatch::judge_revs(const ShiftRecord& record) {
  const bool blips = is_down(record) && lifted_first(record);
  if (!blips) tell_if(FaultKind::throttle_in_shift, record.begin, record.flare - flare_needed(record), record.number);
  const double asked = shaft_per_road(car_, record.to) * last_.car.road_speed;
  // Below idle the clutch has to slip.
  if (record.clutch_time > 0.0 && asked > car_.engine.idle) {
    tell_if(FaultKind::rev_mismatch, record.end, std::abs(record.rev_error), record.number);
  }
}

// By the speed at which it was chosen.
void FaultWatch::judge_gear(const ShiftRecord& record) {
  const double share = asked_ / suits_up_to(car_, band_);
  if (!is_down(record) || told_speed_ || share < least(FaultKind::early_downshift)) return;
  const Severity severity = fault_severity(FaultKind::early_downshift, share);
  faults_.push_back({FaultKind::early_downshift, severity, record.end, asked_, record.number});
}

// Only between gears and driving: pulling away wants the throttle before the clutch. Clutch and throttle out of time
// are out of order too: that was said.
void FaultWatch::judge_order(const ShiftRecord& record, std::size_t faults_before) {
  if (!is_between_gears(record) || rolled_in(record).dead || !is_moving(last_.car.road_speed)) return;
  const auto said = [](const DriveFault& fault) {
    return fault.kind == FaultKind::no_clutch || fault.kind == FaultKind::clutch_early ||
           fault.kind == FaultKind::clutch_late || fault.kind == FaultKind::throttle_in_shift;
  };
  const auto first = faults_.begin() + static_cast<std::ptrdiff_t>(faults_before);
  if (std::any_of(first, faults_.end(), said)) return;
  // What is exchanged within the tolerance of the clutch's timing is in order.
  const int forgiven = (record.clutch_lead < 0.0 ? 2 : 0) + (record.clutch_lag < 0.0 ? 2 : 0);
  if (tell_if(FaultKind::step_order, record.begin, record.steps_out_of_place - forgiven, record.number))
    faults_.back().wanted = static_cast<double>(first_slip(record.steps, record.from, record.to));
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
