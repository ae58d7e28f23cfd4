// The running lever: device, hand, loop, thread, recorder. What window, demo and tests share.
//
// Two clocks: a real-time thread for people, a virtual clock moved by advance() for films and tests. Another gate, preset
// or hand is another Trainer. The frame may stop calling for seconds: the lever goes on.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/vehicle/car_world.h"
#include "haptics/device/hand.h"
#include "haptics/gate/gate.h"
#include "haptics/gate/gate_layout.h"
#include "haptics/loop/haptic_config.h"
#include "haptics/loop/haptic_loop.h"
#include "haptics/loop/preset.h"

namespace gearshift {

enum class TrainerClock { real_time, virtual_time };

enum class HandKind {
  led,     // by set_hand(): mouse, keys, pad
  touring  // by itself through every gear of the gate, over and over
};

struct TrainerConfig {
  GateLayout layout;
  std::optional<CarSpec> car;  // behind the lever; none: nothing
  CarStart start;              // of the car, and the gear that the lever stands in
  Preset preset;               // a hand that cannot lead is replaced by leading_hand()
  HandKind hand = HandKind::led;
  TrainerClock clock = TrainerClock::real_time;
  std::uint64_t seed = 1;             // of the touring hand's aims and the car's chance
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

class Trainer {
 public:
  // Starts the loop with the lever in the gear of the start, disarmed; a running engine's ignition is on until
  // set_controls() says otherwise. Throws FileError (the layout is impossible on this device), std::invalid_argument (the
  // car does not fit the gate, too) or std::runtime_error with one sentence.
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
  // Snapshots of the cycles since the last call, in order, for plots. More than `most` are thinned evenly, the strongest
  // and the weakest push of each part kept. Of a pause of more than 8192 cycles the first 8192.
  std::vector<HapticSnapshot> take_history(std::size_t most);
  void set_hand(const HandTarget& target);  // led hand only: position and push are used
  void set_controls(const DriverControls& controls);
  AdmittedTuning change_tuning(const HapticTuning& wanted);  // see HapticLoop::change_tuning
  // Forces are allowed and ramp up from zero; they are no more; motors off at once, the large red button. Taken in the
  // next cycle; what the guard makes of it stands in the snapshot: idle, armed, ramping, running, or, by a fault, damped
  // or released. From damped a simulated lever comes back by itself after 50 ms of health, unless it chattered whatever
  // its wall did (GuardFault::chatter): then, and from idle and released, by arm() alone.
  void arm();
  void disarm();
  void stop();
  LoopHealth health();

  // A trace can be run again only from a loop's first cycle on. So a recording starts a new loop at the lever as it
  // stands, between two cycles: armed if the old one was to its end, and then its forces ramp up from zero, as after
  // arm(). The lever, the hand and the clock go on; cycles count from 0 again and the gear that is in is engaged anew (a
  // second event, no gear_left before it). The car goes on from where it is when this is called. Throws FileError where the file cannot be made, std::logic_error while
  // recording: nothing has changed then.
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
