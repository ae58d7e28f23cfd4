#include "app/lab/tour/held_tour.h"

#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "app/base/program_name.h"
#include "app/base/stop_signals.h"
#include "app/runtime/runtime.h"
#include "haptics/files/file_error.h"
#include "haptics/gate/lockout.h"
#include "haptics/loop/haptic_event.h"
#include "haptics/loop/shift_script.h"

namespace gearshift::lab {
namespace {

constexpr double kPollPeriod = 0.02;               // [s]
constexpr double kOpenTimeout = 2.0;               // [s] maximum time to open a stick that is plugged in
constexpr std::int64_t kArmTimeout = 100'000'000;  // [ns] maximum time for the loop to process the arm command

runtime::RuntimeConfig runtime_config(const TourSetup& setup, runtime::StickLever& stick) {
  runtime::RuntimeConfig config;
  config.layout = setup.layout;
  config.preset.haptics = setup.haptics;
  config.lever = [&stick](double period) { return stick.lever(period); };
  config.program = base::program_name();
  return config;
}

bool is_off(haptics::GuardState state) {
  return state == haptics::GuardState::idle || state == haptics::GuardState::damped ||
         state == haptics::GuardState::released;
}

// Describes the fault to the user who holds the stick.
const char* describe_fault(haptics::GuardFault fault) {
  switch (fault) {
    case haptics::GuardFault::stale_reading:
      return "the stick sends no readings";
    case haptics::GuardFault::overruns:
      return "the computer was too slow";
    case haptics::GuardFault::stopped:
      return "the motors were switched off";
    default:
      return haptics::to_string(fault);
  }
}

// Start time [ns] of the running loop's first cycle.
std::int64_t first_cycle_of(runtime::Runtime& runtime) {
  const haptics::HapticSnapshot now = runtime.snapshot();
  const std::int64_t period = haptics::period_ns(runtime.config().preset.haptics);
  return now.time_ns - static_cast<std::int64_t>(now.cycle) * period;
}

// A tour that the user drives with a stick. Call poll() until the tour is over.
class HeldDrive {
 public:
  HeldDrive(runtime::Runtime& runtime, runtime::StickLever& stick, base::LineReader& answers, const TourOutput& output,
            TourResult& result)
      : runtime_(runtime),
        stick_(stick),
        answers_(answers),
        output_(output),
        result_(result),
        begin_ns_(first_cycle_of(runtime)) {}

  void begin() {
    std::string order;
    for (const int gear : result_.wanted)
      order += fmt::format("{}{}", order.empty() ? "" : ", ", haptics::gear_label(runtime_.gate(), gear));
    output_(fmt::format("The tour visits these gears: {}.", order));
  }

  void poll() {
    read_answer();
    follow_stick();
    // Read the snapshot before the events, because they may reset is_armed_.
    const haptics::HapticSnapshot now = runtime_.snapshot();
    follow_lever();
    watch_arming(now);
    if (const std::optional<std::string> problem = runtime_.poll_recording_problem()) {
      (void)runtime_.stop_recording();
      throw std::runtime_error(*problem);
    }
  }

  // True if the forces are off and standard input is closed, so that the user cannot turn the forces on.
  bool cannot_continue() const { return answers_.at_end() && is_off(runtime_.snapshot().guard) && !is_armed_; }

 private:
  void ask_to_arm() {
    if (!is_connected_ || is_awaiting_enter_) return;
    while (answers_.read_line(0.0)) continue;  // discard input that was typed before the prompt
    is_awaiting_enter_ = true;
    output_("The forces are off. Hold the stick, then press Enter to turn them on.");
  }
  void ask_for_gear() {
    if (next_ < result_.wanted.size())
      output_(fmt::format("Shift into {}.", haptics::gear_label(runtime_.gate(), result_.wanted[next_])));
  }

  void read_answer() {
    const std::optional<std::string> answer = answers_.read_line(kPollPeriod);
    if (!answer) return;
    if (!stick_.connected()) return ask_to_plug_in();
    if (!std::exchange(is_awaiting_enter_, false)) return;
    runtime_.arm();
    is_armed_ = true;
    armed_at_ns_ = runtime_.snapshot().time_ns;
    ask_for_gear();
  }

  // If the stick is unplugged, its forces go off. They stay off after it is plugged in again, until the user arms them.
  void follow_stick() {
    while (const std::optional<std::string> message = stick_.take_message()) {
      output_(*message);
      has_reported_absence_ = true;  // the message already gives the reason
    }
    const bool was_connected = std::exchange(is_connected_, stick_.connected());
    if (was_connected && !is_connected_) {
      runtime_.stop();
      is_awaiting_enter_ = false;
    }
    if (!was_connected && is_connected_) ask_to_arm();
    if (!is_connected_ && !has_reported_absence_ && runtime_.time() > kOpenTimeout) ask_to_plug_in();
    has_reported_absence_ = has_reported_absence_ || is_connected_ || runtime_.time() > kOpenTimeout;
  }

  void ask_to_plug_in() { output_(fmt::format("{} is not connected. Plug it in.", stick_.name())); }

  void follow_lever() {
    const runtime::RuntimeFrame frame = runtime_.read_frame();
    for (const vehicle::DriveSample& cycle : frame.cycles) {
      if (cycle.lever.time_ns < begin_ns_) continue;
      measure(cycle.lever, result_);
      result_.duration = seconds_at(cycle.lever.time_ns);
    }
    for (const haptics::HapticEvent& event : frame.events)
      if (event.time_ns >= begin_ns_) handle_event(event);
  }

  // Time [s] since the first recorded cycle, as in tour.csv.
  double seconds_at(std::int64_t time_ns) const { return 1e-9 * static_cast<double>(time_ns - begin_ns_); }

  void handle_event(const haptics::HapticEvent& event) {
    if (event.kind == haptics::EventKind::over_push_begin) output_(haptics::describe(event, true));
    if (event.kind == haptics::EventKind::gear_engaged) on_gear_engaged(event);
    if (event.kind == haptics::EventKind::guard_changed)
      on_guard_changed(static_cast<haptics::GuardState>(static_cast<int>(event.value)));
  }

  void on_gear_engaged(const haptics::HapticEvent& event) {
    const int gear = static_cast<int>(event.value);
    result_.engaged.push_back({gear, seconds_at(event.time_ns)});
    output_(fmt::format("{} engaged", haptics::gear_label(runtime_.gate(), gear)));
    if (next_ == result_.wanted.size() || gear != result_.wanted[next_]) return;
    ++next_;
    if (is_armed_) ask_for_gear();
  }

  void on_guard_changed(haptics::GuardState state) {
    if (!is_off(state) || !std::exchange(is_armed_, false)) return;
    output_(fmt::format("forces off: {}", describe_fault(runtime_.snapshot().fault)));
    ask_to_arm();
  }

  // Detects that arming was rejected, for which there is no event. Arming is rejected while the stop button is held or
  // the lever is too far outside the gate.
  void watch_arming(const haptics::HapticSnapshot& now) {
    if (!is_armed_ || !is_off(now.guard) || now.time_ns < armed_at_ns_ + kArmTimeout) return;
    is_armed_ = false;
    const bool is_held = now.fault == haptics::GuardFault::stopped;
    output_(fmt::format("the forces stay off: {}",
                        is_held ? "the stick's stop button is held" : describe_fault(now.fault)));
    ask_to_arm();
  }

  runtime::Runtime& runtime_;
  runtime::StickLever& stick_;
  base::LineReader& answers_;
  const TourOutput& output_;
  TourResult& result_;
  std::int64_t begin_ns_;
  std::size_t next_ = 0;   // index of the next wanted gear
  bool is_armed_ = false;  // the user has armed the forces, and they have not been switched off since
  std::int64_t armed_at_ns_ = 0;
  bool is_connected_ = false;
  bool has_reported_absence_ = false;  // also true once the stick has been connected
  bool is_awaiting_enter_ = false;
};

void drive(runtime::Runtime& runtime, runtime::StickLever& stick, double seconds, base::LineReader& answers,
           const TourOutput& output, TourResult& result) {
  if (haptics::has_brake_lockout(runtime.gate())) {  // there are no pedals
    haptics::DriverControls controls;
    controls.pedals.brake = 1.0;
    runtime.set_controls(controls);
  }
  HeldDrive held(runtime, stick, answers, output, result);
  held.begin();
  while (!result.visited_in_order() && runtime.time() < seconds && !base::StopSignals::requested()) {
    held.poll();
    if (held.cannot_continue())
      throw std::runtime_error("the forces cannot be turned on, because standard input is closed");
  }
  runtime.disarm();
}

}  // namespace

TourResult drive_held_tour(TourSetup& setup, runtime::StickLever& stick, double seconds, base::LineReader& answers,
                           const TourOutput& output, const TourProgress& progress) {
  runtime::Runtime runtime(runtime_config(setup, stick));
  setup.gate = runtime.gate();
  TourResult result;
  result.wanted = haptics::tour_order(setup.gate);
  result.limits = runtime.admitted().limits;
  result.admitted = result.softest = runtime.admitted().tuning.wall_stiffness;
  const std::filesystem::path trace = setup.folder / "tour.trace";
  runtime.start_recording(trace);
  drive(runtime, stick, seconds, answers, output, result);
  if (const std::optional<std::string> problem = runtime.stop_recording())
    throw haptics::FileError(trace.string(), 0, *problem);
  result.hash = write_tour_table(setup.folder, progress);
  return result;
}

}  // namespace gearshift::lab
