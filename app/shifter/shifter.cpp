#include "app/shifter/shifter.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "app/base/program_name.h"
#include "app/base/stop_signals.h"
#include "app/runtime/runtime.h"
#include "app/shifter/telemetry.h"
#include "app/shifter/telemetry_load.h"
#include "app/shifter/virtual_joystick.h"
#include "haptics/device/scripted_hand.h"
#include "haptics/gate/gate_compiler.h"
#include "haptics/joystick/kinematics.h"
#include "haptics/loop/shift_script.h"
#include "haptics/rt/monotonic_clock.h"

namespace gearshift::shifter {
namespace {

constexpr double kPollPeriod = 0.002;  // [s]

double now_s() {
  return 1e-9 * static_cast<double>(haptics::monotonic_ns());
}

// Order of a gear among the buttons.
int rank_of(int gear) {
  if (gear == haptics::kReverseGear) return haptics::kMaxGateGear + 1;
  return gear <= haptics::kMaxGateGear ? gear : haptics::kMaxGateGear + 2;
}

// The simulated hand's tour as a driver of the runtime, which starts with the first cycle.
class TouringDriver {
 public:
  // `brake`: pedal [1]; must outlive this object.
  TouringDriver(const haptics::Gate& gate, const haptics::HapticConfig& config, const std::atomic<double>& brake)
      : hand_(haptics::touring_hand(haptics::rest_position(gate, haptics::kNeutralGear)),
              haptics::shift_strokes(gate, haptics::rest_position(gate, haptics::kNeutralGear),
                                     haptics::tour_order(gate)),
              haptics::period_s(config)),
        brake_(brake) {}

  vehicle::DriverAction operator()(const vehicle::DriveSample& sample) {
    if (!start_) start_ = sample.time();
    vehicle::DriverAction action;
    action.hand = hand_.next(sample.time() - *start_, sample.lever.lever);
    action.controls.pedals.brake = brake_.load(std::memory_order_relaxed);
    return action;
  }
  double duration() const { return hand_.duration(); }

 private:
  haptics::ScriptedHand hand_;
  const std::atomic<double>& brake_;
  std::optional<double> start_;  // [s]
};

// Presses the button of the slot that the lever is in.
class GearButtons {
 public:
  GearButtons(const haptics::Gate& gate, VirtualJoystick& joystick, const ShifterOutput& output)
      : gate_(gate), slots_(button_slots(gate)), joystick_(joystick), output_(output) {}

  void print_table() const {
    for (std::size_t i = 0; i < slots_.size(); ++i) output_(fmt::format("button {}: {}", i + 1, label(slots_[i])));
  }

  void follow(const haptics::HapticSnapshot& now) {
    const int slot = haptics::is_sequential(gate_) ? stroke_of(now) : haptics::slot_of_gear(gate_, gear_of(now));
    if (slot == pressed_) return;
    set(pressed_, false);
    set(slot, true);
    pressed_ = slot;
    joystick_.publish();
    output_(slot == haptics::kNoSlot
                ? fmt::format("{:.3f} s: no button", time_of(now))
                : fmt::format("{:.3f} s: {}, button {}", time_of(now), label(slot), index_of(slot) + 1));
  }

 private:
  static int gear_of(const haptics::HapticSnapshot& now) {
    return now.gear == haptics::kNeutralGear ? haptics::kAnyGear : now.gear;
  }

  // In a sequential gate a button is held while the lever is at the end of its stroke.
  int stroke_of(const haptics::HapticSnapshot& now) const {
    if (now.slot == haptics::kNoSlot) return haptics::kNoSlot;
    const haptics::Slot& slot = haptics::slot_of(gate_, now.slot);
    const double limit = now.slot == pressed_ ? slot.release_depth : slot.engage_depth;
    return haptics::depth_in(gate_, now.slot, now.proxy) >= limit ? now.slot : haptics::kNoSlot;
  }

  double time_of(const haptics::HapticSnapshot& now) {  // [s] since the first cycle that was followed
    if (!start_ns_) start_ns_ = now.time_ns;
    return 1e-9 * static_cast<double>(now.time_ns - *start_ns_);
  }
  const char* label(int slot) const { return haptics::gear_label(gate_, haptics::slot_of(gate_, slot).gear); }
  int index_of(int slot) const {
    return static_cast<int>(std::find(slots_.begin(), slots_.end(), slot) - slots_.begin());
  }
  void set(int slot, bool is_down) {
    if (slot != haptics::kNoSlot) joystick_.set_button(index_of(slot), is_down);
  }

  const haptics::Gate& gate_;
  std::vector<int> slots_;
  VirtualJoystick& joystick_;
  const ShifterOutput& output_;
  int pressed_ = haptics::kNoSlot;
  std::optional<std::int64_t> start_ns_;
};

// The user's side of a real stick: Enter switches its forces on, and off again.
class HeldForces {
 public:
  HeldForces(runtime::Runtime& runtime, runtime::StickLever& stick, base::LineReader& answers,
             const ShifterOutput& output)
      : runtime_(runtime), stick_(stick), answers_(answers), output_(output) {}

  void poll() {
    const bool is_enter = answers_.read_line(kPollPeriod).has_value();
    while (const std::optional<std::string> message = stick_.take_message()) output_(*message);
    const bool was_connected = std::exchange(is_connected_, stick_.connected());
    if (was_connected && !is_connected_) runtime_.follow(runtime::ForceCause::stick_lost);
    if (is_enter && is_connected_) wants_ ? runtime_.disarm() : runtime_.arm();
    if (is_enter && !is_connected_) output_(fmt::format("{} is not connected. Plug it in.", stick_.name()));
    const bool wanted = std::exchange(wants_, runtime_.wants_forces());
    if (wanted && !wants_ && !is_enter)
      output_(fmt::format("forces off: {}", haptics::to_string(runtime_.snapshot().fault)));
    if ((wanted && !wants_) || (!was_connected && is_connected_))
      output_("The forces are off. Hold the stick, then press Enter to turn them on.");
  }

 private:
  runtime::Runtime& runtime_;
  runtime::StickLever& stick_;
  base::LineReader& answers_;
  const ShifterOutput& output_;
  bool is_connected_ = false, wants_ = false;
};

runtime::RuntimeConfig runtime_config(const ShifterConfig& config, haptics::LatestValue<Telemetry>& telemetry) {
  runtime::RuntimeConfig made;
  made.layout = config.layout;
  made.preset = config.preset;
  made.program = base::program_name();
  made.watch = std::make_shared<runtime::ControlsWatch>();
  made.load = [&telemetry, car = config.car](const haptics::Gate& gate, const haptics::DeviceSpec& device) {
    return std::make_unique<TelemetryLoad>(car, gate, device.max_force.y, telemetry);
  };
  if (config.stick) made.lever = [&stick = *config.stick](double period) { return stick.lever(period); };
  return made;
}

}  // namespace

std::vector<int> button_slots(const haptics::Gate& gate) {
  std::vector<int> order;
  for (int i = 0; i < gate.slot_count; ++i)
    if (haptics::slot_of(gate, i).gear != haptics::kNeutralGear) order.push_back(i);
  if (haptics::is_sequential(gate))
    return {haptics::slot_of_gear(gate, haptics::kNextGear), haptics::slot_of_gear(gate, haptics::kPreviousGear)};
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) {
    return rank_of(haptics::slot_of(gate, a).gear) < rank_of(haptics::slot_of(gate, b).gear);
  });
  return order;
}

void run_shifter(const ShifterConfig& config, base::LineReader& answers, const ShifterOutput& output) {
  std::optional<TelemetryPort> port;
  if (!config.telemetry.empty()) port.emplace(config.telemetry);
  std::optional<PassedAxes> pedals;
  if (!config.pedals.empty()) pedals.emplace(config.pedals);
  haptics::LatestValue<Telemetry> newest;
  runtime::RuntimeConfig wanted = runtime_config(config, newest);
  double duration = HUGE_VAL;      // [s]
  std::atomic<double> brake{1.0};  // [1] pedal; what nothing is known about locks nothing
  if (!config.stick) {
    const haptics::YokeGeometry& yoke = config.preset.lever.yoke;
    TouringDriver driver(haptics::compile_gate(config.layout, haptics::workspace_half_extent(yoke), yoke.radius),
                         config.preset.haptics, brake);
    duration = driver.duration() + 0.5;
    wanted.driver = std::move(driver);
  }
  runtime::Runtime runtime(wanted);
  const int buttons = static_cast<int>(button_slots(runtime.gate()).size());
  VirtualJoystick joystick(buttons, pedals ? pedals->axes() : std::vector<JoystickAxis>{});
  GearButtons gears(runtime.gate(), joystick, output);
  gears.print_table();
  std::optional<HeldForces> held;
  if (config.stick) held.emplace(runtime, *config.stick, answers, output);
  runtime.follow(runtime::ForceCause::start);
  TelemetryFilter filter;
  while (!base::StopSignals::requested() && runtime.time() < duration) {
    held ? held->poll() : static_cast<void>(answers.read_line(kPollPeriod));
    wanted.watch->note_read(haptics::monotonic_ns());
    if (port) port->read_into(filter, now_s());
    const Telemetry now = filter.at(now_s());
    newest.write(now);
    brake.store(now.is_live ? now.car.brake : 1.0, std::memory_order_relaxed);
    haptics::DriverControls controls;
    controls.pedals.brake = brake.load(std::memory_order_relaxed);
    runtime.set_controls(controls);
    while (const std::optional<std::string> message = filter.take_message()) output(*message);
    for (const vehicle::DriveSample& cycle : runtime.read_frame().cycles) gears.follow(cycle.lever);
    if (pedals && !pedals->pass_to(joystick)) {
      output(fmt::format("{} is gone; its axes stay where they are", config.pedals));
      pedals.reset();
    }
    joystick.publish();
  }
}

}  // namespace gearshift::shifter
