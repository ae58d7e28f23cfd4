#include "haptics/loop/haptic_loop.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>

#include <glm/geometric.hpp>

#include "haptics/gate/gate_feel.h"

namespace gearshift {
namespace {

using glm::dvec2;

constexpr double kRearmAfter = 0.050;    // [s] of healthy readings before a simulated lever arms itself again
constexpr double kContactApart = 0.030;  // [s] off the wall before a touch counts as a new impact
constexpr double kSaturationHold = 0.050;  // [s] below the limit before saturation is over
constexpr std::int64_t kMostSkipped = 10;  // cycles that the world catches up after an overrun

std::int64_t clock_ns() noexcept {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(
             std::chrono::steady_clock::now().time_since_epoch())
      .count();
}

bool is_finite(dvec2 v) noexcept {
  return std::isfinite(v.x) && std::isfinite(v.y);
}

// Stamps the stages of every 64th cycle.
class StageClock {
 public:
  StageClock(StageStamps& stamps, std::uint64_t cycle) noexcept
      : stamps_(stamps), on_(cycle % StageStamps::kEvery == 0) {
    if (on_) stamps_.cycle = cycle;
    stamp();
  }
  void stamp() noexcept {
    if (on_) stamps_.ns[stage_++] = clock_ns();
  }

 private:
  StageStamps& stamps_;
  std::size_t stage_ = 0;
  bool on_;
};

}  // namespace

const char* event_name(EventKind kind) noexcept {
  static constexpr const char* kNames[] = {"gear engaged",    "gear left",     "wall contact",
                                           "over-push begin", "over-push end", "saturation begin",
                                           "saturation end",  "guard changed"};
  return kNames[static_cast<int>(kind)];
}

HapticLoop::HapticLoop(const HapticConfig& config, const Gate& gate, HapticDevice& device, LeverWorld& world,
                       LoopChannels& channels)
    : config_(config),
      admitted_(
          admit_tuning(config.tuning, 1e-9 * static_cast<double>(period_ns(config)), device.spec(), gate)),
      gate_(gate),
      device_(device),
      world_(world),
      channels_(channels),
      period_(1e-9 * static_cast<double>(period_ns(config))),
      horizon_(period_ * (1.0 + 2.0 * device.spec().delay)),
      hand_over_(kHandOverSpeed * period_),
      tuning_(admitted_.tuning),
      estimator_(config.estimator, period_),
      selector_(config.gear_debounce),
      guard_(config.guard, device.spec(), period_),
      passage_(open_passage(gate)) {}

void HapticLoop::cycle(std::int64_t deadline_ns, std::int64_t skipped) noexcept {
  StageClock clock(stamps_, out_.cycle);
  out_.time_ns = deadline_ns;
  take_inputs();
  reading_ = device_.read(deadline_ns);
  clock.stamp();
  motion_ = estimator_.update(reading_);
  clock.stamp();
  follow_lever();
  clock.stamp();
  const Coupling coupling{tuning_.wall_stiffness, tuning_.wall_damping, horizon_};
  out_.wall_force = couple(coupling, gate_, passage_, proxy_, motion_, hand_over_);
  clock.stamp();
  out_.feel_force = mechanism_feel();
  clock.stamp();
  world_out_ = run_world(skipped);
  clock.stamp();
  const GuardOutput command = guard_.guard(guard_input(skipped));
  clock.stamp();
  device_.write(command.force);
  clock.stamp();

  account_force_flow(command);
  watch_gear();
  watch_push();
  watch_saturation(command);
  watch_contact();
  watch_guard();
  publish(skipped);
}

void HapticLoop::take_inputs() noexcept {
  if (channels_.tuning.update()) tuning_ = channels_.tuning.value();
  if (channels_.controls.update()) controls_ = channels_.controls.value();
  command_ = LoopCommand::none;
  if (channels_.commands.pop(command_)) obey(command_);
}

void HapticLoop::obey(LoopCommand command) noexcept {
  switch (command) {
    case LoopCommand::none:
      return;
    case LoopCommand::arm:
      arm();
      return;
    case LoopCommand::disarm:
      guard_.disarm();
      break;
    case LoopCommand::stop:
      guard_.stop();
      break;
  }
  device_.release();
}

// At arming the proxy starts anew at the lever, so that an old penetration cannot pull.
void HapticLoop::arm() noexcept {
  guard_.arm();
  placed_ = false;
}

void HapticLoop::follow_lever() noexcept {
  if (!placed_ && motion_.fresh) {
    proxy_ = place_proxy(gate_, motion_.position);
    placed_ = true;
  }
  const LockoutInputs in{reading_.pressed_down, reading_.lifted, world_out_.road_speed, selector_.gear()};
  passage_ = lockouts_.update(gate_, in, proxy_.position);
  limit_depth();
  proxy_ = move_proxy(gate_, passage_, proxy_, motion_.position, hand_over_);
}

// The gearbox limits the depth in the slot where the lever is. A limit never moves the lever.
void HapticLoop::limit_depth() noexcept {
  const int slot = slot_at(gate_, proxy_.position);
  if (slot == kNoSlot || slot != world_out_.limited_slot) return;
  const double depth = std::abs(proxy_.position.y);
  passage_.limited_slot = slot;
  passage_.depth_min = std::min(world_out_.depth_min, depth);
  passage_.depth_max = std::max(world_out_.depth_max, depth);
}

dvec2 HapticLoop::mechanism_feel() const noexcept {
  const double speed = glm::length(motion_.smooth_velocity);
  const double excess = std::max(0.0, speed - tuning_.speed_limit);
  const double damping =
      tuning_.aisle_damping + (excess > 0.0 ? tuning_.limit_damping * excess / speed : 0.0);
  return tuning_.feel_scale * gate_feel(gate_, proxy_.position) - damping * motion_.smooth_velocity;
}

LeverOutput HapticLoop::run_world(std::int64_t skipped) noexcept {
  LeverInput in;
  in.position = motion_.position;
  in.velocity = motion_.smooth_velocity;
  in.proxy = proxy_.position;
  in.push = out_.f_h;
  in.slot = slot_at(gate_, proxy_.position);
  in.depth = in.slot == kNoSlot ? 0.0 : std::abs(proxy_.position.y);
  in.gear = selector_.gear();
  in.controls = controls_;
  out_.slot = in.slot;
  const double periods = static_cast<double>(1 + std::min(skipped, kMostSkipped));
  const double elapsed = first_step_ ? 0.0 : period_ * periods;
  first_step_ = false;
  return world_.step(in, elapsed);
}

GuardInput HapticLoop::guard_input(std::int64_t skipped) const noexcept {
  GuardInput in;
  in.force = out_.wall_force + out_.feel_force + world_out_.force;
  in.position = motion_.position;
  in.velocity = motion_.smooth_velocity;
  in.fresh = motion_.fresh;
  in.overrun = skipped > 0;
  return in;
}

// Eq (4): f_j = f_h - f_a. Without a force sensor the push is what holds the lever against the motors and its
// own spring and damping; its inertia is left out.
void HapticLoop::account_force_flow(const GuardOutput& command) noexcept {
  const DeviceSpec& spec = device_.spec();
  out_.f_a = -reading_.actuator_force;
  if (spec.measures_hand_force) {
    if (is_finite(reading_.hand_force)) out_.f_h = reading_.hand_force;
  } else {
    const dvec2 damping{spec.axis_x.damping, spec.axis_y.damping};
    const dvec2 stiffness{spec.axis_x.stiffness, spec.axis_y.stiffness};
    out_.f_h = out_.f_a + damping * motion_.smooth_velocity + stiffness * motion_.position;
  }
  out_.f_j = out_.f_h - out_.f_a;
  out_.lever = motion_.position;
  out_.velocity = motion_.smooth_velocity;
  out_.proxy = proxy_.position;
  out_.world_force = world_out_.force;
  out_.road_speed = world_out_.road_speed;
  out_.commanded = command.force;
  set_flag(kFlagPushEstimated, !spec.measures_hand_force);
  set_flag(kFlagFresh, motion_.fresh);
}

void HapticLoop::watch_gear() noexcept {
  const int before = selector_.gear();
  const int now = selector_.update(gate_, proxy_.position, period_);
  out_.gear = now;
  if (now == before) return;
  if (before != kNeutralGear) tell(EventKind::gear_left, before);
  if (now != kNeutralGear) tell(EventKind::gear_engaged, now);
}

void HapticLoop::watch_push() noexcept {
  const double push = glm::length(out_.f_h);
  const bool was_over = has_flag(kFlagOverPush);
  const bool is_over = push > (was_over ? config_.over_push.clear_below : config_.over_push.warn_above);
  set_flag(kFlagOverPush, is_over);
  if (is_over != was_over) tell(is_over ? EventKind::over_push_begin : EventKind::over_push_end, push);
}

void HapticLoop::watch_saturation(const GuardOutput& command) noexcept {
  unsaturated_ = command.saturated ? 0.0 : unsaturated_ + period_;
  const bool was = has_flag(kFlagSaturated);
  const bool is = unsaturated_ < kSaturationHold;
  set_flag(kFlagSaturated, is);
  if (is == was) return;
  tell(is ? EventKind::saturation_begin : EventKind::saturation_end,
       glm::length(out_.wall_force + out_.feel_force + out_.world_force));
}

void HapticLoop::watch_contact() noexcept {
  const dvec2 penetration = motion_.position - proxy_.position;
  const double depth = glm::length(penetration);
  const bool touches = depth > 0.0;
  set_flag(kFlagContact, touches);
  set_flag(kFlagGhost, depth > config_.ghost_offset);
  if (touches && apart_ > kContactApart) {
    tell(EventKind::wall_contact, std::abs(glm::dot(motion_.smooth_velocity, penetration / depth)));
  }
  apart_ = touches ? 0.0 : apart_ + period_;
}

// A simulated lever arms itself again once it has been healthy for a while since the fall; a real one waits
// for a person.
void HapticLoop::watch_guard() noexcept {
  const bool has_fallen = guard_.state() != out_.guard;
  healthy_ = motion_.fresh && !has_fallen ? healthy_ + period_ : 0.0;
  if (guard_.state() == GuardState::released && has_fallen) device_.release();
  if (guard_.state() == GuardState::damped && device_.spec().simulated && healthy_ > kRearmAfter) arm();
  if (guard_.state() != out_.guard) tell(EventKind::guard_changed, static_cast<double>(guard_.state()));
  out_.guard = guard_.state();
  out_.fault = guard_.fault();
}

void HapticLoop::publish(std::int64_t skipped) noexcept {
  channels_.snapshot.write(out_);
  if (channels_.recording.load(std::memory_order_relaxed)) record(skipped);
  ++out_.cycle;
}

void HapticLoop::record(std::int64_t skipped) noexcept {
  const TraceSample sample{
      out_.time_ns, static_cast<std::uint64_t>(skipped), reading_, controls_, tuning_, command_, out_};
  if (!channels_.trace.push(sample)) channels_.trace_lost.fetch_add(1, std::memory_order_relaxed);
}

void HapticLoop::tell(EventKind kind, double value) noexcept {
  if (!channels_.events.push({kind, out_.cycle, out_.time_ns, value})) {
    channels_.events_lost.fetch_add(1, std::memory_order_relaxed);
  }
}

void HapticLoop::set_flag(SnapshotFlag flag, bool on) noexcept {
  out_.flags = on ? out_.flags | flag : out_.flags & ~static_cast<std::uint32_t>(flag);
}

}  // namespace gearshift
