// This work is based on:
// J.-P. Kim, J. Ryu. Robustly Stable Haptic Interaction Control using an Energy-bounding Algorithm. 2010
#include "app/lab/campaign/campaign_laws.h"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "haptics/contact/proxy.h"
#include "haptics/gate/gate_feel.h"
#include "haptics/joystick/finite.h"

namespace gearshift::lab {
namespace {

using glm::dvec2;

constexpr double kRounding = 1e-9;         // [m], [N], [J] tolerance for rounding errors, too small to feel
constexpr double kMaxCommandError = 1e-6;  // [N] tolerance for rounding: commanded minus delivered force
// [m] Limit for the peak-to-peak motion in a single case. The goal over all cases is stricter: at most 0.3 mm in 95 %
// of the cases.
constexpr double kQuietRipple = 1e-3;
// [counts] The same limit for coarse encoders, as a number of encoder counts. The reversal limiter only detects motions
// of at least 4 counts, and the true motion can be 1 count larger at each end.
constexpr double kQuietCounts = 6.0;

constexpr double kMinSettleTime = 1.0;  // [s]
constexpr double kSettledSwing = 10.0;  // [1] by this factor has a swing of hand and handle decayed
constexpr double kSmallSwing = 0.8e-3;  // [m] peak-to-peak width of a tremor, see reversal_limiter.cpp

constexpr std::array<LawText, kCampaignLaws> kLawTexts{{
    {"finite", "every output is a finite number", "bad cycles"},
    {"free space", "the displayed lever stays in free space", "cycles outside"},
    {"no wall", "the displayed lever crosses no wall and is never faster than the lever by more than 0.5 m/s",
     "times the allowed distance"},
    {"lockout", "the displayed lever passes no closed lockout", "crossings"},
    {"force", "the commanded force is within the device's maximum", "N"},
    {"slew", "the commanded force changes by no more per cycle than the guard allows", "N"},
    {"energy", "with energy bounding, no more energy is released than was stored or dissipated by the device's damping",
     "J"},
    {"guard", "the guard finds no fault", "(number of the fault)"},
    {"quiet", "a lever that is held still does not vibrate", "m"},
    {"fades", "while the hand keeps still, any remaining oscillation of the lever decays within seconds", "m"},
    {"gear holds", "while the lever is held still, the gear changes at most once", "violations"},
    {"reached", "a gripping hand that aims cleanly at a gear engages it", "missed"},
}};

// Length of the shortest path from `in`, a point in the slot, to `b`, a point outside the slot, through the slot's
// mouth. If both points are on the same side of the mouth, the path is reflected at the mouth, like a ray. [m]
double min_exit_path(const haptics::Gate& gate, int slot_number, dvec2 in, dvec2 b) noexcept {
  const haptics::Slot& slot = haptics::slot_of(gate, slot_number);
  const double side = static_cast<int>(slot.side), mouth = side * gate.half_aisle;
  const double before = std::abs(in.y - mouth), behind = std::abs(b.y - mouth);
  const haptics::Column& column = haptics::column_of(gate, slot.column);
  const double half = column.half_width + gate.chamfer;
  const double straight = in.x + (b.x - in.x) * before / std::max(before + behind, kRounding);
  const dvec2 through{std::clamp(straight, column.center - half, column.center + half), mouth};
  return glm::distance(in, through) + glm::distance(through, b);
}

// Lower bound for the length of a path through free space from a to b. [m]
double min_free_path(const haptics::Gate& gate, dvec2 a, dvec2 b) noexcept {
  // A point on the aisle's wall counts as outside the slot, even if rounding puts it inside.
  const auto slot_of_point = [&](dvec2 p) {
    return std::abs(p.y) <= gate.half_aisle + kRounding ? haptics::kNoSlot : haptics::slot_at(gate, p);
  };
  const int from = slot_of_point(a), to = slot_of_point(b);
  double length = glm::distance(a, b);
  if (from == to) return length;
  if (from != haptics::kNoSlot) length = std::max(length, min_exit_path(gate, from, a, b));
  if (to != haptics::kNoSlot) length = std::max(length, min_exit_path(gate, to, b, a));
  if (from == haptics::kNoSlot || to == haptics::kNoSlot) return length;
  return std::max(length, std::abs(a.y) + std::abs(b.y) - 2.0 * gate.half_aisle);
}

// True if p is beyond the lockout's wall.
bool is_past(const haptics::Gate& gate, const haptics::Lockout& lockout, dvec2 p) noexcept {
  if (lockout.lateral) return lockout.beyond * (p.x - lockout.barrier) > kRounding;
  const haptics::Slot& slot = haptics::slot_of(gate, lockout.slot);
  const haptics::Column& column = haptics::column_of(gate, slot.column);
  const double mouth = gate.half_aisle + gate.chamfer;
  // A point on the slot's side wall counts as inside the slot, even if rounding puts it outside.
  const bool in_column = std::abs(p.x - column.center) <= column.half_width + gate.chamfer + kRounding;
  return in_column && static_cast<int>(slot.side) * p.y > mouth + kRounding;
}

bool is_out_of_column(const haptics::Gate& gate, int gear, dvec2 p) noexcept {
  const haptics::Column& column =
      haptics::column_of(gate, haptics::slot_of(gate, haptics::slot_of_gear(gate, gear)).column);
  return std::abs(p.x - column.center) > column.half_width + gate.chamfer;
}

bool is_active(haptics::GuardState state) noexcept {
  return state == haptics::GuardState::armed || state == haptics::GuardState::ramping ||
         state == haptics::GuardState::running;
}

// Decay rate of an oscillation that is damped by handle and hand. The two masses of an elastic hand may swing one without
// the other, and the grip's damper only adds to their damping. [1/s]
double passive_decay(haptics::AxisModel handle, const haptics::HandImpedance& hand) noexcept {
  if (hand.is_elastic())
    return 0.5 * std::min(handle.damping / (handle.mass + hand.finger_mass), hand.damping / hand.mass);
  return 0.5 * (handle.damping + hand.damping) / (handle.mass + hand.mass);
}

double bad(bool is_bad) noexcept {
  return is_bad ? 1.0 : 0.0;
}

}  // namespace

const LawText& law_text(CampaignLaw law) noexcept {
  return kLawTexts[static_cast<std::size_t>(law)];
}

void LawRecord::note(CampaignLaw law, double value, double bound, double time) noexcept {
  LawResult& result = results_[static_cast<std::size_t>(law)];
  const bool is_first = result.checks++ == 0;
  const double worst = result.value - result.bound;
  const bool is_worse = !std::isnan(worst) && !(value - bound <= worst);
  if (is_first || is_worse) result.value = value, result.bound = bound, result.time = time;
}

bool LawRecord::any_broken() const noexcept {
  return std::any_of(results_.begin(), results_.end(), [](const LawResult& result) { return result.broken(); });
}

LawLimits law_limits(const haptics::HapticConfig& config, const haptics::SimulatedLeverConfig& lever,
                     const haptics::DeviceSpec& spec) noexcept {
  LawLimits limits;
  limits.period = haptics::period_s(config);
  limits.max_force = spec.max_force;
  limits.slew = config.guard.slew;
  limits.ramp = std::min(1.0, limits.period / config.guard.ramp_time);
  limits.can_drop_at_once = config.contact.energy_control == haptics::EnergyControl::energy_bounding;
  // Energy bounding may return half of the energy that the nominal damping dissipates in a nominal period. The true
  // damping must dissipate at least as much in the longest period.
  const bool is_enough = 1.0 - lever.model_error >= 0.5 * (1.0 + lever.period_jitter);
  limits.energy_bounded =
      limits.can_drop_at_once && is_enough && spec.delay == 0 && spec.device_wall_stiffness == dvec2(0.0);
  limits.damping = {spec.axis_x.damping, spec.axis_y.damping};
  limits.min_damping = (1.0 - lever.model_error) * limits.damping;
  limits.max_period = (1.0 + lever.period_jitter) * limits.period;
  limits.count = lever.encoder_counts > 0.0 ? spec.position_step : 0.0;
  limits.ripple = std::max(kQuietRipple, kQuietCounts * spec.position_step);
  limits.small_swing = std::max(kSmallSwing, kQuietCounts * spec.position_step);
  const double decay = std::min(passive_decay(spec.axis_x, lever.hand), passive_decay(spec.axis_y, lever.hand));
  // The hand's own swing after a shift, up to a slot's depth, is then shorter than the way between engage and release.
  limits.settle_time = std::max(kMinSettleTime, std::log(kSettledSwing) / decay);
  limits.remaining_swing = std::exp(-0.5 * decay * kFading);
  return limits;
}

void finite_law(const CyclePair& cycle, LawRecord& record) noexcept {
  const haptics::HapticSnapshot& now = cycle.now;
  const bool all = haptics::is_finite(now.lever) && haptics::is_finite(now.velocity) && haptics::is_finite(now.proxy) &&
                   haptics::is_finite(now.wall_force) && haptics::is_finite(now.feel_force) &&
                   haptics::is_finite(now.commanded) && haptics::is_finite(now.f_h) && haptics::is_finite(now.f_a);
  record.note(CampaignLaw::finite, bad(!all), 0.0, 1e-9 * static_cast<double>(now.time_ns));
}

void free_space_law(const CyclePair& cycle, const haptics::Gate& gate, LawRecord& record) noexcept {
  const bool is_free = haptics::in_free_space(gate, cycle.now.proxy, kRounding);
  record.note(CampaignLaw::free_space, bad(!is_free), 0.0, 1e-9 * static_cast<double>(cycle.now.time_ns));
}

void no_wall_law(const CyclePair& cycle, const haptics::Gate& gate, const LawLimits& limits,
                 LawRecord& record) noexcept {
  const double max_path = glm::distance(cycle.now.lever, cycle.before.lever) + haptics::kHandOverSpeed * limits.period;
  const double path = min_free_path(gate, cycle.before.proxy, cycle.now.proxy) - kRounding;
  record.note(CampaignLaw::no_wall, path / max_path, 1.0 + kRounding, 1e-9 * static_cast<double>(cycle.now.time_ns));
}

void LockoutLaw::update(const CyclePair& cycle, const haptics::Gate& gate, LawRecord& record) noexcept {
  const double time = 1e-9 * static_cast<double>(cycle.now.time_ns);
  std::uint32_t bit = 1u;
  for (const haptics::Lockout& lockout : haptics::lockouts(gate)) {
    bool closed = false;
    if (lockout.kind == haptics::LockoutKind::speed) {
      const double speed = std::abs(cycle.before.road_speed);
      if (speed > lockout.close_above) closed_ |= bit;
      if (speed < lockout.open_below) closed_ &= ~bit;
      closed = (closed_ & bit) != 0;
    }
    if (lockout.kind == haptics::LockoutKind::push_down) closed = !cycle.pressed_down;
    if (lockout.kind == haptics::LockoutKind::lift) closed = !cycle.lifted;
    if (lockout.kind == haptics::LockoutKind::after_gear) {
      if (is_out_of_column(gate, lockout.after_gear, cycle.before.proxy)) closed_ &= ~bit;
      if (cycle.before.gear == lockout.after_gear) closed_ |= bit;
      closed = (closed_ & bit) != 0;
    }
    const bool crossed = is_past(gate, lockout, cycle.now.proxy) && !is_past(gate, lockout, cycle.before.proxy);
    if (crossed) record.note(CampaignLaw::lockout, bad(closed), 0.0, time);
    bit <<= 1;
  }
}

void force_law(const CyclePair& cycle, const LawLimits& limits, LawRecord& record) noexcept {
  const dvec2 force = glm::abs(cycle.now.commanded);
  const int axis = force.x - limits.max_force.x > force.y - limits.max_force.y ? 0 : 1;
  record.note(CampaignLaw::force, force[axis], limits.max_force[axis], 1e-9 * static_cast<double>(cycle.now.time_ns));
}

// While the guard's ramp rises, its step adds to the allowed change. In state `armed` the change is not checked: no
// force acts yet, and the command is still the last value of an earlier ramp-down.
void slew_law(const CyclePair& cycle, const LawLimits& limits, LawRecord& record) noexcept {
  if (!is_active(cycle.now.guard) || !is_active(cycle.before.guard) || cycle.before.guard == haptics::GuardState::armed)
    return;
  const dvec2 now = cycle.now.commanded, before = cycle.before.commanded;
  // With energy bounding, a force may drop to zero in one cycle. Only a rise, or the part beyond zero, counts.
  const dvec2 allowed_drop = glm::max(dvec2(0.0), glm::sign(now) * before);
  const dvec2 change = limits.can_drop_at_once ? glm::abs(now) - allowed_drop : glm::abs(now - before);
  const bool is_ramping = cycle.before.guard != haptics::GuardState::running;
  const double max_force = std::max(limits.max_force.x, limits.max_force.y);
  const double bound = limits.slew + (is_ramping ? limits.ramp * max_force : 0.0) + kRounding;
  record.note(CampaignLaw::slew, std::max(change.x, change.y), bound, 1e-9 * static_cast<double>(cycle.now.time_ns));
}

void guard_law(const CyclePair& cycle, LawRecord& record) noexcept {
  const haptics::GuardState state = cycle.now.guard;
  const double fault = static_cast<double>(cycle.now.fault);
  record.note(CampaignLaw::guard, is_active(state) ? fault : std::max(1.0, fault), 0.0,
              1e-9 * static_cast<double>(cycle.now.time_ns));
}

void EnergyLaw::update(const CyclePair& cycle, dvec2 true_travel, const LawLimits& limits, LawRecord& record) noexcept {
  const dvec2 previous = cycle.before.commanded, command = cycle.now.commanded, delivered = -cycle.now.f_a;
  // An overheated motor delivers less than commanded.
  const bool is_delivered = glm::length(delivered - previous) < kMaxCommandError;
  if (!limits.energy_bounded || !is_active(cycle.now.guard) || !is_delivered) return reset();
  const dvec2 slope = limits.damping / limits.period;  // [N/m] damping / period
  const dvec2 dissipated = limits.min_damping / limits.max_period * true_travel * true_travel;
  const dvec2 net = delivered * true_travel + (command * command - previous * previous) / (2.0 * slope) - dissipated;
  const dvec2 measured_travel = cycle.now.lever - cycle.before.lever;
  const dvec2 mistaken = glm::abs(command - previous) + slope * (glm::abs(true_travel - last_travel_) +
                                                                 glm::abs(true_travel) + glm::abs(measured_travel));
  if (surplus_ == 0.0) {
    start_force_ = glm::abs(previous);
    allowed_ = limits.count * (start_force_.x + start_force_.y);
  }
  const double sum = surplus_ + net.x + net.y;
  surplus_ = sum < 0.0 ? 0.0 : sum;  // a NaN stays NaN
  allowed_ += 0.5 * limits.count * (mistaken.x + mistaken.y);
  last_travel_ = true_travel;
  const dvec2 risen = glm::max(glm::abs(command) - start_force_, 0.0);
  const double at_end = 0.5 * limits.count * (risen.x + risen.y);
  record.note(CampaignLaw::energy, surplus_, allowed_ + at_end + kRounding,
              1e-9 * static_cast<double>(cycle.now.time_ns));
}

void EnergyLaw::reset() noexcept {
  surplus_ = allowed_ = 0.0;
  last_travel_ = dvec2(0.0);
}

void GearLaw::update(const CyclePair& cycle, const haptics::Gate& gate, bool held_still, LawRecord& record) noexcept {
  const double time = 1e-9 * static_cast<double>(cycle.now.time_ns);
  const int gear = cycle.now.gear, before = cycle.before.gear;
  changes_ = held_still ? changes_ + (gear != before) : 0;
  if (held_still) record.note(CampaignLaw::gear_holds, bad(changes_ > 1), 0.0, time);
  if (last_ != haptics::kNeutralGear) {
    const haptics::Slot& slot = haptics::slot_of(gate, haptics::slot_of_gear(gate, last_));
    const bool is_in = haptics::slot_at(gate, cycle.now.proxy) == haptics::slot_of_gear(gate, last_);
    nearest_ = std::min(nearest_, is_in ? std::abs(cycle.now.proxy.y) : 0.0);
    if (gear == last_ && before != gear)
      record.note(CampaignLaw::gear_holds, bad(nearest_ > slot.release_depth), 0.0, time);
  }
  if (gear != haptics::kNeutralGear && gear != before) {
    last_ = gear;
    nearest_ = std::abs(cycle.now.proxy.y);
  }
}

void HeldSwing::update(dvec2 lever) noexcept {
  low_ = glm::min(low_, lever);
  high_ = glm::max(high_, lever);
  rise_ = glm::max(rise_, lever - low_);
  fall_ = glm::max(fall_, high_ - lever);
}

double HeldSwing::span() const noexcept {
  const dvec2 both = glm::min(rise_, fall_);
  return std::max(both.x, both.y);
}

void quiet_law(double span, const LawLimits& limits, double time, LawRecord& record) noexcept {
  record.note(CampaignLaw::quiet, span, limits.ripple, time);
}

void fades_law(double before, double after, const LawLimits& limits, double time, LawRecord& record) noexcept {
  record.note(CampaignLaw::fades, after, std::max(limits.small_swing, limits.remaining_swing * before), time);
}

}  // namespace gearshift::lab
