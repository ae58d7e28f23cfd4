#include "haptics/loop/haptic_loop.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <utility>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "haptics/contact/free_span.h"
#include "haptics/files/range_check.h"
#include "haptics/gate/gate_feel.h"
#include "haptics/joystick/finite.h"
#include "haptics/rt/monotonic_clock.h"

namespace gearshift::haptics {
namespace {

using glm::dvec2;

constexpr double kRearmAfter = 0.050;      // [s] duration of fresh readings before a simulated lever re-arms itself
constexpr double kSaturationHold = 0.050;  // [s] saturation ends after this time with the force below the limit
constexpr double kShortfall = 1.0;  // [N] difference between commanded and delivered force that a hand would notice
constexpr std::int64_t kMaxCatchUpCycles = 10;  // the load catches up at most this many cycles after an overrun

const HapticConfig& validated(const HapticConfig& config, const DeviceSpec& spec) {
  check_config(config);
  check_device(spec);
  return config;
}

// Records the time stamps of every 64th cycle.
class StageClock {
 public:
  StageClock(StageStamps& stamps, std::uint64_t cycle) noexcept
      : stamps_(stamps), on_(cycle % StageStamps::kEvery == 0) {
    if (on_) stamps_.cycle = cycle;
    stamp();
  }
  void stamp() noexcept {
    if (on_) stamps_.ns[stage_++] = monotonic_ns();
  }

 private:
  StageStamps& stamps_;
  std::size_t stage_ = 0;
  bool on_;
};

// On a real device, damped means motors off: damping computed from late readings can inject energy.
GuardConfig guard_of(const HapticConfig& config, const DeviceSpec& spec) noexcept {
  GuardConfig guard = config.guard;
  if (!spec.simulated) guard.damped_damping = 0.0;
  return guard;
}

}  // namespace

const char* to_string(LoopCommand command) noexcept {
  static constexpr const char* kNames[] = {"none", "arm", "disarm", "stop"};
  return kNames[static_cast<int>(command)];
}

HapticLoop::HapticLoop(const HapticConfig& config, const Gate& gate, HapticDevice& device, LeverLoad& load,
                       LoopInputs& inputs)
    : config_(validated(config, device.spec())),
      admitted_(admit_tuning(config, device.spec(), max_feel_stiffness(gate))),
      gate_(gate),
      device_(device),
      spec_(device.spec()),
      load_(load),
      inputs_(inputs),
      period_(period_s(config)),
      hand_over_step_(kHandOverSpeed * period_),
      device_wall_stiffness_(usable_wall_stiffness(device.spec())),
      device_wall_damping_(usable_wall_damping(device.spec())),
      tuning_(admitted_.tuning),
      estimator_(config.estimator, period_, spec_.position_step, config.guard.stale_time),
      observer_(device.spec(), period_),
      limiter_(device.spec(), period_),
      selector_(config.gear_debounce, is_sequential(gate) ? load.start_gear() : kNeutralGear),
      guard_(guard_of(config, device.spec()), device.spec(), period_, config.contact.energy_control),
      stiffest_feel_(max_feel_stiffness(gate)),
      passage_(open_passage(gate)),
      proxy_(place_proxy(gate, rest_position(gate, kNeutralGear))) {}

AdmittedTuning HapticLoop::change_tuning(const HapticTuning& wanted) {
  check_tuning(wanted);
  HapticConfig config = config_;
  config.tuning = wanted;
  config.contact.hold = admitted_.hold;  // the contact hold method cannot change while the loop runs
  AdmittedTuning admitted = admit_tuning(config, spec_, stiffest_feel_);
  if (admitted.hold != admitted_.hold) {
    throw std::invalid_argument("this tuning needs a different hold; restart the loop to use it");
  }
  inputs_.tuning.write(admitted.tuning);
  return admitted;
}

void HapticLoop::cycle(std::int64_t deadline_ns, std::int64_t skipped) noexcept {
  StageClock clock(stamps_, cycle_);
  take_inputs();
  read_device(deadline_ns);
  clock.stamp();
  motion_ = estimator_.update(reading_);
  clock.stamp();
  follow_lever();
  clock.stamp();
  const ContactForce contact = couple_lever(skipped);
  wall_force_ = contact.force;
  clock.stamp();
  feel_force_ = mechanism_feel(contact.mean_proxy);
  clock.stamp();
  load_output_ = step_load(skipped);
  clock.stamp();
  const GuardOutput command = guard_.guard(guard_input(skipped));
  clock.stamp();
  drive(command);
  clock.stamp();

  account_force_flow(command);
  (void)selector_.update(gate_, proxy_.position, period_);
  watch_push();
  watch_saturation(command);
  watch_chatter();
  watch_guard(skipped);
  publish(deadline_ns, skipped);
}

void HapticLoop::take_inputs() noexcept {
  if (inputs_.tuning.update() && inputs_.tuning.value() != tuning_) retune(inputs_.tuning.value());
  (void)inputs_.controls.update();
  (void)inputs_.pedal_keys.update();
  controls_ = inputs_.controls.value();
  command_ = LoopCommand::none;
  if (inputs_.stop.load(std::memory_order_relaxed)) {
    inputs_.stop.store(false, std::memory_order_relaxed);
    while (inputs_.commands.pop(command_)) {
    }
    command_ = LoopCommand::stop;
    apply_command(command_);
  } else if (inputs_.commands.pop(command_)) {
    apply_command(command_);
  }
}

void HapticLoop::apply_command(LoopCommand command) noexcept {
  switch (command) {
    case LoopCommand::none:
      return;
    case LoopCommand::arm:
      arm();
      return;
    case LoopCommand::disarm:
      guard_.disarm();
      return;
    case LoopCommand::stop:
      guard_.stop();
      return;
  }
}

// The panic button takes effect even if the rest of the reading is implausible.
void HapticLoop::read_device(std::int64_t deadline_ns) noexcept {
  reading_ = device_.read(deadline_ns);
  if (reading_.stop) guard_.stop();
}

// A change of the wall's stiffness or damping resets the reversal limiter, whose state applies only to the old wall.
void HapticLoop::retune(const HapticTuning& tuning) noexcept {
  const bool same_wall = tuning.wall_stiffness == tuning_.wall_stiffness && tuning.wall_damping == tuning_.wall_damping;
  if (!same_wall) limiter_.reset();
  tuning_ = tuning;
}

// Arming places the proxy at the lever, so that an old penetration cannot pull. While forces are on, arming does not
// move the proxy; otherwise pressing the arm key could move the proxy through a wall.
void HapticLoop::arm() noexcept {
  if (reading_.stop) return guard_.reject_arming();
  if (!guard_.arm()) return;
  motors_released_ = false;
  proxy_placed_ = false;
  limiter_.reset();
}

void HapticLoop::follow_lever() noexcept {
  if (!proxy_placed_ && motion_.fresh) {
    proxy_ = place_proxy(gate_, motion_.position);
    proxy_placed_ = true;
  }
  const LockoutInputs in{reading_.pressed_down, reading_.lifted, load_output_.road_speed, selector_.gear(), brake_};
  passage_ = lockouts_.update(gate_, in, proxy_.position);
  limit_depth();
  proxy_ = move_proxy(gate_, passage_, proxy_, motion_.position, hand_over_step_);
}

// Applies the load's depth limit in the lever's current slot. A limit never moves the lever.
void HapticLoop::limit_depth() noexcept {
  const int slot = load_output_.limited_slot;
  if (slot == kNoSlot || slot != slot_at(gate_, proxy_.position)) return;
  const double depth = depth_in(gate_, slot, proxy_.position);
  passage_.limited_slot = slot;
  passage_.depth_min = std::min(load_output_.depth_min, depth);
  passage_.depth_max = std::max(load_output_.depth_max, depth);
}

ContactForce HapticLoop::couple_lever(std::int64_t skipped) noexcept {
  wall_stiffness_ = tuning_.wall_stiffness * limiter_.stiffness_fraction();
  const double stiffness = loop_stiffness(tuning_, spec_) * limiter_.stiffness_fraction();
  const double damping = tuning_.wall_damping - device_damping(tuning_, admitted_.hold, spec_);
  const Coupling coupling{stiffness, damping, period_, spec_.delay, admitted_.hold};
  if (admitted_.hold != ContactHold::observer) return contact_force(coupling, gate_, passage_, proxy_, motion_);
  ObservedMotion observed = observer_.update(motion_, commanded_, skipped);
  // The prediction leaves out all motor forces, so this adds the motion that the previous cycle's feel and load forces
  // cause. Without it, the predicted depth would be wrong by this motion, and the force would jump at the wall's edge.
  const dvec2 other_force = feel_force_ + load_output_.force;
  if (is_finite(other_force)) observed.end += observed.compliance * other_force;
  return contact_force(coupling, gate_, passage_, proxy_, observed);
}

dvec2 HapticLoop::mechanism_feel(dvec2 mean_proxy) const noexcept {
  const double speed = glm::length(motion_.smooth_velocity);
  const double excess = std::max(0.0, speed - tuning_.speed_limit);
  const double damping = tuning_.aisle_damping + (excess > 0.0 ? tuning_.limit_damping * excess / speed : 0.0);
  // The feel must not be stiffer than the wall.
  const double softened = std::min(tuning_.feel_scale * stiffest_feel_, wall_stiffness_);
  const double scale = stiffest_feel_ > 0.0 ? softened / stiffest_feel_ : tuning_.feel_scale;
  return scale * gate_feel(gate_, mean_proxy) - damping * motion_.smooth_velocity;
}

LeverOutput HapticLoop::step_load(std::int64_t skipped) noexcept {
  const double periods = static_cast<double>(1 + std::min(skipped, kMaxCatchUpCycles));
  const double elapsed = first_step_ ? 0.0 : period_ * periods;
  first_step_ = false;
  controls_.pedals = load_.move_pedals(controls_.pedals, inputs_.pedal_keys.value(), elapsed);
  brake_ = controls_.pedals.brake;

  LeverInput in;
  in.position = motion_.position;
  in.velocity = motion_.smooth_velocity;
  in.proxy = proxy_.position;
  in.push = push_;
  in.slot = slot_at(gate_, proxy_.position);
  in.depth = in.slot == kNoSlot ? 0.0 : depth_in(gate_, in.slot, proxy_.position);
  in.gear = selector_.gear();
  in.controls = controls_;
  slot_ = in.slot;
  return load_.step(in, elapsed);
}

GuardInput HapticLoop::guard_input(std::int64_t skipped) const noexcept {
  GuardInput in;
  in.force = wanted_force();
  in.beside = device_wall_force(walls_);
  in.position = motion_.position;
  in.velocity = motion_.smooth_velocity;
  in.fresh = motion_.fresh;
  in.in_contact = motion_.position != proxy_.position;
  in.skipped = skipped;
  return in;
}

void HapticLoop::drive(const GuardOutput& command) noexcept {
  if (command.ramp > 0.0) device_.switch_on();
  device_.write(command.force);
  if (device_wall_stiffness_ > 0.0 || device_wall_damping_ > 0.0) send_device_walls(command.ramp);
}

// Device walls take effect one delay later, so the union of the free space now and the free space at that time is sent.
// A wall that moves closer therefore reaches the device late; until then, only the loop's part resists.
void HapticLoop::send_device_walls(double ramp) noexcept {
  const double wall_fraction = device_wall_stiffness_ > 0.0
                                   ? std::min(1.0, tuning_.wall_stiffness / device_wall_stiffness_)
                                   : 0.0;  // [1] below 1 if the wanted wall is softer than the device wall
  const double stiffness_fraction = ramp * wall_fraction * limiter_.stiffness_fraction();
  const double device_part = device_damping(tuning_, admitted_.hold, spec_);
  const double damping = device_part > 0.0 ? ramp * device_part / device_wall_damping_ : 0.0;
  if (stiffness_fraction == 0.0 && damping == 0.0 && walls_.stiffness_fraction == 0.0 && walls_.damping_fraction == 0.0)
    return;
  const double ahead = period_ * (1.0 + spec_.delay);
  const Proxy then = move_proxy(gate_, passage_, proxy_, motion_.position + ahead * motion_.smooth_velocity, 0.0);
  const FreeSpan free =
      bounding_span(free_span(gate_, passage_, proxy_.position), free_span(gate_, passage_, then.position));
  const LeverWalls walls{free.low, free.high, stiffness_fraction, damping};
  if (walls == walls_) return;
  walls_ = walls;
  device_.set_device_walls(walls);
}

// Force that the device's springs want at the current lever position, also beyond what the motors can [N].
dvec2 HapticLoop::device_wall_force(const LeverWalls& walls) const noexcept {
  if (walls.stiffness_fraction == 0.0) return {0.0, 0.0};
  const dvec2 inside = glm::clamp(motion_.position, walls.low, walls.high);
  return walls.stiffness_fraction * spec_.device_wall_stiffness * (inside - motion_.position);
}

void HapticLoop::account_force_flow(const GuardOutput& command) noexcept {
  is_push_measured_ = spec_.measures_hand_force && is_finite(reading_.hand_force);
  if (is_finite(reading_.actuator_force)) actuator_force_ = -reading_.actuator_force;
  push_ = is_push_measured_ ? reading_.hand_force : estimated_push(command);
  commanded_ = command.force;
}

// Estimates the hand's push if there is no force sensor or its value is not finite. The estimate is the force that
// balances the motors and the handle's spring and damping; inertia is neglected. When the motors saturate, the force
// that the wall would need at this depth replaces the motors' force.
dvec2 HapticLoop::estimated_push(const GuardOutput& command) const noexcept {
  dvec2 damping{spec_.axis_x.damping, spec_.axis_y.damping};
  for (int i = 0; i < 2; ++i) {
    const bool in_wall = motion_.position[i] < walls_.low[i] || motion_.position[i] > walls_.high[i];
    if (in_wall) damping[i] += walls_.damping_fraction * spec_.device_wall_damping[i];
  }
  const dvec2 stiffness{spec_.axis_x.stiffness, spec_.axis_y.stiffness};
  const dvec2 hold_force = command.saturated ? -(wanted_force() + device_wall_force(walls_)) : actuator_force_;
  return hold_force + damping * motion_.smooth_velocity + stiffness * motion_.position;
}

void HapticLoop::watch_push() noexcept {
  is_over_push_ = glm::length(push_) > (is_over_push_ ? config_.over_push.clear_below : config_.over_push.warn_above);
}

double HapticLoop::penetration() const noexcept {
  return glm::length(motion_.position - proxy_.position);
}

// Saturation: the wanted force exceeds the device's limit, or the motors delivered less than was commanded for this
// cycle (overload).
void HapticLoop::watch_saturation(const GuardOutput& command) noexcept {
  const std::uint64_t age = 1 + static_cast<std::uint64_t>(spec_.delay);
  const Sent due = cycle_ >= age ? sent_[(cycle_ - age) % sent_.size()] : Sent{};
  const dvec2 expected = due.force + device_wall_force(due.walls);
  // [N] change of the wall force within a period
  const double moves =
      device_wall_stiffness_ > 0.0 ? device_wall_stiffness_ * period_ * glm::length(motion_.velocity) : 0.0;
  const bool falls_short = motion_.fresh && glm::length(expected + actuator_force_) > kShortfall + moves;
  sent_[cycle_ % sent_.size()] = {command.force, walls_};
  unsaturated_time_ = command.saturated || falls_short ? 0.0 : unsaturated_time_ + period_;
}

// Lowers the stiffness if the lever chatters on a wall. If a lower stiffness does not help, the guard enters the state
// `damped`.
void HapticLoop::watch_chatter() noexcept {
  if (!config_.contact.reversal_limiter) return;
  if (!limiter_.update(motion_.position, penetration() > 0.0, tuning_.wall_stiffness, tuning_.wall_damping,
                       load_output_.vibration))
    return;
  if (limiter_.is_exhausted()) guard_.damp();
}

// After a fault, a simulated lever re-arms itself once its readings have been fresh for a while. A real lever, or any
// lever that chattered, waits for the user to arm it. The motors are released once each time the guard reaches a state
// without force. They are also released if the loop starts in one, because an earlier loop may have left them on.
void HapticLoop::watch_guard(std::int64_t skipped) noexcept {
  const bool has_changed = guard_.state() != published_.out.guard;
  const bool is_new = has_changed || cycle_ == 0;
  const bool is_off = guard_.state() == GuardState::idle || guard_.state() == GuardState::released;
  const bool is_faded = guard_.state() == GuardState::damped && !spec_.simulated && commanded_ == dvec2{0.0, 0.0} &&
                        !std::exchange(motors_released_, true);
  if ((is_new && is_off) || is_faded) device_.release();
  const bool is_healthy = motion_.fresh && skipped == 0 && !has_changed;
  healthy_time_ = is_healthy ? healthy_time_ + period_ : 0.0;
  const bool may_rearm = guard_.state() == GuardState::damped && rearms_itself(spec_, guard_.fault());
  if (may_rearm && healthy_time_ > kRearmAfter) arm();
}

// Fills the sample in place. CycleRunner copies it into its record: 416 bytes, 15 ns per cycle.
void HapticLoop::publish(std::int64_t deadline_ns, std::int64_t skipped) noexcept {
  published_.deadline_ns = deadline_ns;
  published_.skipped = skipped;
  published_.reading = reading_;
  published_.controls = controls_;
  published_.tuning = tuning_;
  published_.command = command_;
  fill_snapshot(published_.out, deadline_ns);
  ++cycle_;
}

void HapticLoop::fill_snapshot(HapticSnapshot& out, std::int64_t deadline_ns) const noexcept {
  out.cycle = cycle_;
  out.time_ns = deadline_ns;
  out.lever = motion_.position;
  out.velocity = motion_.smooth_velocity;
  out.proxy = proxy_.position;
  out.wall_force = wall_force_;
  out.feel_force = feel_force_;
  out.load_force = load_output_.force;
  out.commanded = commanded_;
  out.f_h = push_;
  out.f_a = actuator_force_;
  out.f_j = push_ - actuator_force_;
  out.wall_stiffness = wall_stiffness_;
  out.road_speed = load_output_.road_speed;
  out.slot = slot_;
  out.gear = selector_.gear();
  out.guard = guard_.state();
  out.fault = guard_.fault();
  const double depth = penetration();
  const auto flag = [](std::uint32_t bit, bool on) { return on ? bit : 0u; };
  out.flags = flag(kFlagContact, depth > 0.0) | flag(kFlagSaturated, unsaturated_time_ < kSaturationHold) |
              flag(kFlagOverPush, is_over_push_) | flag(kFlagPushEstimated, !is_push_measured_) |
              flag(kFlagGhost, depth > config_.ghost_offset) | flag(kFlagFresh, motion_.fresh);
}

}  // namespace gearshift::haptics
