// The running lever: device, hand, loop, thread, recorder. What window, demo and tests share.
//
// Two clocks: a real-time thread for people, a virtual clock moved by advance() for films and tests. Another gate,
// preset or driver is another Trainer. The frame may stop calling for seconds: the lever goes on.
// Two levers: the preset's, simulated, with a hand on it that is led from here; or one that somebody holds, and that
// nobody arms but a person, by arm().
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/training/drive_sample.h"
#include "app/vehicle/car_world.h"
#include "haptics/device/hand.h"
#include "haptics/gate/gate.h"
#include "haptics/gate/gate_layout.h"
#include "haptics/loop/haptic_config.h"
#include "haptics/loop/haptic_loop.h"
#include "haptics/loop/preset.h"

namespace gearshift {

enum class TrainerClock { real_time, virtual_time };

// In place of a person: the cycle that was, to what is done next; the hand is led as it says, velocity included. On the
// virtual clock it is called once a cycle, within advance() and start_recording(); on the real clock, in order, by a
// thread of its own that may be some milliseconds behind: it may allocate, and must not throw. Where it is seconds
// behind, cycles are left out.
using SelfDriver = std::function<DriverAction(const DriveSample&)>;

// Beside a person: the cycle that was and the seconds since the one before, to where throttle, brake and clutch stand in
// the next one (the rest is not used). Called as a SelfDriver is, so that pedals move on the car's clock however seldom a
// frame comes; and once before the first cycle, with 0 s.
using PersonFeet = std::function<DriverControls(const DriveSample& cycle, double seconds)>;

// Makes a lever that is not simulated, for a loop of that period [s]. Making it moves nothing; one at a time is driven.
// Throws std::invalid_argument with one sentence.
using LeverMaker = std::function<std::unique_ptr<HapticDevice>(double period)>;

struct TrainerConfig {
  GateLayout layout;
  std::optional<CarSpec> car;  // behind the lever; none: nothing
  CarStart start;              // of the car, and the gear that the lever stands in
  double hand_brake = 0.0;     // [1] 0 to 1, until set_controls() or the driver says otherwise
  Preset preset;               // a hand that cannot lead is replaced by leading_hand()
  LeverMaker lever;            // in place of the preset's; then nothing leads the hand, and there is no driver
  SelfDriver driver;           // none: set_hand() and set_controls() lead
  PersonFeet feet;             // with these, where nobody else drives: each pedal as deep as the deeper; may be none
  TrainerClock clock = TrainerClock::real_time;
  std::uint64_t seed = 1;             // of the car's chance
  std::string program = "gearshift";  // that records: its name and version, for the trace
};

// How well the thread keeps its time, since the last look. Lateness: woken after the deadline.
struct LoopHealth {
  double rate = 0.0;                                        // [Hz] as configured
  double late_p50 = 0.0, late_p99 = 0.0, late_worst = 0.0;  // [s]
  std::uint64_t overruns = 0;                               // cycles that took too long, since the start
  std::uint64_t skipped = 0;                                // deadlines missed: these, and woken a period late or more
  std::uint64_t events_lost = 0;                            // since the start; 0 in health
  std::array<double, 8>
      stage_ns{};         // [ns] read, estimate, proxy, couple, feel, world, guard, write: mean of the last stamps
  double cycle_ns = 0.0;  // [ns] of these
  bool realtime = false;
  std::string why_not;  // not real-time
};

// Throws what Trainer's constructor would, and runs nothing: for a lever that one trainer has and another shall get, with a
// stand-in for it. Returns the gate.
Gate check_trainer(const TrainerConfig& config);

class Trainer {
 public:
  // Starts the loop with the lever in the gear of the start (one that is not simulated stays where it is), disarmed; a
  // running engine's ignition is on until set_controls() says otherwise. Throws FileError (the layout is impossible on this device), std::invalid_argument
  // (the car does not fit the gate, too) or std::runtime_error with one sentence.
  explicit Trainer(const TrainerConfig& config);
  ~Trainer();  // releases the motors, closes the recording
  Trainer(const Trainer&) = delete;
  Trainer& operator=(const Trainer&) = delete;

  const TrainerConfig& config() const noexcept;  // the hand that leads; the tuning as last wanted
  const Gate& gate() const noexcept;
  const DeviceSpec& device() const noexcept;
  const AdmittedTuning& admitted() const noexcept;  // in use now

  // Frame side, one thread.
  HapticSnapshot snapshot();               // newest
  VehicleState car();                      // newest; a default one where there is no car
  std::vector<HapticEvent> take_events();  // since the last call, in order
  // The cycles since the last call, in order, every one. Of a pause of more than 8192 cycles the first 8192: the gap
  // shows in HapticSnapshot::cycle.
  std::vector<DriveSample> take_cycles();
  // Position and push are used; not where there is a driver, or a lever that somebody holds.
  void set_hand(const HandTarget& target);
  // Where there is a driver: slope, guidance and guided gear alone, his own are not used. Guidance takes a car.
  void set_controls(const DriverControls& controls);
  AdmittedTuning change_tuning(const HapticTuning& wanted);  // see HapticLoop::change_tuning
  // Forces are allowed and ramp up from zero; they are no more; motors off at once, the large red button. Taken in the
  // next cycle; what the guard makes of it stands in the snapshot: idle, armed, ramping, running, or, by a fault,
  // damped or released. From damped a simulated lever comes back by itself after 50 ms of health, unless it chattered
  // whatever its wall did (GuardFault::chatter): then, and from idle and released, by arm() alone.
  void arm();
  void disarm();
  void stop();
  LoopHealth health();

  // A trace can be run again only from a loop's first cycle on. So a recording starts a new loop at the lever as it
  // stands, between two cycles: armed if the old one was to its end, and then its forces ramp up from zero, as after
  // arm(). The lever, the hand and the clock go on; cycles count from 0 again and the gear that is in is engaged anew
  // (a second event, no gear_left before it). The car goes on from where it is when this is called; guidance grows anew
  // from none. Throws FileError where the file cannot be made, std::logic_error while recording: nothing has changed
  // then.
  void start_recording(const std::filesystem::path& file);
  std::optional<std::string> take_recording_problem();  // that ended the running recording, once, when it happens
  std::optional<std::string> stop_recording();          // a problem, if there was one
  bool recording() const noexcept;

  void advance(double seconds);  // virtual clock only (else std::logic_error): that long, in whole cycles
  double time() const noexcept;  // [s] of the loop's clock since the start

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace gearshift
