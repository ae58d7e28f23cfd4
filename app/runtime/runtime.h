// The running lever: device, hand, loop, thread and recorder, shared by window, demo and tests.
//
// Two clocks: a real-time thread for users, or a virtual clock advanced by advance() for films and tests. A different
// gate, preset or driver needs a new Runtime. The lever keeps running even if the frame side makes no calls for
// seconds. Two kinds of lever: a simulated one from the preset, with a hand controlled by set_hand() or a driver; or a
// real one held by the user, for which only the user may request arm().
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/runtime/controls_watch.h"
#include "app/runtime/cycle_runner.h"
#include "app/runtime/force_rules.h"
#include "app/vehicle/car_load.h"
#include "app/vehicle/drive_sample.h"
#include "haptics/device/hand.h"
#include "haptics/gate/gate.h"
#include "haptics/gate/gate_layout.h"
#include "haptics/loop/haptic_config.h"
#include "haptics/loop/haptic_event.h"
#include "haptics/loop/haptic_loop.h"
#include "haptics/loop/preset.h"

namespace gearshift::runtime {

enum class RuntimeClock { real_time, virtual_time };

// A scripted driver. It is called with the newest cycle and returns hand target and controls for the next cycle. The
// hand follows the target exactly, including its velocity. On the virtual clock the function is called once per cycle,
// within advance() and start_recording(). On the real clock a separate thread calls it in order, possibly some
// milliseconds late. The function may allocate memory but must not throw. If the function falls seconds behind, cycles
// are skipped.
using DriverFunction = std::function<vehicle::DriverAction(const vehicle::DriveSample&)>;

// Creates a real lever for a loop with this period [s], without moving the lever. Only one real lever may be in use at
// a time. Throws std::invalid_argument with a one-sentence message.
using LeverFactory = std::function<std::unique_ptr<haptics::HapticDevice>(double period)>;

// Creates the load on the lever in place of a car. It must not move pedals.
using LoadFactory =
    std::function<std::unique_ptr<haptics::LeverLoad>(const haptics::Gate&, const haptics::DeviceSpec&)>;

struct RuntimeConfig {
  haptics::GateLayout layout;
  std::optional<vehicle::CarSpec> car;  // the car that loads the lever; empty: no load
  LoadFactory load;                     // if set: used in place of `car`, which must be empty
  vehicle::CarStart start;              // the car's initial state; the lever starts in the car's gear
  haptics::Pedals pedals;               // initial positions of the pedal axes and the hand brake
  haptics::Preset preset;               // a hand too soft to move the lever is replaced, see leading_hand()
  LeverFactory lever;                 // if set: a real lever is used, set_hand() is ignored, and `driver` must be empty
  DriverFunction driver;              // empty: set_hand() and set_controls() are used
  haptics::Pedals keyboard;           // initial positions of the pedals that keys press
  haptics::PedalKeys pedal_keys;      // initial keys, until set_controls()
  vehicle::PedalTiming pedal_timing;  // of the car's pedals that keys press
  RuntimeClock clock = RuntimeClock::real_time;
  std::uint64_t seed = 1;                // random seed of the car
  std::shared_ptr<ControlsWatch> watch;  // on the real clock, ends the forces; null: none
  std::string program = "gearshift";     // program name and version, written to the trace
};

// Timing of the haptic thread.
struct LoopHealth {
  double rate = 0.0;  // [Hz] as configured
  // [s] Time from deadline to wake-up in the cycles of the last frame: median, 99th percentile and maximum.
  double late_p50 = 0.0, late_p99 = 0.0, late_worst = 0.0;
  std::uint64_t overruns = 0;  // number of cycles since the start that took longer than a period
  std::uint64_t skipped = 0;   // number of deadlines since the start that were missed, by overruns or late wake-ups
  std::uint64_t lost = 0;      // number of cycles since the start that were overwritten before the caller read them
  // [ns] Mean durations of the eight stages of a cycle: read, estimate, proxy, couple, feel, load, guard and write;
  // over the latest cycles with time stamps.
  std::array<double, 8> stage_ns{};
  double cycle_ns = 0.0;  // [ns] mean duration of a whole cycle: the sum of stage_ns
  bool realtime = false;
  std::string not_realtime_reason;  // empty if real-time
};

// Returned by Runtime::read_frame(): what happened since the last call, in order, and the state after it.
struct RuntimeFrame {
  // If more than 8192 cycles have run since the last call, some are missing: on the real clock the oldest, which
  // LoopHealth::lost counts, and on the virtual clock the newest. HapticSnapshot::cycle shows the gap.
  std::vector<vehicle::DriveSample> cycles;
  std::vector<haptics::HapticEvent> events;
  haptics::HapticSnapshot lever;  // never older than the cycles
  vehicle::VehicleState car;      // default values without a car
};

// Throws the same errors as Runtime's constructor, without running anything, and returns the gate. Used with a detached
// lever to check a configuration while the stick is still in use by a different runtime.
haptics::Gate check_runtime(const RuntimeConfig& config);

class Runtime {
 public:
  // Starts the loop disarmed, with the lever in the start gear (a real lever is not moved). If the engine runs at the
  // start, the ignition is on until set_controls() changes it. Throws FileError (the gate does not fit the device),
  // std::invalid_argument (also if the car does not fit the gate) or std::runtime_error, each with a one-sentence
  // message.
  explicit Runtime(const RuntimeConfig& config);
  ~Runtime();  // releases the motors and closes the recording
  Runtime(const Runtime&) = delete;
  Runtime& operator=(const Runtime&) = delete;

  const RuntimeConfig& config() const noexcept;  // has the hand in use and the tuning as last requested
  const haptics::Gate& gate() const noexcept;
  const haptics::DeviceSpec& device() const noexcept;
  const haptics::AdmittedTuning& admitted() const noexcept;  // the tuning in use

  // The frame side: all functions below must be called by the same thread.
  RuntimeFrame read_frame();
  haptics::HapticSnapshot snapshot();  // newest state of the lever
  vehicle::VehicleState car();         // newest state of the car; default values without a car
  // Uses position and push of the target. Has no effect with a driver or a real lever.
  void set_hand(const haptics::HandTarget& target);
  // Without a driver, each pedal of the car is as far down as in `controls` or as `keys` have moved it, whichever is
  // further down. The keys are those held now; they move the pedals in the car's time, cycle by cycle. With a driver,
  // only slope, guidance and guided gear of `controls` are used. They replace those of the driver. Keys and guidance
  // need a car.
  void set_controls(const haptics::DriverControls& controls, const haptics::PedalKeys& keys = {});
  haptics::Pedals keyboard();  // newest positions of the pedals that keys press
  haptics::AdmittedTuning change_tuning(const haptics::HapticTuning& wanted);  // see HapticLoop::change_tuning()
  // arm() allows forces, which ramp up from zero; disarm() ends them; stop() switches the motors off at once, like an
  // emergency stop button. The commands take effect in the next cycle; the resulting guard state is in the snapshot:
  // `idle`, `armed`, `ramping`, `running` or, after a fault, `damped` or `released`. A simulated lever leaves the state
  // `damped` by itself after 50 ms without a fault, except after GuardFault::chatter (chatter that continued with a
  // softer wall). In all other cases only arm() restores the forces.
  void arm() { follow(ForceCause::user_arms); }
  void disarm() { follow(ForceCause::user_disarms); }
  void stop() { follow(ForceCause::user_stops); }
  void follow(ForceCause cause);  // commands what kForceRules says for the lever in use
  // True if forces are on, or may come back with another loop: not after disarm() or stop(), nor after a fault or a
  // refused arming, until arm(). A fault is noticed from the second cycle after the last command on, which may not have
  // been processed earlier.
  bool wants_forces();
  const LoopHealth& health() const noexcept;  // as of the last read_frame(), or of the start

  // Starts a recording. This starts a new loop between two cycles, because a trace can be replayed only from the first
  // cycle of a loop. The new loop has forces as kForceRules says; they ramp up from zero as after arm().
  // Lever, hand and clock continue; cycles count from 0 again, and the current gear is reported as engaged again
  // (without a gear_left event before). The car continues from its state at the call; guidance fades in again from
  // zero. Throws FileError if the file cannot be created, or std::logic_error if a recording is running. In both cases
  // nothing changes.
  void start_recording(const std::filesystem::path& file);
  std::optional<std::string> poll_recording_problem();  // problem that ended the recording, returned only once
  std::optional<std::string> stop_recording();          // returns the recording's problem; empty: it is complete
  bool is_recording() const noexcept;

  void advance(double seconds);  // runs whole cycles on the virtual clock; throws std::logic_error on the real clock
  double time() const noexcept;  // [s] since the start, on the loop's clock

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace gearshift::runtime
