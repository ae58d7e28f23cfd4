// A shift of the simulated driver: clutch, throttle, and the hand's path through the gate.
#include <algorithm>
#include <cmath>
#include <utility>

#include "app/lessons/simulated_driver/driver_constants.h"
#include "app/lessons/simulated_driver/simulated_driver.h"
#include "app/vehicle/synchroniser.h"
#include "haptics/loop/shift_script.h"

namespace gearshift::lessons {
namespace {

// -1 or 1; 0 for neutral, which has no slot.
double side_of(const haptics::Gate& gate, int gear) noexcept {
  const int slot = haptics::slot_of_gear(gate, gear);
  return slot == haptics::kNoSlot ? 0.0 : static_cast<double>(static_cast<int>(haptics::slot_of(gate, slot).side));
}

}  // namespace

std::optional<int> SimulatedDriver::wanted_gear(const vehicle::DriveSample& now) const {
  const LessonIntent& wants = intent();
  const auto other = [&](std::optional<int> gear) { return gear && *gear != now.car.gear ? gear : std::nullopt; };
  if (lug_gear_ != haptics::kNeutralGear) return other(lug_gear_);
  if (should_stall_by_brake(now)) return std::nullopt;
  if (other(wants.gear)) return wants.gear;
  const bool rolls_back = now.car.road_speed < -kMinRollingSpeed && wants.motion == Motion::stop;
  if (rolls_back && is_due(ErrorKind::wrong_direction) && current_step_ + 1 < intents_.size())
    return other(intents_[current_step_ + 1].gear);
  const bool up_next =
      wants.accelerates && current_step_ + 1 < intents_.size() && intents_[current_step_ + 1].next_gear;
  const bool coupled = feet_.clutch.value() == 0.0 && now.car.clutch_locked;
  if (up_next && coupled && should_shift_early(now)) return other(intents_[current_step_ + 1].next_gear);
  if (!wants.next_gear) return std::nullopt;
  if (should_shift_late(now)) return std::nullopt;
  if (over_rev_late_ && is_due(ErrorKind::over_rev) && coupled && now.car.gear <= 2) return std::nullopt;
  return other(wants.next_gear);
}

// True if the driver should first lift the clutch in neutral, so that the gearbox shaft turns and the gears can grind.
bool SimulatedDriver::should_spin_shaft(const vehicle::DriveSample& now) const noexcept {
  const bool is_stopped_in_neutral =
      now.car.gear == haptics::kNeutralGear && std::abs(now.car.road_speed) < kMaxStandingSpeed;
  return is_due(ErrorKind::grind) && is_stopped_in_neutral && now.car.running &&
         now.car.shaft_speed < 0.8 * car_.engine.idle;
}

// Returns the target road speed of this step or, if this step has none, of the next step [m/s].
std::optional<double> SimulatedDriver::speed_to_shift(std::size_t step) const noexcept {
  for (std::size_t i = step; i < lesson_.steps.size() && i <= step + 1; ++i) {
    if (lesson_.steps[i].at) return lesson_.steps[i].at;
  }
  return std::nullopt;
}

// Returns the engine speed that the step's prompt names or, where the shift light tells when, the car's `advice`
// [rad/s].
std::optional<double> SimulatedDriver::revs_to_shift(std::size_t step,
                                                     double vehicle::EngineSpec::*advice) const noexcept {
  if (step >= lesson_.steps.size()) return std::nullopt;
  const DriveCondition& until = lesson_.steps[step].until;
  if (until.shift_light == true) return car_.engine.*advice;
  return until.engine_above;
}

// True if the driver should shift up too early on purpose: below the step's speed or, without one, well below the revs
// of the prompt.
bool SimulatedDriver::should_shift_early(const vehicle::DriveSample& now) const noexcept {
  if (!is_due(ErrorKind::early_shift) || now.car.engine_speed < 1.25 * car_.engine.idle) return false;
  const std::optional<double> at = speed_to_shift(current_step_ + 1);
  if (at) return now.car.road_speed < kEarlyShiftFactor * *at;
  const std::optional<double> revs = revs_to_shift(current_step_, &vehicle::EngineSpec::shift_low);
  return revs && now.car.engine_speed < kEarlyShiftFactor * *revs;
}

// True while the driver delays a shift on purpose, until the engine speed is far above that of the last prompt or the
// road speed is far past the step's speed.
bool SimulatedDriver::should_shift_late(const vehicle::DriveSample& now) const noexcept {
  const bool coupled = feet_.clutch.value() == 0.0 && now.car.clutch_locked;
  if (!is_due(ErrorKind::late_shift) || !coupled || !intent().next_gear) return false;
  const bool up = *intent().next_gear > now.car.gear;
  if (const std::optional<double> at = speed_to_shift(current_step_))
    return up ? now.car.road_speed < *at + kLateShiftMargin : now.car.road_speed > *at - kLateShiftMargin;
  const std::optional<double> revs =
      current_step_ > 0 ? revs_to_shift(current_step_ - 1, &vehicle::EngineSpec::shift_high) : std::nullopt;
  return up && revs && now.car.engine_speed < std::min(kLateShiftFactor * *revs, 0.98 * car_.engine.red_line);
}

SimulatedDriver::Detour SimulatedDriver::detour_for(const vehicle::DriveSample& now, int gear) noexcept {
  if (gear == haptics::kNeutralGear || lug_gear_ == gear) return Detour::none;
  if (is_due(ErrorKind::wrong_gear) && wrong_gear_for(gear, now.car.gear) != haptics::kNeutralGear &&
      mark_done(ErrorKind::wrong_gear))
    return Detour::wrong_gear;
  if (std::abs(now.car.road_speed) > kMinDrivingSpeed && now.car.gear >= 2 && mark_done(ErrorKind::blocked))
    return Detour::blocked;
  if (mark_done(ErrorKind::missed_shift)) return Detour::missed;
  return Detour::none;
}

// Returns a wrong gear that the gate has, preferably a gear that is too high; neutral if there is none.
int SimulatedDriver::wrong_gear_for(int gear, int from) const noexcept {
  for (const int wrong : {gear + 1, gear + 2, gear - 2, gear - 1}) {
    if (wrong >= 1 && wrong != from && haptics::slot_of_gear(gate_, wrong) != haptics::kNoSlot) return wrong;
  }
  return haptics::kNeutralGear;
}

void SimulatedDriver::begin_shift(const vehicle::DriveSample& now, int gear) {
  shifting_ = true;
  shift_ = Shift{};
  shift_.detour = detour_for(now, gear);
  shift_.gear = gear;
  if (shift_.detour == Detour::wrong_gear) shift_.gear = wrong_gear_for(gear, now.car.gear);
  if (shift_.detour == Detour::blocked) shift_.gear = 1;
  shift_.between_gears = now.car.gear != haptics::kNeutralGear && gear != haptics::kNeutralGear;
  shift_.is_down = shift_.between_gears && gear >= 1 && gear < now.car.gear;
  mark_done(ErrorKind::grind);
  if (intent().accelerates) mark_done(ErrorKind::early_shift);
  if (is_lingering_) mark_done(ErrorKind::late_shift);
  shift_.uses_clutch = !is_due(ErrorKind::no_clutch);
  shift_.lift_at = now.time() + std::max(0.0, noise(skill_.timing_spread));
  shift_.flares_until = now.time() + 0.6 * errors_.of(ErrorKind::throttle_in_shift);
  shift_.press_at = now.time() + std::max(0.0, noise(skill_.timing_spread));
  shift_.hand_lead = kHandLead + noise(skill_.timing_spread);
  const double late = errors_.of(ErrorKind::clutch_late);
  if (late > 0.0) shift_.press_at = now.time() + 0.35 * late, shift_.hand_lead = -10.0;
  const double lag = kClutchLag + noise(skill_.timing_spread);
  const bool dawdles = errors_.of(ErrorKind::too_slow) > 0.0;
  // A foot that is too early by at most kMaxClutchLead waits, because the hand feels that the synchroniser ring still
  // blocks.
  shift_.clutch_early = (lag < -kMaxClutchLead && !dawdles) || errors_.of(ErrorKind::clutch_early) > 0.0;
  if (skill_.double_clutches && shift_.is_down && shift_.uses_clutch && shift_.detour == Detour::none)
    shift_.then = std::exchange(shift_.gear, haptics::kNeutralGear);
  release_at_ = std::max(0.0, lag);  // [s] delay after the gear is engaged; end_shift() converts it
  if (is_due(ErrorKind::wrong_direction) && now.car.road_speed < -kMinRollingSpeed)
    mark_done(ErrorKind::wrong_direction);
}

void SimulatedDriver::follow_shift(const vehicle::DriveSample& now) {
  if (shift_.is_revving_in_neutral) return rev_in_neutral(now);
  shift_feet(now);
  shift_hand(now);
  if (!has_arrived(now)) return;
  if (shift_.then == haptics::kNeutralGear) return end_shift(now);
  shift_.is_revving_in_neutral = true;
  blip_since_ = -1.0;
  are_revs_matched_ = false;
  rev_bias_ = std::exp(noise(skill_.rev_spread));
}

// The middle of double-clutching: lets the clutch up in neutral, brings engine and gearbox to the lower gear's speed,
// and goes on to that gear.
void SimulatedDriver::rev_in_neutral(const vehicle::DriveSample& now) {
  set_brakes(now);
  feet_.clutch.move_to(0.0, kClutchRateToBite);
  if (feet_.clutch.value() > 0.0 || !match_revs(now, shaft_speed_in(now, shift_.then))) return;
  shift_.is_revving_in_neutral = shift_.in_hand = false;
  shift_.has_revved = true;
  shift_.gear = std::exchange(shift_.then, haptics::kNeutralGear);
  shift_.press_at = now.time();
}

void SimulatedDriver::shift_feet(const vehicle::DriveSample& now) {
  const double time = now.time();
  set_brakes(now);
  if (shift_.between_gears && time < shift_.flares_until) {
    feet_.throttle.move_to(0.8, 10.0);
  } else if (shift_.has_revved) {
    hold_revs(shaft_speed_in(now, shift_.gear));
  } else if (!make_over_rev(now) && time >= shift_.lift_at) {
    feet_.throttle.move_to(0.0, kLiftRate);
  }
  if (!shift_.uses_clutch) {
    feet_.clutch.move_to(0.0, kClutchRateToBite);
    // The throttle first takes the load off a gear that it holds, then matches the revs.
    const bool is_out = now.car.gear == haptics::kNeutralGear;
    if (shift_.between_gears && hand_.time_waiting(time) > 0.3)
      hold_revs(is_out ? std::abs(shaft_speed_in(now, shift_.gear)) : perceived_speed_);
    return;
  }
  const vehicle::SyncPhase phase = now.car.sync;
  const bool in_ring = phase == vehicle::SyncPhase::synchronising || phase == vehicle::SyncPhase::passing;
  const bool early = shift_.clutch_early && shift_.between_gears && hand_.in_last_stroke();
  shift_.releases_early = early && hand_.time_waiting(time) < kStuckTime && (shift_.releases_early || in_ring);
  if (shift_.releases_early) {
    // Lift the pedal quickly to just past the bite point, and then slowly. With the pedal further up, the synchroniser
    // ring would never let the gear in.
    feet_.clutch.move_to(bite_ - 0.08, feet_.clutch.value() > bite_ - 0.03 ? 8.0 : 0.15);
  } else if (time >= shift_.press_at) {
    press_clutch();
  }
}

void SimulatedDriver::press_clutch() {
  feet_.clutch.move_to(1.0, kPressRate);
}

// Reverse has no synchroniser, so the driver waits until the gearbox shaft has stopped: kShaftRestTime with the clutch
// down.
bool SimulatedDriver::waits_for_shaft(const vehicle::DriveSample& now) const noexcept {
  if (shift_.gear != haptics::kReverseGear || errors_.of(ErrorKind::grind) > 0.0) return false;
  return now.time() - clutch_down_at_ < kShaftRestTime;
}

void SimulatedDriver::shift_hand(const vehicle::DriveSample& now) {
  const double time = now.time();
  if (!shift_.in_hand) {
    const bool is_down = clutch_is_down_ && time - clutch_down_at_ >= shift_.hand_lead;
    const double to_bite = shift_.press_at + bite_ / kPressRate;
    const bool ahead = shift_.hand_lead < 0.0 && time >= to_bite + shift_.hand_lead;
    const bool ready = shift_.uses_clutch ? (is_down || ahead) : feet_.clutch.value() == 0.0;
    if (ready && !waits_for_shaft(now)) reach(now, shift_.gear);
    return;
  }
  const bool pushes = now.car.sync == vehicle::SyncPhase::synchronising;
  const bool in_slot = hand_.in_last_stroke() && now.car.sync != vehicle::SyncPhase::free;
  if (shift_.detour == Detour::blocked) hand_.set_push_limit(pushes ? 4.0 : 0.0);
  const bool is_stopped = in_slot && now.car.sync != vehicle::SyncPhase::indexing;  // by the ring or the end stop
  if (errors_.of(ErrorKind::over_push) > 0.0 && is_stopped)
    hand_.set_extra(
        {0.0, (kBaseOverPush + kOverPushGain * errors_.of(ErrorKind::over_push)) * side_of(gate_, shift_.gear)});
  const double time_waiting = hand_.time_waiting(time);
  const bool at_ring = shift_.detour == Detour::missed && hand_.is_at_end(time) && in_slot;
  const bool tired = shift_.detour == Detour::blocked && hand_.is_at_end(time) && time_waiting > 2.0;
  const bool no_use = !shift_.uses_clutch && !shift_.between_gears && time_waiting > 0.5;
  if (at_ring || tired || no_use) return draw_back(now);
  const bool is_beside_slot = now.lever.slot == haptics::kNoSlot;  // the lever hit a wall next to the slot
  const double patience = pushes ? kSyncPatience : is_beside_slot ? kBesideSlotTime + skill_.reaction : kStuckTime;
  if (time_waiting > patience) {
    if (!shift_.uses_clutch) return draw_back(now);
    reach(now, shift_.gear);
  }
}

// Starts moving the hand from the lever's position to the gear.
void SimulatedDriver::reach(const vehicle::DriveSample& now, int gear) {
  const glm::dvec2 from = now.lever.lever;
  std::vector<haptics::HandStroke> strokes;
  if (gear != haptics::kNeutralGear && shift_.detour == Detour::none && mark_done(ErrorKind::wrong_column)) {
    strokes = strokes_into_mouth(from, now.car.gear, wrong_gear_for(gear, now.car.gear));
  }
  const glm::dvec2 begin = strokes.empty() ? from : strokes.back().to;
  const std::vector<haptics::HandStroke> to_gear = strokes_to(begin, now.car.gear, gear);
  strokes.insert(strokes.end(), to_gear.begin(), to_gear.end());
  if (shift_.detour == Detour::missed && gear != haptics::kNeutralGear) {
    const haptics::Slot& slot = haptics::slot_of(gate_, haptics::slot_of_gear(gate_, gear));
    const vehicle::SleeveStations sleeve = vehicle::sleeve_stations(gate_, slot);
    strokes.back().to.y = side_of(gate_, gear) * 0.5 * (sleeve.index + sleeve.block);  // before the ring
  }
  for (haptics::HandStroke& stroke : strokes) stroke.to += glm::dvec2{noise(skill_.aim_noise), noise(skill_.aim_noise)};
  hand_.start(std::move(strokes), from, now.time());
  shift_.in_hand = true;
}

std::vector<haptics::HandStroke> SimulatedDriver::strokes_to(glm::dvec2 from, int old_gear, int gear) const {
  return strokes_to_gear(gate_, from, old_gear, gear, skill_.pace);
}

// Returns the strokes to a point just beyond the mouth of the gear's slot.
std::vector<haptics::HandStroke> SimulatedDriver::strokes_into_mouth(glm::dvec2 from, int old_gear, int gear) const {
  if (gear == haptics::kNeutralGear) return {};
  std::vector<haptics::HandStroke> strokes = strokes_to(from, old_gear, gear);
  strokes.back().to.y = side_of(gate_, gear) * (gate_.half_aisle + gate_.chamfer + kMouthDepth);
  strokes.back().duration = kMouthStrokeTime;
  return strokes;
}

// Abandons the shift: moves the lever back to neutral, then lifts the clutch. After a missed shift, or a shift without
// the clutch, the driver waits for kPauseAfterMiss before the next attempt.
void SimulatedDriver::draw_back(const vehicle::DriveSample& now) {
  done_errors_[static_cast<std::size_t>(ErrorKind::no_clutch)] |= !shift_.uses_clutch;
  const bool rests = shift_.detour == Detour::missed || !shift_.uses_clutch;
  hand_.set_push_limit(0.0);
  shift_.detour = Detour::back;
  shift_.gear = haptics::kNeutralGear;
  reach(now, haptics::kNeutralGear);
  if (rests) pause_until_ = now.time() + kPauseAfterMiss;
}

bool SimulatedDriver::has_arrived(const vehicle::DriveSample& now) const noexcept {
  if (!shift_.in_hand || now.car.gear != shift_.gear) return false;
  return shift_.gear != haptics::kNeutralGear || hand_.is_at_end(now.time());
}

void SimulatedDriver::end_shift(const vehicle::DriveSample& now) {
  shifting_ = false;
  hand_.set_push_limit(0.0);
  gear_in_at_ = now.time();
  release_at_ += now.time();
  if (shift_.between_gears && errors_.of(ErrorKind::step_order) > 0.0)
    release_at_ = now.time() + kThrottleLead * errors_.of(ErrorKind::step_order);
  if (shift_.between_gears && std::abs(now.car.road_speed) > kMinCoastingSpeed && mark_done(ErrorKind::too_slow))
    release_at_ = now.time() + kDawdleTime * errors_.of(ErrorKind::too_slow);
  release_rate_ = kClutchRateThroughBite * skill_.release_haste * std::exp(noise(skill_.release_spread));
  rev_bias_ = std::exp(noise(skill_.rev_spread));
  launch_speed_ = skill_.launch_speed_factor * kLaunchSpeed * rev_bias_;
  blip_since_ = -1.0;
  are_revs_matched_ = false;
}

void SimulatedDriver::rest_hand(const vehicle::DriveSample& now) {
  if (shifting_) return;
  if (now.time() - gear_in_at_ > kKnobReleaseTime) {
    hand_.release_lever();
    hand_.set_extra({0.0, 0.0});
  }
  const bool leans = now.car.gear != haptics::kNeutralGear && errors_.of(ErrorKind::riding_lever) > 0.0;
  const double push = leans ? 6.0 * errors_.of(ErrorKind::riding_lever) * side_of(gate_, now.car.gear) : 0.0;
  hand_.set_lean({0.0, push});
}

}  // namespace gearshift::lessons
