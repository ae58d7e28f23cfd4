// The haptic cycle. The same code runs on a real-time thread and on a virtual clock.
//
// A force sample in eight calls: read -> estimate -> move proxy -> couple -> feel -> world -> guard -> write.
//
// A wall may have two keepers: where the device keeps walls itself (DeviceSpec::own_stiffness, own_damping), it is told
// where they are and makes what it can of the wall's stiffness and damping, without delay; the loop makes the rest.
// HapticTuning's are the whole wall's.
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
#include "haptics/loop/lever_world.h"
#include "haptics/rt/latest_value.h"
#include "haptics/rt/spsc_queue.h"
#include "haptics/safety/force_guard.h"

namespace gearshift {

enum class LoopCommand : std::uint8_t { none, arm, disarm, stop };

// Everything that came into one cycle, and what came out: enough to run it again and compare.
struct TraceSample {
  std::int64_t deadline_ns = 0;  // [ns]
  std::int64_t skipped = 0;      // deadlines missed before this one, >= 0
  LeverReading reading;
  DriverControls controls;
  HapticTuning tuning;  // as applied in this cycle
  LoopCommand command = LoopCommand::none;
  HapticSnapshot out;
};

// The wires between the loop and the rest of the program.
struct LoopChannels {
  LatestValue<HapticSnapshot> snapshot;       // loop -> frame
  LatestValue<HapticTuning> tuning;           // frame -> loop, by HapticLoop::change_tuning alone: what is admitted
  LatestValue<DriverControls> controls;       // frame -> loop
  SpscQueue<HapticEvent> events{4096};        // loop -> app
  SpscQueue<TraceSample> trace{8192};         // loop -> recorder
  SpscQueue<LoopCommand> commands{16};        // app -> loop
  std::atomic<bool> recording{false};         // set by the recorder
  std::atomic<std::uint64_t> trace_lost{0};   // samples that did not fit: the trace is torn
  std::atomic<std::uint64_t> events_lost{0};  // 0 in health
};

// Clock stamps between the eight calls, taken every 64th cycle: nine reads of the clock cost more than the
// cycle.
struct StageStamps {
  static constexpr std::uint64_t kEvery = 64;
  std::uint64_t cycle = 0;
  std::array<std::int64_t, 9> ns{};  // [ns] start, then after each of read .. write
};

class HapticLoop {
 public:
  // Checks config and device (throws std::invalid_argument) and admits the tuning. All references must outlive the
  // loop.
  HapticLoop(const HapticConfig& config, const Gate& gate, HapticDevice& device, LeverWorld& world,
             LoopChannels& channels);

  // One cycle. deadline_ns: the cycle's place on the clock; skipped: deadlines missed before it.
  // noexcept, no allocation, no lock, no system call of its own.
  void cycle(std::int64_t deadline_ns, std::int64_t skipped) noexcept;

  const HapticSnapshot& snapshot() const noexcept { return out_; }       // on the loop's own thread
  const DriverControls& controls() const noexcept { return controls_; }  // of the last cycle, on the same thread
  const AdmittedTuning& admitted() const noexcept { return admitted_; }  // at the start

  // Allows forces, ramped up from zero. Before the first cycle, or by LoopCommand::arm while it runs. Nothing while the
  // device's panic button is held (fault: stopped), nor while there are forces.
  void arm() noexcept;

  // While the loop runs, on the thread that owns the channels' writing end: the same check as at the start, and what
  // it admits is used from the next cycle on. Throws std::invalid_argument where a value is outside its range, or where
  // it is admitted only with another hold than the one that runs.
  AdmittedTuning change_tuning(const HapticTuning& wanted);

  // Stamps of the last cycle's stages for every 64th cycle; the others leave them as they are.
  const StageStamps& stamps() const noexcept { return stamps_; }

 private:
  void take_inputs() noexcept;
  void read_device(std::int64_t deadline_ns) noexcept;
  void obey(LoopCommand command) noexcept;
  void retune(const HapticTuning& tuning) noexcept;
  void follow_lever() noexcept;
  void limit_depth() noexcept;
  Coupled couple_lever(std::int64_t skipped) noexcept;
  glm::dvec2 mechanism_feel(glm::dvec2 mean_proxy) const noexcept;
  LeverOutput run_world(std::int64_t skipped) noexcept;
  GuardInput guard_input(std::int64_t skipped) const noexcept;
  glm::dvec2 wanted_force() const noexcept { return out_.wall_force + out_.feel_force + world_out_.force; }
  void drive(const GuardOutput& command) noexcept;
  void tell_walls(double share) noexcept;
  glm::dvec2 own_wall_force(const LeverWalls& walls) const noexcept;
  bool is_saturated(const GuardOutput& command) const noexcept;
  glm::dvec2 estimated_push(const GuardOutput& command) const noexcept;
  void account_force_flow(const GuardOutput& command) noexcept;
  void watch_gear() noexcept;
  void watch_push() noexcept;
  void watch_saturation(const GuardOutput& command) noexcept;
  void watch_contact() noexcept;
  void watch_chatter() noexcept;
  void watch_guard(std::int64_t skipped) noexcept;
  void publish(std::int64_t skipped) noexcept;
  void record(std::int64_t skipped) noexcept;
  void tell(EventKind kind, double value) noexcept;
  void set_flag(std::uint32_t flag, bool on) noexcept;
  bool has_flag(std::uint32_t flag) const noexcept { return (out_.flags & flag) != 0; }

  HapticConfig config_;
  AdmittedTuning admitted_;
  Gate gate_;  // its own copy: read every cycle
  HapticDevice& device_;
  const DeviceSpec& spec_;  // the device's, asked for once
  LeverWorld& world_;
  LoopChannels& channels_;
  double period_;                   // [s]
  double hand_over_;                // [m] per cycle
  double own_walls_, own_dampers_;  // [N/m], [N s/m] that the device keeps by itself

  HapticTuning tuning_;
  DriverControls controls_;
  LeverEstimator estimator_;
  LeverObserver observer_;
  ReversalLimiter limiter_;
  Lockouts lockouts_;
  GearSelector selector_;
  ForceGuard guard_;
  double stiffest_feel_;  // [N/m] of the gate
  LoopCommand command_ = LoopCommand::none;
  LeverReading reading_;
  LeverMotion motion_;
  Passage passage_;
  Proxy proxy_;
  LeverOutput world_out_;
  LeverWalls walls_;        // as the device was last told
  bool placed_ = false;     // the proxy stands where the lever was at the start or at arming
  bool first_step_ = true;  // of the world: period 0
  bool let_go_ = false;     // the motors of a device that is not simulated, in the state damped
  double healthy_ = 0.0;    // [s] of fresh readings in a row, to re-arm a simulated lever
  struct Sent {
    glm::dvec2 force{0.0};  // [N]
    LeverWalls walls;
  };
  std::array<Sent, kMostDelay + 1> sent_{};  // in the last cycles
  double apart_ = 1.0;                       // [s] since the lever last touched a wall
  double unsaturated_ = 1.0;                 // [s] since the wanted force was last beyond the device
  HapticSnapshot out_;
  StageStamps stamps_;
};

}  // namespace gearshift
