#include "app/lessons/assessment/error_detector.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include <glm/geometric.hpp>

#include "app/lessons/assessment/step_order.h"
#include "haptics/files/parameter.h"

namespace gearshift::lessons {
namespace {

// Engineering values.
constexpr double kStallWindow = 1.0;         // [s] window before a stall whose highest engine speed is reported
constexpr double kLugLoad = 0.7;             // [1] fraction of the available torque that counts as high load
constexpr double kMaxRidingTime = 6.0;       // [s] riding or coasting is reported after this time even if it continues
constexpr double kMinRidingPedal = 0.08;     // [1] pedal
constexpr double kMinRidingForce = 3.0;      // [N]
constexpr double kMinDrivingSpeed = 4.0;     // [m/s] the clutch may be needed below this speed, to stop or to creep
constexpr double kBraking = 0.05;            // [1] pedal
constexpr double kHardBraking = 0.5;         // [1] brake pedal position that shows the intention to stop at any speed
constexpr double kMaxShiftTime = 6.0;        // [s] after this time an open clutch counts as coasting, not as a shift
constexpr double kMaxDownshiftFactor = 1.2;  // [1] largest engine speed for a downshift, relative to `shift_high`
constexpr double kMinBlockedPush = 3.0;      // [N] smallest hand force that counts as a push against a synchroniser
constexpr double kMinRollbackSpeed = 0.01;   // [m/s]
constexpr double kStartupTime = 1.0;         // [s] time that a started engine needs to reach idle speed
constexpr double kSpeedTolerance = 0.07;     // [1] relative tolerance of early shifts: speedometer accuracy
// [m/s] A shift may come this much later than its target speed. A car that decelerates at 1.5 m/s^2 slows by 12 km/h
// while the driver reads the prompt (1.05 s, Green 2000) and shifts (1.2 s).
constexpr double kSpeedOvershoot = 12.0 / haptics::kKmhPerMps;

bool is_moving(double speed) noexcept {
  return std::abs(speed) > kMinDrivingSpeed;
}

double threshold(ErrorKind kind) noexcept {
  return error_rule(kind).raise;
}

bool contains(const std::vector<int>& gears, int gear) {
  return std::find(gears.begin(), gears.end(), gear) != gears.end();
}

void move_to_back(std::vector<int>& gears, int gear) {
  std::erase(gears, gear);
  gears.push_back(gear);
}

bool is_between_gears(const ShiftRecord& record) noexcept {
  return record.from != haptics::kNeutralGear && record.to != haptics::kNeutralGear && !record.missed;
}

bool is_down(const ShiftRecord& record) noexcept {
  return is_between_gears(record) && record.to >= 1 && record.to < record.from;
}

// True if the throttle was released before the clutch was pressed. Any later rise of the engine speed is then a blip.
bool lifted_first(const ShiftRecord& record) {
  const auto first = std::find_if(record.steps.begin(), record.steps.end(), [](ShiftStep step) {
    return step == ShiftStep::throttle_off || step == ShiftStep::clutch_down;
  });
  return first != record.steps.end() && *first == ShiftStep::throttle_off;
}

}  // namespace

double max_downshift_speed(const vehicle::CarSpec& car, const ShiftBand& band) noexcept {
  return band.to < car.engine.limiter ? band.to : kMaxDownshiftFactor * car.engine.shift_high;
}

ErrorDetector::ErrorDetector(const vehicle::CarSpec& car, const haptics::Gate& gate, ShiftBand band, double reading)
    : car_(car),
      gate_(gate),
      band_(band),
      reading_(reading),
      release_(car),
      engine_(kStallWindow),
      over_rev_{ErrorKind::over_rev, Measure::peak, Episode(0.0)},
      lugging_{ErrorKind::lugging, Measure::length, Episode(threshold(ErrorKind::lugging))},
      riding_clutch_{ErrorKind::riding_clutch, Measure::length,
                     Episode(threshold(ErrorKind::riding_clutch), kMaxRidingTime)},
      riding_lever_{ErrorKind::riding_lever, Measure::length,
                    Episode(threshold(ErrorKind::riding_lever), kMaxRidingTime)},
      over_push_{ErrorKind::over_push, Measure::peak, Episode(0.0)},
      grind_{ErrorKind::grind, Measure::sum, Episode(0.0)},
      block_{ErrorKind::blocked, Measure::length, Episode(threshold(ErrorKind::blocked))},
      coasting_{ErrorKind::coasting, Measure::length, Episode(threshold(ErrorKind::coasting), kMaxRidingTime)} {}

void ErrorDetector::add(const vehicle::DriveSample& sample, int wanted_gear, bool shifting, double at) {
  if (first_) {
    last_ = sample;
    last_gear_ = driven_gear_ = sample.car.gear;
    highest_ = sample.car.distance;
  }
  first_ = false;
  wanted_gear_ = wanted_gear;
  const double dt = std::clamp(sample.time() - last_.time(), 0.0, vehicle::kMaxSampleInterval);
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

void ErrorDetector::follow_shift(const vehicle::DriveSample& now, bool shifting, double dt) noexcept {
  const bool moves = shifting && now.car.gear != last_.car.gear;
  if (shifting && !shifting_) {
    rolling_before_ = std::exchange(rolling_, {});
    shift_began_ = now.time();
  }
  if (shifting) update_rolling_time(now, moves, dt);
  const bool is_engine_not_ready = !now.car.running || now.time() - runs_since_ < kStartupTime;
  rolling_.is_engine_not_ready = rolling_.is_engine_not_ready || (shifting && is_engine_not_ready);
  if (moves && !shift_moved_) shift_moved_at_ = now.time();
  shift_moved_ = shifting && (shift_moved_ || moves);
  shifting_ = shifting;
}

void ErrorDetector::update_rolling_time(const vehicle::DriveSample& now, bool moves, double dt) noexcept {
  if (is_moving(now.car.road_speed)) {
    rolling_.all += dt;
  } else {
    const bool is_braked_to_stop = now.car.pedals.brake > kBraking && now.car.pedals.clutch >= car_.clutch.bite;
    rolling_.is_braked_to_stop = rolling_.is_braked_to_stop || is_braked_to_stop;
  }
  if (moves && !shift_moved_) rolling_.left = rolling_.all;
  if (moves) rolling_.in = rolling_.all;
}

void ErrorDetector::watch_engine(const vehicle::DriveSample& now, double dt) {
  const double speed = now.car.engine_speed;
  // While the starter turns the engine, the engine may already fire. The engine counts as started only at its stall
  // speed or above.
  has_run_ = has_run_ || (now.car.running && speed >= car_.engine.stall);
  const bool died = last_.car.running && !now.car.running && now.car.ignition;
  if (died && has_run_) has_stalled_ = report_if(ErrorKind::stall, now.time(), engine_.value());
  if (now.car.running && !last_.car.running) runs_since_ = now.time();
  has_run_ = has_run_ && now.car.running;
  engine_.add(speed, dt);
  const ErrorRule& red = error_rule(ErrorKind::over_rev);
  const double limit = car_.engine.red_line * (over_rev_.episode.is_open() ? red.clear : red.raise);
  update_episode(over_rev_, speed > limit, speed, now.time(), dt);
  const bool labours = now.car.running && now.car.gear != haptics::kNeutralGear && now.car.clutch_locked &&
                       now.car.engine_load > kLugLoad && speed < car_.engine.lug_below;
  update_episode(lugging_, labours, 0.0, now.time(), dt);
}

// Detects riding the clutch: the foot rests on the pedal although the gear is engaged, the clutch does not slip, and
// the driver neither brakes nor shifts. An open clutch is not reported here, but as coasting or as a slow shift. Also
// collects the errors of clutch releases.
void ErrorDetector::watch_feet(const vehicle::DriveSample& now, double dt) {
  if (const auto error = release_.add(now, dt)) errors_.push_back(*error);
  const int slot = now.lever.slot;
  const bool at_rest = slot != haptics::kNoSlot && haptics::slot_of(gate_, slot).gear == now.car.gear &&
                       std::abs(now.lever.proxy.y) >= haptics::slot_of(gate_, slot).engage_depth;
  const bool needs_none = at_rest && is_moving(now.car.road_speed) && now.car.pedals.brake < kBraking;
  const bool rests =
      now.car.pedals.clutch > kMinRidingPedal && now.car.pedals.clutch < car_.clutch.bite && now.car.clutch_locked;
  const bool rides = rests && needs_none && !shift_moved_;
  update_episode(riding_clutch_, rides, 0.0, now.time(), dt);
}

// True if the driver brakes hard, or brakes at a speed too low for the last gear driven (`driven_gear_`).
bool ErrorDetector::is_stopping(const vehicle::DriveSample& now) const noexcept {
  const double turns = std::abs(vehicle::shaft_per_road(car_, driven_gear_) * now.car.road_speed);
  return now.car.pedals.brake > kHardBraking || (now.car.pedals.brake > kBraking && turns < car_.engine.lug_below);
}

// Detects coasting: engine and wheels are disconnected although the driver neither shifts nor stops.
void ErrorDetector::watch_drive(const vehicle::DriveSample& now, double dt) {
  if (now.car.gear != haptics::kNeutralGear && now.car.clutch_locked) driven_gear_ = now.car.gear;
  const bool open = now.car.gear == haptics::kNeutralGear || now.car.pedals.clutch >= car_.clutch.bite;
  const bool shifts = shift_moved_ && now.time() - shift_moved_at_ < kMaxShiftTime;
  const bool coasts = open && !shifts && now.car.running && is_moving(now.car.road_speed) && !is_stopping(now);
  if (coasting_.episode.update(coasts, 0.0, now.time(), dt)) report_coasting();
}

// Reports coasting, except in a shift already reported as too slow, because one press of the clutch causes both. If the
// gear has changed in the shift in progress, the error is kept in `coasted_` until the shift is judged.
void ErrorDetector::report_coasting() {
  const double began = coasting_.episode.begin();
  if (began >= slow_from_ && began <= slow_to_) return;
  const std::size_t before = errors_.size();
  report_episode(coasting_);
  if (errors_.size() == before) return;
  if (!shift_moved_) {
    coasted_at_ = began;
    return;
  }
  coasted_.push_back(errors_.back());
  errors_.pop_back();
}

void ErrorDetector::watch_hand(const vehicle::DriveSample& now, bool shifting, double dt) {
  const double push = glm::length(now.lever.f_h);
  const bool leans =
      push > kMinRidingForce && !shifting && now.car.gear != haptics::kNeutralGear && is_moving(now.car.road_speed);
  update_episode(riding_lever_, leans, push, now.time(), dt);
  const ErrorRule& rule = error_rule(ErrorKind::over_push);
  const bool over = push > (over_push_.episode.is_open() ? rule.clear : rule.raise);
  update_episode(over_push_, over, push, now.time(), dt);
}

// Returns the gear whose slot the lever is in, if the lever is past the detent or touches the synchroniser ring or
// dogs; otherwise neutral.
int ErrorDetector::gear_reached_for(const vehicle::DriveSample& now) const noexcept {
  if (now.lever.slot == haptics::kNoSlot) return haptics::kNeutralGear;
  const haptics::Slot& slot = haptics::slot_of(gate_, now.lever.slot);
  return vehicle::touches_dogs(now) || std::abs(now.lever.proxy.y) >= slot.release_depth ? slot.gear
                                                                                         : haptics::kNeutralGear;
}

// Detects grinding, and pushes against the synchroniser ring with the clutch down (`blocked`). With the clutch up, only
// records the largest difference of speeds (`touch_error_`); judge_clutch() uses it for `no_clutch`.
void ErrorDetector::watch_dogs(const vehicle::DriveSample& now, double dt) {
  const bool open = now.car.pedals.clutch >= car_.clutch.bite;
  const bool touching = vehicle::touches_dogs(now);
  const int gear = gear_reached_for(now);
  if (gear != haptics::kNeutralGear && gear != now.car.gear) move_to_back(tried_, gear);
  if (touching && !touching_ && !open && gear != haptics::kNeutralGear) {
    const double error = now.car.engine_speed - vehicle::shaft_per_road(car_, gear) * now.car.road_speed;
    if (std::abs(error) > std::abs(touch_error_)) touch_error_ = error;
  }
  touching_ = touching;
  const bool pushes =
      now.car.sync == vehicle::SyncPhase::synchronising && open && glm::length(now.lever.f_h) > kMinBlockedPush;
  update_episode(block_, pushes, 0.0, now.time(), dt);
  update_episode(grind_, now.car.grinding, now.car.grind_power, now.time(), dt);
}

// Reports shifting into reverse while rolling forward, or into a forward gear while rolling back. Reports at most once
// until the lever leaves the slot.
void ErrorDetector::watch_direction(const vehicle::DriveSample& now) {
  const int gear = gear_reached_for(now);
  if (gear == haptics::kNeutralGear) wrong_way_ = false;
  const double against = gear == haptics::kReverseGear ? now.car.road_speed : -now.car.road_speed;
  const bool arrives = gear != haptics::kNeutralGear && gear != last_gear_;
  if (arrives && !wrong_way_) wrong_way_ = report_if(ErrorKind::wrong_direction, now.time(), against);
}

// Reports a gear that was engaged although the lesson did not ask for it, or at the wrong road speed. Returning to the
// previous gear is allowed.
void ErrorDetector::watch_gear(const vehicle::DriveSample& now, int wanted_gear, double at) {
  const int gear = now.car.gear;
  const bool engaged = gear != last_.car.gear && gear != haptics::kNeutralGear;
  const bool other = wanted_gear != haptics::kNeutralGear && gear != wanted_gear && gear != last_gear_;
  if (engaged && gear == wanted_gear && now.car.running) has_stalled_ = false;
  if (engaged && other && !is_moving_off_again(gear, wanted_gear)) {
    report_if(ErrorKind::wrong_gear, now.time(), gear);
    errors_.back().wanted_gear = wanted_gear;
  }
  if (engaged) {
    move_to_back(engaged_, gear);
    demanded_speed_ = vehicle::shaft_per_road(car_, gear) * now.car.road_speed;
    if (gear == wanted_gear && at > 0.0 && gear != last_gear_) judge_speed(now, at);
  }
  if (gear != haptics::kNeutralGear) last_gear_ = gear;
}

// True if `gear` may be used to move off again after a stall: any forward gear up to the requested one.
bool ErrorDetector::is_moving_off_again(int gear, int wanted_gear) const noexcept {
  return has_stalled_ && gear >= 1 && gear <= wanted_gear;
}

// Reports a gear that was engaged far from the road speed that the lesson asks for.
void ErrorDetector::judge_speed(const vehicle::DriveSample& now, double at) {
  const double speed = now.car.road_speed;
  const bool up = now.car.gear > last_gear_;
  const double min_speed = up ? (1.0 - kSpeedTolerance) * at : at - kSpeedOvershoot;
  const double max_speed = up ? at + kSpeedOvershoot : (1.0 + kSpeedTolerance) * at;
  if (speed >= min_speed && speed <= max_speed) return;
  const bool early = up ? speed < min_speed : speed > max_speed;
  ErrorKind kind = ErrorKind::late_shift;
  if (early) kind = up ? ErrorKind::early_shift : ErrorKind::early_downshift;
  const bool by_ratio = kind == ErrorKind::early_downshift;
  const double turned = vehicle::shaft_per_road(car_, last_gear_) * speed;
  const Severity severity =
      error_severity(kind, by_ratio ? demanded_speed_ / max_downshift_speed(car_, band_) : turned);
  errors_.push_back(make_driving_error(kind, severity, now.time(), by_ratio ? demanded_speed_ : turned));
  errors_.back().target_speed = at;
  reported_speed_ = true;
}

// Once the car has stopped rolling back, reports how far it rolled. Rolling in reverse gear is not reported.
void ErrorDetector::watch_rollback(const vehicle::DriveSample& now) {
  const bool rolls = now.car.road_speed < -kMinRollbackSpeed && last_gear_ != haptics::kReverseGear;
  if (rolls) return;
  report_rollback(now.time());
  highest_ = now.car.distance;
}

void ErrorDetector::report_rollback(double time) {
  report_if(ErrorKind::rollback, time, highest_ - last_.car.distance);
}

void ErrorDetector::update_episode(WatchedEpisode& watched, bool on, double value, double time, double dt) {
  if (watched.episode.update(on, value, time, dt)) report_episode(watched);
}

void ErrorDetector::report_episode(const WatchedEpisode& watched) {
  const Episode& episode = watched.episode;
  double value = episode.length();
  if (watched.measure == Measure::peak) value = episode.peak();
  if (watched.measure == Measure::sum) value = episode.sum();
  const bool is_ratio = watched.kind == ErrorKind::over_rev;
  const double rule_value = is_ratio ? value / car_.engine.red_line : value;
  if (rule_value >= threshold(watched.kind)) {
    errors_.push_back(
        make_driving_error(watched.kind, error_severity(watched.kind, rule_value), episode.begin(), value));
  }
}

void ErrorDetector::finish() {
  for (WatchedEpisode* watched :
       {&over_rev_, &lugging_, &riding_clutch_, &riding_lever_, &over_push_, &grind_, &block_}) {
    if (watched->episode.finish()) report_episode(*watched);
  }
  if (coasting_.episode.finish()) report_coasting();
  errors_.insert(errors_.end(), coasted_.begin(), coasted_.end());
  coasted_.clear();
  report_rollback(last_.time());
  highest_ = last_.car.distance;
  if (const auto error = release_.finish()) errors_.push_back(*error);
}

void ErrorDetector::check_shift(const ShiftRecord& record) {
  const std::size_t before = errors_.size();
  const bool without_clutch = judge_clutch(record);
  // A gear missed because the clutch was not used is already reported as `no_clutch`.
  const int missed = missed_gear(record);
  if (record.missed && !without_clutch && missed != haptics::kNeutralGear) {
    report_if(ErrorKind::missed_shift, record.end, missed, record.number);
  }
  report_if(ErrorKind::wrong_column, record.end, record.wrong_columns, record.number);
  judge_engine(record);
  judge_gear(record);
  judge_order(record, before);
  if (record.end >= shift_began_) rolling_ = {};
  tried_.clear();
  engaged_.clear();
  touch_error_ = 0.0;
  reported_speed_ = false;
}

// Returns the last gear that was tried but never engaged. If there is none, returns the gear that the lesson asks for.
// The old gear is excluded, because the lever passes the old gear's detent on the way out.
int ErrorDetector::missed_gear(const ShiftRecord& record) const noexcept {
  const auto missed = [&](int gear) { return gear != record.from && gear != record.to && !contains(engaged_, gear); };
  const auto tried = std::find_if(tried_.rbegin(), tried_.rend(), missed);
  if (tried != tried_.rend()) return *tried;
  return missed(wanted_gear_) ? wanted_gear_ : haptics::kNeutralGear;
}

// Reports errors in clutch timing. Returns true if the shift was made, or tried with unmatched revs, without the clutch.
// With the engine running, a gear that went in without the clutch is an error even if the revs were matched: lessons that
// assess it are about the clutch.
bool ErrorDetector::judge_clutch(const ShiftRecord& record) {
  if (record.clutch_time == 0.0) {
    const double error = std::max(std::abs(touch_error_), std::abs(record.rev_error));
    const bool is_in = record.to != haptics::kNeutralGear && !record.missed;
    if (!is_in || rolling_time_in(record).is_engine_not_ready)
      return report_if(ErrorKind::no_clutch, record.begin, error, record.number);
    const bool is_matched = error < threshold(ErrorKind::no_clutch);
    const Severity severity = is_matched ? Severity::minor : error_severity(ErrorKind::no_clutch, error);
    errors_.push_back(make_driving_error(ErrorKind::no_clutch, severity, record.begin, error, record.number));
    return true;
  }
  report_if(ErrorKind::clutch_late, record.begin, -record.clutch_lead, record.number);
  report_if(ErrorKind::clutch_early, record.end, -record.clutch_lag, record.number);
  return false;
}

// Rise of engine speed that the new gear requires [rad/s]. A rise up to this value is a correct blip, not an error.
double ErrorDetector::flare_needed(const ShiftRecord& record) const noexcept {
  const double asked = vehicle::shaft_per_road(car_, record.to) * last_.car.road_speed;
  return std::max(0.0, asked - record.engine_speed);
}

const ErrorDetector::RollingTime& ErrorDetector::rolling_time_in(const ShiftRecord& record) const noexcept {
  return record.end < shift_began_ ? rolling_before_ : rolling_;
}

// Reports a slow shift. Only time while rolling counts. If the car is braked to a stop, the clutch is down anyway, so
// only the time between leaving the old gear and engaging the new one counts. A shift already reported as coasting is
// skipped.
void ErrorDetector::judge_time(const ShiftRecord& record, const RollingTime& rolled) {
  const double took = std::min(rolled.relevant_time(), std::max(record.clutch_time, record.lever_time));
  const bool coasted = coasted_at_ >= record.begin && coasted_at_ <= record.end;
  if (coasted || took - reading_ < threshold(ErrorKind::too_slow)) return;
  report_if(ErrorKind::too_slow, record.end, took, record.number);
  slow_from_ = record.begin;
  slow_to_ = record.end;
  coasted_.clear();
}

void ErrorDetector::judge_engine(const ShiftRecord& record) {
  const RollingTime rolled = rolling_time_in(record);
  if (is_between_gears(record) && !rolled.is_engine_not_ready) judge_time(record, rolled);
  errors_.insert(errors_.end(), coasted_.begin(), coasted_.end());
  coasted_.clear();
  if (!is_between_gears(record) || rolled.is_engine_not_ready || !is_moving(last_.car.road_speed)) return;
  judge_revs(record);
  if (record.to <= record.from || record.from == haptics::kReverseGear || reported_speed_) return;
  const double speed = record.engine_speed;
  if (speed < band_.from) report_if(ErrorKind::early_shift, record.begin, speed, record.number);
  if (speed > band_.to) report_if(ErrorKind::late_shift, record.begin, speed, record.number);
}

// An open throttle during the shift and mismatched revs after the shift are two separate errors. In a downshift with a
// blip, the throttle is correct, so only the rev error is judged.
void ErrorDetector::judge_revs(const ShiftRecord& record) {
  const bool blips = is_down(record) && lifted_first(record);
  if (!blips) report_if(ErrorKind::throttle_in_shift, record.begin, record.flare - flare_needed(record), record.number);
  const double asked = vehicle::shaft_per_road(car_, record.to) * last_.car.road_speed;
  // If the new gear requires less than idle speed, the clutch has to slip, so a rev error is unavoidable.
  if (record.clutch_time > 0.0 && asked > car_.engine.idle) {
    report_if(ErrorKind::rev_mismatch, record.end, std::abs(record.rev_error), record.number);
  }
}

// Reports a downshift at too high a speed. The speed at the moment of engaging the gear is judged.
void ErrorDetector::judge_gear(const ShiftRecord& record) {
  const double ratio = demanded_speed_ / max_downshift_speed(car_, band_);
  if (!is_down(record) || reported_speed_ || ratio < threshold(ErrorKind::early_downshift)) return;
  const Severity severity = error_severity(ErrorKind::early_downshift, ratio);
  errors_.push_back(
      make_driving_error(ErrorKind::early_downshift, severity, record.end, demanded_speed_, record.number));
}

// Judges the order of steps only in shifts between gears while driving, because moving off needs throttle before
// clutch. Skips shifts that already have an error of clutch or throttle timing, because that error is the cause of the
// wrong order.
void ErrorDetector::judge_order(const ShiftRecord& record, std::size_t errors_before) {
  if (!is_between_gears(record) || rolling_time_in(record).is_engine_not_ready || !is_moving(last_.car.road_speed))
    return;
  const auto is_cause_reported = [](const DrivingError& error) {
    return error.kind == ErrorKind::no_clutch || error.kind == ErrorKind::clutch_early ||
           error.kind == ErrorKind::clutch_late || error.kind == ErrorKind::throttle_in_shift;
  };
  const auto first = errors_.begin() + static_cast<std::ptrdiff_t>(errors_before);
  if (std::any_of(first, errors_.end(), is_cause_reported)) return;
  // Here a negative `clutch_lead` or `clutch_lag` is within its tolerance, so the two steps that it swaps do not count.
  const int forgiven = (record.clutch_lead < 0.0 ? 2 : 0) + (record.clutch_lag < 0.0 ? 2 : 0);
  if (report_if(ErrorKind::step_order, record.begin, record.steps_out_of_place - forgiven, record.number))
    errors_.back().mistake = first_order_mistake(record.steps, record.from, record.to);
}

bool ErrorDetector::report_if(ErrorKind kind, double time, double value, std::int64_t shift) {
  if (!(value >= threshold(kind))) return false;  // the negated comparison rejects NaN, too
  errors_.push_back(make_driving_error(kind, error_severity(kind, value), time, value, shift));
  return true;
}

std::vector<DrivingError> ErrorDetector::drain_errors() {
  for (DrivingError& error : errors_) error.speed_unit = car_.speed_unit;
  return std::exchange(errors_, {});
}

}  // namespace gearshift::lessons
