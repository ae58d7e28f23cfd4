// A shift: feet off and on, the hand through the gate.
#include <algorithm>
#include <cmath>
#include <utility>

#include "app/learner/learner_habits.h"
#include "app/learner/simulated_learner.h"
#include "haptics/loop/shift_script.h"

namespace gearshift {
namespace {

double side_of(const Gate& gate, int gear) noexcept {
  return static_cast<double>(static_cast<int>(slot_of(gate, slot_of_gear(gate, gear)).side));
}

bool closes_after(const Gate& gate, int gear, int from) noexcept {
  return std::any_of(lockouts(gate).begin(), lockouts(gate).end(), [&](const Lockout& lockout) {
    return lockout.kind == LockoutKind::after_gear && lockout.slot == slot_of_gear(gate, gear) &&
           lockout.after_gear == from;
  });
}

}  // namespace

std::optional<int> SimulatedLearner::wanted_gear(const DriveSample& now) const {
  const LessonIntent& wants = intent();
  const auto other = [&](std::optional<int> gear) { return gear && *gear != now.car.gear ? gear : std::nullopt; };
  if (lug_gear_ != kNeutralGear) return other(lug_gear_);
  if (brakes_to_stall(now)) return std::nullopt;
  if (other(wants.gear)) return wants.gear;
  const bool rolls_back = now.car.road_speed < -kRolls && wants.motion == Motion::stand;
  if (rolls_back && is_due(FaultKind::wrong_direction) && known_ + 1 < intents_.size())
    return other(intents_[known_ + 1].gear);
  const bool up_next = wants.accelerates && known_ + 1 < intents_.size() && intents_[known_ + 1].next_gear;
  const bool coupled = feet_.clutch.value() == 0.0 && now.car.clutch_locked;
  if (up_next && coupled && shifts_early(now)) return other(intents_[known_ + 1].next_gear);
  if (!wants.next_gear) return std::nullopt;
  if (shifts_late(now)) return std::nullopt;
  if (over_rev_late_ && is_due(FaultKind::over_rev) && coupled && now.car.gear <= 2) return std::nullopt;
  return other(wants.next_gear);
}

// Who does not wait for the gearbox lets the clutch up in neutral, and finds its shaft turning.
bool SimulatedLearner::spins_shaft(const DriveSample& now) const noexcept {
  const bool stands_in_neutral = now.car.gear == kNeutralGear && std::abs(now.car.road_speed) < kStill;
  return is_due(FaultKind::grind) && stands_in_neutral && now.car.running &&
         now.car.shaft_speed < 0.8 * car_.engine.idle;
}

// That the step says, or the one behind it for which it prepares. [m/s]
std::optional<double> SimulatedLearner::speed_to_shift(std::size_t step) const noexcept {
  for (std::size_t i = step; i < lesson_.steps.size() && i <= step + 1; ++i) {
    if (lesson_.steps[i].at) return lesson_.steps[i].at;
  }
  return std::nullopt;
}

// Upshifts, below the lesson's band or the step's speed.
bool SimulatedLearner::shifts_early(const DriveSample& now) const noexcept {
  if (!is_due(FaultKind::early_shift) || now.car.engine_speed < 1.25 * car_.engine.idle) return false;
  const std::optional<double> at = speed_to_shift(known_ + 1);
  return at ? now.car.road_speed < kFarBefore * *at : now.car.engine_speed < lesson_.shift_from;
}

// Above the lesson's band, or far beyond the step's speed.
bool SimulatedLearner::shifts_late(const DriveSample& now) const noexcept {
  const bool coupled = feet_.clutch.value() == 0.0 && now.car.clutch_locked;
  if (!is_due(FaultKind::late_shift) || !coupled || !intent().next_gear) return false;
  const bool up = *intent().next_gear > now.car.gear;
  if (const std::optional<double> at = speed_to_shift(known_))
    return up ? now.car.road_speed < *at + kFarBeyond : now.car.road_speed > *at - kFarBeyond;
  return up && lesson_.shift_to <= car_.engine.red_line && now.car.engine_speed < 1.1 * lesson_.shift_to;
}

SimulatedLearner::Errand SimulatedLearner::errand_for(const DriveSample& now, int gear) noexcept {
  if (gear == kNeutralGear || lug_gear_ == gear) return Errand::none;
  if (is_due(FaultKind::wrong_gear) && wrong_gear_for(gear, now.car.gear) != kNeutralGear &&
      once(FaultKind::wrong_gear))
    return Errand::wrong_gear;
  if (std::abs(now.car.road_speed) > kDriving && now.car.gear >= 2 && once(FaultKind::blocked)) return Errand::blocked;
  if (once(FaultKind::missed_shift)) return Errand::missed;
  return Errand::none;
}

// One too high, or else too low: never one that would turn the engine over its red line.
int SimulatedLearner::wrong_gear_for(int gear, int from) const noexcept {
  for (const int wrong : {gear + 1, gear + 2, gear - 2, gear - 1}) {
    if (wrong >= 1 && wrong != from && slot_of_gear(gate_, wrong) != kNoSlot) return wrong;
  }
  return kNeutralGear;
}

void SimulatedLearner::begin_shift(const DriveSample& now, int gear) {
  shifting_ = true;
  shift_ = Shift{};
  shift_.errand = errand_for(now, gear);
  shift_.gear = gear;
  if (shift_.errand == Errand::wrong_gear) shift_.gear = wrong_gear_for(gear, now.car.gear);
  if (shift_.errand == Errand::blocked) shift_.gear = 1;
  shift_.between_gears = now.car.gear != kNeutralGear && gear != kNeutralGear;
  once(FaultKind::grind);
  if (intent().accelerates) once(FaultKind::early_shift);
  if (lingers_) once(FaultKind::late_shift);
  shift_.uses_clutch = !is_due(FaultKind::no_clutch);
  shift_.lift_at = now.time() + std::max(0.0, noise(skill_.timing_spread));
  shift_.flares_until = now.time() + 0.6 * faults_.of(FaultKind::throttle_in_shift);
  shift_.press_at = now.time() + std::max(0.0, noise(skill_.timing_spread));
  shift_.hand_lead = kHandLead + noise(skill_.timing_spread);
  const double late = faults_.of(FaultKind::clutch_late);
  if (late > 0.0) shift_.press_at = now.time() + 0.35 * late, shift_.hand_lead = -10.0;
  const double lag = kClutchLag + noise(skill_.timing_spread);
  const bool dawdles = faults_.of(FaultKind::too_slow) > 0.0;
  // Who is a little too soon feels through the knob that the ring still holds, and the foot waits for it.
  shift_.clutch_early = (lag < -kFeelsRing && !dawdles) || faults_.of(FaultKind::clutch_early) > 0.0;
  release_at_ = std::max(0.0, lag);  // from the gear on
  if (is_due(FaultKind::wrong_direction) && now.car.road_speed < -kRolls) once(FaultKind::wrong_direction);
}

void SimulatedLearner::follow_shift(const DriveSample& now) {
  shift_feet(now);
  shift_hand(now);
  if (has_arrived(now)) end_shift(now);
}

void SimulatedLearner::shift_feet(const DriveSample& now) {
  const double time = now.time();
  set_brakes(now);
  if (shift_.between_gears && time < shift_.flares_until) {
    feet_.throttle.go(0.8, 10.0);
  } else if (!over_revs(now) && time >= shift_.lift_at) {
    feet_.throttle.go(0.0, kLiftRate);
  }
  if (!shift_.uses_clutch) {
    feet_.clutch.go(0.0, kToBite);
    if (shift_.between_gears && hand_.waited(time) > 0.3) hold_revs(std::abs(asked(now, shift_.gear)));
    return;
  }
  const SyncPhase phase = now.car.sync;
  const bool in_ring = phase == SyncPhase::synchronising || phase == SyncPhase::passing;
  const bool early = shift_.clutch_early && shift_.between_gears && hand_.in_last_stroke();
  shift_.comes_up = early && hand_.waited(time) < kStuck && (shift_.comes_up || in_ring);
  if (shift_.comes_up) {
    // Past the bite point at once, then slowly: further up the ring would never let the gear in.
    const double bite = car_.clutch.bite;
    feet_.clutch.go(bite - 0.08, feet_.clutch.value() > bite - 0.03 ? 8.0 : 0.15);
  } else if (time >= shift_.press_at) {
    press_clutch();
  }
}

void SimulatedLearner::press_clutch() {
  feet_.clutch.go(1.0, kPressRate);
}

// Reverse has no synchroniser: one waits until the gearbox stands still.
bool SimulatedLearner::waits_for_shaft(const DriveSample& now) const noexcept {
  if (shift_.gear != kReverseGear || faults_.of(FaultKind::grind) > 0.0) return false;
  return now.time() - clutch_down_at_ < kShaftRest;
}

void SimulatedLearner::shift_hand(const DriveSample& now) {
  const double time = now.time();
  if (!shift_.in_hand) {
    const bool is_down = clutch_is_down_ && time - clutch_down_at_ >= shift_.hand_lead;
    const double to_bite = shift_.press_at + car_.clutch.bite / kPressRate;
    const bool ahead = shift_.hand_lead < 0.0 && time >= to_bite + shift_.hand_lead;
    const bool ready = shift_.uses_clutch ? (is_down || ahead) : feet_.clutch.value() == 0.0;
    if (ready && !waits_for_shaft(now)) reach(now, shift_.gear);
    return;
  }
  const bool pushes = now.car.sync == SyncPhase::synchronising;
  const bool in_slot = hand_.in_last_stroke() && now.car.sync != SyncPhase::free;
  if (shift_.errand == Errand::blocked) hand_.set_feeble(pushes ? 4.0 : 0.0);
  if (faults_.of(FaultKind::over_push) > 0.0 && in_slot)
    hand_.set_extra({0.0, (kPushLeast + kPushMore * faults_.of(FaultKind::over_push)) * side_of(gate_, shift_.gear)});
  const double waited = hand_.waited(time);
  const bool at_ring = shift_.errand == Errand::missed && hand_.is_at_end(time) && is_behind_detent(now);
  const bool tired = shift_.errand == Errand::blocked && hand_.is_at_end(time) && waited > 2.0;
  const bool no_use = !shift_.uses_clutch && !shift_.between_gears && waited > 0.5;
  if (at_ring || tired || no_use) return draw_back(now);
  const bool beside = now.lever.slot == kNoSlot;  // a wall where a slot was meant
  const double patience = pushes ? kSyncPatience : beside ? kBeside + skill_.reaction : kStuck;
  if (waited > patience) {
    if (!shift_.uses_clutch) return draw_back(now);
    reach(now, shift_.gear);
  }
}

bool SimulatedLearner::is_behind_detent(const DriveSample& now) const noexcept {
  if (now.lever.slot == kNoSlot) return false;
  return std::abs(now.lever.proxy.y) >= slot_of(gate_, now.lever.slot).release_depth;
}

// The hand sets out for the gear, from where the lever is.
void SimulatedLearner::reach(const DriveSample& now, int gear) {
  const glm::dvec2 from = now.lever.lever;
  std::vector<HandStroke> strokes;
  if (gear != kNeutralGear && shift_.errand == Errand::none && once(FaultKind::wrong_column)) {
    strokes = strokes_into_mouth(from, now.car.gear, wrong_gear_for(gear, now.car.gear));
  }
  const glm::dvec2 begin = strokes.empty() ? from : strokes.back().to;
  const std::vector<HandStroke> way = strokes_to(begin, now.car.gear, gear);
  strokes.insert(strokes.end(), way.begin(), way.end());
  if (shift_.errand == Errand::missed && gear != kNeutralGear) {
    const Slot& slot = slot_of(gate_, slot_of_gear(gate_, gear));
    const double depth = slot.release_depth + kAtRing * (slot.engage_depth - slot.release_depth);
    strokes.back().to.y = side_of(gate_, gear) * depth;
  }
  for (HandStroke& stroke : strokes) stroke.to += glm::dvec2{noise(skill_.aim_noise), noise(skill_.aim_noise)};
  hand_.go(std::move(strokes), from, now.time());
  shift_.in_hand = true;
}

std::vector<HandStroke> SimulatedLearner::strokes_to(glm::dvec2 from, int old_gear, int gear) const {
  ShiftStyle style;
  style.pace = skill_.pace;
  style.reaction = kStrokeBegin;
  std::vector<int> gears{gear};
  if (closes_after(gate_, gear, old_gear)) gears.insert(gears.begin(), kNeutralGear);
  return shift_strokes(gate_, from, gears, style);
}

// As far as behind the mouth of that gear's slot.
std::vector<HandStroke> SimulatedLearner::strokes_into_mouth(glm::dvec2 from, int old_gear, int gear) const {
  if (gear == kNeutralGear) return {};
  std::vector<HandStroke> strokes = strokes_to(from, old_gear, gear);
  strokes.back().to.y = side_of(gate_, gear) * (gate_.half_aisle + gate_.chamfer + kBehindMouth);
  strokes.back().duration = kPeep;
  return strokes;
}

// Gives it up: back to neutral, the clutch up, and a while until it is tried again.
void SimulatedLearner::draw_back(const DriveSample& now) {
  done_[static_cast<std::size_t>(FaultKind::no_clutch)] |= !shift_.uses_clutch;
  const bool rests = shift_.errand == Errand::missed || !shift_.uses_clutch;
  hand_.set_feeble(0.0);
  shift_.errand = Errand::back;
  shift_.gear = kNeutralGear;
  reach(now, kNeutralGear);
  if (rests) pause_until_ = now.time() + kRestsAfterMiss;
}

bool SimulatedLearner::has_arrived(const DriveSample& now) const noexcept {
  if (!shift_.in_hand || now.car.gear != shift_.gear) return false;
  return shift_.gear != kNeutralGear || hand_.is_at_end(now.time());
}

void SimulatedLearner::end_shift(const DriveSample& now) {
  shifting_ = false;
  hand_.set_feeble(0.0);
  gear_in_at_ = now.time();
  release_at_ += now.time();
  if (shift_.between_gears && faults_.of(FaultKind::step_order) > 0.0)
    release_at_ = now.time() + kThrottleLead * faults_.of(FaultKind::step_order);
  if (shift_.between_gears && std::abs(now.car.road_speed) > kCoasts && once(FaultKind::too_slow))
    release_at_ = now.time() + kDawdles * faults_.of(FaultKind::too_slow);
  release_rate_ = kThroughBite * skill_.haste * std::exp(noise(skill_.release_spread));
  ear_ = std::exp(noise(skill_.rev_spread));
  launch_speed_ = skill_.gas * kLaunchSpeed * ear_;
  blip_since_ = -1.0;
  revs_fit_ = false;
}

void SimulatedLearner::rest_hand(const DriveSample& now) {
  if (shifting_) return;
  if (now.time() - gear_in_at_ > kHandLeaves) {
    hand_.let_go();
    hand_.set_extra({0.0, 0.0});
  }
  const bool leans = now.car.gear != kNeutralGear && faults_.of(FaultKind::riding_lever) > 0.0;
  const double push = leans ? 6.0 * faults_.of(FaultKind::riding_lever) * side_of(gate_, now.car.gear) : 0.0;
  hand_.set_lean({0.0, push});
}

}  // namespace gearshift
