// The haptic cycle. The same code runs on a real-time thread and on a virtual clock.
//
// Each cycle makes eight calls, steps 2 to 9 of the list in app/README.md: read -> estimate -> move proxy -> couple ->
// feel -> load -> guard -> write.
//
// A wall can be rendered in two parts. If the device renders walls itself (DeviceSpec::device_wall_stiffness,
// device_wall_damping), the loop sends the walls' positions to the device. The device renders its part of the stiffness
// and damping without delay, and the loop renders the rest. HapticTuning describes the whole wall.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>

#include "haptics/contact/lever_estimator.h"
#include "haptics/contact/proxy.h"
#include "haptics/contact/reversal_limiter.h"
#include "haptics/contact/virtual_coupling.h"
#include "haptics/gate/gear_selector.h"
#include "haptics/gate/lockout.h"
#include "haptics/loop/haptic_config.h"
#include "haptics/loop/haptic_snapshot.h"
#include "haptics/loop/lever_load.h"
#include "haptics/rt/latest_value.h"
#include "haptics/rt/spsc_queue.h"
#include "haptics/safety/force_guard.h"

namespace gearshift::haptics {

enum class LoopCommand : std::uint8_t { none, arm, disarm, stop };
const char* to_string(LoopCommand command) noexcept;

// All inputs and outputs of one cycle: enough to replay it, compare it, and find its events (haptic_event.h).
struct TraceSample {
  std::int64_t deadline_ns = 0;  // [ns]
  std::int64_t skipped = 0;      // deadlines missed before this cycle, >= 0
  LeverReading reading;
  DriverControls controls;
  HapticTuning tuning;  // tuning applied in this cycle
  LoopCommand command = LoopCommand::none;
  HapticSnapshot out;
};

// Inputs that the rest of the program may change while the loop runs. Each has one writer; the loop reads them
// at the start of a cycle and never waits. Two loops that run one after the other may share them.
struct LoopInputs {
  LatestValue<HapticTuning> tuning;      // written only by HapticLoop::change_tuning, with the admitted values
  LatestValue<DriverControls> controls;  // pedals: positions of the pedal axes
  LatestValue<PedalKeys> pedal_keys;
  SpscQueue<LoopCommand> commands{16};
  // Any thread may set it. The next cycle then stops, as by LoopCommand::stop, and drops the commands in the queue.
  std::atomic<bool> stop{false};
};

// Time stamps between the eight calls. They are taken only every 64th cycle, because nine clock reads take longer than
// the work of a cycle.
struct StageStamps {
  static constexpr std::uint64_t kEvery = 64;
  std::uint64_t cycle = 0;
  std::array<std::int64_t, 9> ns{};  // [ns] start of the cycle, then the end of each call
};

class HapticLoop {
 public:
  // Checks config and device (throws std::invalid_argument) and limits the tuning. All referenced objects must outlive
  // the loop.
  HapticLoop(const HapticConfig& config, const Gate& gate, HapticDevice& device, LeverLoad& load, LoopInputs& inputs);

  // One cycle. deadline_ns: its scheduled time; skipped: deadlines missed before it.
  // noexcept, no allocation, no lock, no system call of its own.
  void cycle(std::int64_t deadline_ns, std::int64_t skipped) noexcept;

  // The newest cycle, or default values before the first. Call these on the loop's thread; pass the cycle to other
  // threads by a Broadcast.
  const TraceSample& published() const noexcept { return published_; }
  const HapticSnapshot& snapshot() const noexcept { return published_.out; }
  const AdmittedTuning& admitted() const noexcept { return admitted_; }  // tuning and limits at the start

  // Allows forces and ramps them up from zero. Call it before the first cycle; while the loop runs, use
  // LoopCommand::arm. Has no effect while forces are on or while the device's panic button is held (fault `stopped`).
  void arm() noexcept;

  // Changes the tuning while the loop runs; call it on the thread that writes to the inputs. The tuning is checked
  // and limited as at the start and takes effect in the next cycle. Throws std::invalid_argument if a value is out of
  // range or needs a ContactHold other than the one in use.
  AdmittedTuning change_tuning(const HapticTuning& wanted);

  // Time stamps of the most recent cycle that was stamped.
  const StageStamps& stamps() const noexcept { return stamps_; }

 private:
  void take_inputs() noexcept;
  void read_device(std::int64_t deadline_ns) noexcept;
  void apply_command(LoopCommand command) noexcept;
  void retune(const HapticTuning& tuning) noexcept;
  void follow_lever() noexcept;
  void limit_depth() noexcept;
  ContactForce couple_lever(std::int64_t skipped) noexcept;
  glm::dvec2 mechanism_feel(glm::dvec2 mean_proxy) const noexcept;
  LeverOutput step_load(std::int64_t skipped) noexcept;
  GuardInput guard_input(std::int64_t skipped) const noexcept;
  glm::dvec2 wanted_force() const noexcept { return wall_force_ + feel_force_ + load_output_.force; }
  double penetration() const noexcept;  // [m]
  void drive(const GuardOutput& command) noexcept;
  void send_device_walls(double ramp) noexcept;
  glm::dvec2 device_wall_force(const LeverWalls& walls) const noexcept;
  glm::dvec2 estimated_push(const GuardOutput& command) const noexcept;
  void account_force_flow(const GuardOutput& command) noexcept;
  void watch_push() noexcept;
  void watch_saturation(const GuardOutput& command) noexcept;
  void watch_chatter() noexcept;
  void watch_guard(std::int64_t skipped) noexcept;
  void publish(std::int64_t deadline_ns, std::int64_t skipped) noexcept;
  void fill_snapshot(HapticSnapshot& out, std::int64_t deadline_ns) const noexcept;

  HapticConfig config_;
  AdmittedTuning admitted_;
  Gate gate_;  // a copy, because it is read every cycle
  HapticDevice& device_;
  const DeviceSpec& spec_;  // of device_
  LeverLoad& load_;
  LoopInputs& inputs_;
  double period_;                                       // [s]
  double hand_over_step_;                               // [m] per cycle
  double device_wall_stiffness_, device_wall_damping_;  // [N/m], [N s/m]

  HapticTuning tuning_;
  DriverControls controls_;
  double brake_ = 0.0;  // [1] pedal in the previous cycle, as the load moved it
  LeverEstimator estimator_;
  LeverObserver observer_;
  ReversalLimiter limiter_;
  Lockouts lockouts_;
  GearSelector selector_;
  ForceGuard guard_;
  double stiffest_feel_;  // [N/m] stiffest feel of the gate
  LoopCommand command_ = LoopCommand::none;
  LeverReading reading_;
  LeverMotion motion_;
  Passage passage_;
  Proxy proxy_;
  glm::dvec2 wall_force_{0.0}, feel_force_{0.0};  // [N] coupling; gate's feel and damping
  LeverOutput load_output_;
  glm::dvec2 commanded_{0.0};       // [N] force after the guard
  glm::dvec2 push_{0.0};            // [N] force of the hand, the paper's f_h
  glm::dvec2 actuator_force_{0.0};  // [N] last finite one against the hand, the paper's f_a
  double wall_stiffness_ = 0.0;     // [N/m] admitted stiffness, lowered by the reversal limiter
  int slot_ = kNoSlot;
  bool is_push_measured_ = false;
  bool is_over_push_ = false;
  LeverWalls walls_;              // walls last sent to the device
  bool proxy_placed_ = false;     // the proxy has been placed at the lever since the start or the last arming
  bool first_step_ = true;        // the load's first step, which gets period 0
  bool motors_released_ = false;  // the motors of a real device in state damped have been released
  double healthy_time_ = 0.0;     // [s] duration of fresh readings so far, to re-arm a simulated lever
  struct Sent {
    glm::dvec2 force{0.0};  // [N]
    LeverWalls walls;
  };
  std::array<Sent, kMaxLoopDelay + 1> sent_{};  // commands of the most recent cycles
  double unsaturated_time_ = 1.0;               // [s] time since the wanted force last exceeded the device's limit
  std::uint64_t cycle_ = 0;                     // number of this cycle
  TraceSample published_;
  StageStamps stamps_;
};

}  // namespace gearshift::haptics
