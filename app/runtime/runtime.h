// The running lever: device, hand, loop, thread and recorder, shared by window, demo and tests.
//
// Two clocks: a real-time thread for people, or a virtual clock advanced by advance() for films and tests. A different
// gate, preset or driver needs a new Runtime. If the frame side makes no calls for seconds, the lever keeps running.
// Two kinds of lever: the preset's simulated one, whose hand is controlled from here, or a real one held by a person,
// which only a person may arm with arm().
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/vehicle/car_load.h"
#include "app/vehicle/drive_sample.h"
#include "haptics/device/hand.h"
#include "haptics/gate/gate.h"
#include "haptics/gate/gate_layout.h"
#include "haptics/loop/haptic_config.h"
#include "haptics/loop/haptic_loop.h"
#include "haptics/loop/preset.h"

namespace gearshift::runtime {

enum class RuntimeClock { real_time, virtual_time };

// A scripted driver: called with the last cycle, returns hand target and pedals for the next; the hand follows the
// target exactly, velocity included. On the virtual clock it is called once per cycle, within advance() and
// start_recording(). On the real clock a separate thread calls it in order, possibly some milliseconds late: it may
// allocate, and must not throw. If it falls seconds behind, cycles are skipped.
using DriverFunction = std::function<vehicle::DriverAction(const vehicle::DriveSample&)>;

// A person's pedals: called with the last cycle and the seconds since the one before, returns throttle, brake and
// clutch for the next cycle (other fields are ignored). Called like a DriverFunction, so that pedals move on the car's
// clock even if frames are rare; and once before the first cycle, with 0 s.
using PedalSource = std::function<haptics::DriverControls(const vehicle::DriveSample& cycle, double seconds)>;

// Creates a real lever for a loop of that period [s], without moving it; only one may be in use at a time. Throws
// std::invalid_argument with one sentence.
using LeverFactory = std::function<std::unique_ptr<haptics::HapticDevice>(double period)>;

struct RuntimeConfig {
  haptics::GateLayout layout;
  std::optional<vehicle::CarSpec> car;  // load on the lever; empty: none
  vehicle::CarStart start;              // of the car; also the gear that the lever starts in
  double hand_brake = 0.0;              // [1] 0 to 1, until set_controls() or the driver changes it
  haptics::Preset preset;               // a hand that cannot be controlled is replaced by leading_hand()
  LeverFactory lever;     // replaces the preset's lever; then the hand is not controlled, and there must be no driver
  DriverFunction driver;  // empty: set_hand() and set_controls() are used
  PedalSource feet;  // added to set_controls() if there is no driver: each pedal is the deeper of both; may be empty
  RuntimeClock clock = RuntimeClock::real_time;
  std::uint64_t seed = 1;             // for the car
  std::string program = "gearshift";  // name and version of the program, for the trace
};

// Timing of the thread since the last call. Lateness: wake-up after the deadline.
struct LoopHealth {
  double rate = 0.0;                                        // [Hz] as configured
  double late_p50 = 0.0, late_p99 = 0.0, late_worst = 0.0;  // [s]
  std::uint64_t overruns = 0;                               // cycles that took too long, since the start
  std::uint64_t skipped = 0;      // deadlines missed: by overruns, and by waking up a period late or more
  std::uint64_t events_lost = 0;  // since the start; 0 if all is well
  std::array<double, 8>
      stage_ns{};         // [ns] read, estimate, proxy, couple, feel, load, guard, write: mean of the latest stamps
  double cycle_ns = 0.0;  // [ns] whole cycle, from the same stamps
  bool realtime = false;
  std::string not_realtime_reason;  // empty if real-time
};

// Throws what Runtime's constructor would, without running anything: for checking a lever that another runtime still
// uses, with a stand-in for it. Returns the gate.
haptics::Gate check_runtime(const RuntimeConfig& config);

class Runtime {
 public:
  // Starts the loop disarmed, with the lever in the start gear (a real lever stays where it is). If the engine runs,
  // the ignition is on until set_controls() changes it. Throws FileError (the layout does not fit this device),
  // std::invalid_argument (also if the car does not fit the gate) or std::runtime_error with one sentence.
  explicit Runtime(const RuntimeConfig& config);
  ~Runtime();  // releases the motors and closes the recording
  Runtime(const Runtime&) = delete;
  Runtime& operator=(const Runtime&) = delete;

  const RuntimeConfig& config() const noexcept;  // with the hand in use and the tuning as last requested
  const haptics::Gate& gate() const noexcept;
  const haptics::DeviceSpec& device() const noexcept;
  const haptics::AdmittedTuning& admitted() const noexcept;  // in use now

  // Frame side, for one thread.
  haptics::HapticSnapshot snapshot();                // newest
  vehicle::VehicleState car();                       // newest; default values without a car
  std::vector<haptics::HapticEvent> drain_events();  // since the last call, in order
  // Every cycle since the last call, in order. After a pause of more than 8192 cycles, the first 8192; the gap shows in
  // HapticSnapshot::cycle.
  std::vector<vehicle::DriveSample> drain_cycles();
  // Uses position and push; ignored with a driver or a real lever.
  void set_hand(const haptics::HandTarget& target);
  // With a driver only slope, guidance and guided gear are used, and the driver's own are ignored. Guidance needs a
  // car.
  void set_controls(const haptics::DriverControls& controls);
  haptics::AdmittedTuning change_tuning(const haptics::HapticTuning& wanted);  // see HapticLoop::change_tuning
  // arm() allows forces, which ramp up from zero; disarm() ends them; stop() switches the motors off at once, like the
  // large red button. Applied in the next cycle; the resulting guard state is in the snapshot: idle, armed, ramping,
  // running or, after a fault, damped or released. A simulated lever leaves damped by itself after 50 ms without a
  // fault, unless it chattered even with a softer wall (GuardFault::chatter). From there, and from idle and released,
  // only arm() restores the forces.
  void arm();
  void disarm();
  void stop();
  LoopHealth health();

  // A trace can be replayed only from the first cycle of a loop. So a recording starts a new loop between two cycles,
  // with the lever where it is: armed if the old one was, with forces ramping up from zero as after arm(). Lever, hand
  // and clock continue; cycles count from 0 again, and the current gear is engaged again (a second event, without
  // gear_left before it). The car continues from its state at the call; guidance fades in again from zero. Throws
  // FileError if the file cannot be created, std::logic_error while recording: nothing has changed then.
  void start_recording(const std::filesystem::path& file);
  std::optional<std::string> poll_recording_problem();  // the problem that ended the current recording, returned once
  std::optional<std::string> stop_recording();          // a problem, if there was one
  bool is_recording() const noexcept;

  void advance(double seconds);  // virtual clock only (else std::logic_error): runs whole cycles
  double time() const noexcept;  // [s] on the loop's clock, since the start

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace gearshift::runtime
