// Driver for a force-feedback stick of the USB PID class, in raw units: positions in counts, forces as fractions of
// full force. The calibration adds metres and newtons (pid_lever.h).
//
// Two threads use it. The port's thread prepares the device, streams, and finishes it; the haptic thread (or a
// calibration) reads the state and sends commands. The threads exchange only the newest complete values.
//
//   prepare    creates the effects with zero force; the actuators stay off (pid_setup.h)
//   stream     sends one report per tick (report_scheduler.h). While enabled, turns the actuators on, and starts the
//              effects again before they end. Thus the force ends soon if the program dies.
//              A command with a push_time ends its own force, however late the next command is.
//   release    turns the actuators off, stops all effects and sets the forces to zero, before anything else is sent
//   finish     stops all effects, turns the actuators off, frees the blocks and resets the device
//
// Each command carries the session of the state it was computed from; commands of an ended session are ignored. A
// session ends when the device is prepared again, when a fault switches the motors off, or when the haptic side stops
// sending commands while the motors are on.
#pragma once

#include <array>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "haptics/hardware/input_watch.h"
#include "haptics/hardware/pid_setup.h"
#include "haptics/hardware/report_scheduler.h"
#include "haptics/hardware/stick_command.h"
#include "haptics/hardware/stick_problem.h"
#include "haptics/hid/hid_port.h"
#include "haptics/hid/lever_report.h"
#include "haptics/hid/pid_report.h"
#include "haptics/rt/latest_value.h"

namespace gearshift::haptics {

// [s] Time without a command after which enabled motors are switched off.
inline constexpr double kCommandSilence = 0.1;

struct StickState {
  std::uint64_t session = 0;   // 0: not prepared yet
  std::uint64_t sequence = 0;  // number of accepted lever reports
  std::int64_t time_ns = 0;    // [ns] CLOCK_MONOTONIC, arrival of the newest lever report
  LeverCounts counts;
  std::array<double, 2> sent{};         // [1] constant forces that the device renders now
  std::array<PidSpring, 2> spring{};    // springs that the device renders now
  std::array<double, 2> damper{};       // [1] and dampers, fractions of the maximum coefficient
  StickFault doubt = StickFault::none;  // what its state report says; firmware may never set these bits
  std::int64_t sent_ns = 0;             // [ns] when the last output arrived
  std::uint64_t outputs = 0;            // number of outputs that have arrived
  StickStyle style;                     // whose settings have arrived
  std::int64_t style_ns = 0;            // [ns] when they had
  std::int64_t off_ns = 0;              // [ns] newest state report that the actuators are off; 0: none
  bool actuators = false;               // the actuators are on and an effect is playing, as far as is known
};

class PidDriver final : public HidStream {
 public:
  // Throws HidError if the descriptor has no lever with X and Y, or no PID reports that can make a force.
  explicit PidDriver(const std::vector<std::uint8_t>& report_descriptor, StickStyle style = {});
  ~PidDriver() override;
  PidDriver(const PidDriver&) = delete;
  PidDriver& operator=(const PidDriver&) = delete;

  const LeverReport& lever_report() const noexcept { return lever_; }
  const PidLayout& layout() const noexcept { return pid_; }

  // How the effects name their axes. A new style switches the motors off until it has been sent. May be called on
  // any thread.
  void set_style(StickStyle style) noexcept { style_.store(style, std::memory_order_relaxed); }

  // Port's thread.
  PidAbility prepare(HidPort& port);  // throws HidDisconnected, or HidError if the device cannot make a constant force
  StreamConfig stream_config(std::int64_t tick_ns) const noexcept;
  void finish(HidPort& port) noexcept;  // see silence_stick()
  void on_input(std::span<const std::uint8_t> report, std::int64_t time_ns) noexcept override;
  HidBytes next_output(std::int64_t now_ns) noexcept override;
  void on_sent(std::int64_t time_ns) noexcept override;
  bool should_end() const noexcept override { return end_.load(std::memory_order_relaxed); }

  // The haptic thread or a calibration calls the next five functions, on one thread only. They are real-time safe;
  // command() and release() write to an eventfd. A command expires after kCommandSilence, so it must be repeated every
  // cycle.
  StickState state() noexcept;
  void command(const StickCommand& command) noexcept;
  void report(StickProblem problem) noexcept { problems_.raise_again(problem); }
  void report_once(StickProblem problem, std::int64_t detail) noexcept { problems_.raise(problem, detail); }
  void release() noexcept;  // switches the motors off before anything else is sent; a later command() may enable them

  // Sets the calibrated answer time [s]. May be called on any thread. The motors are switched off if most outputs take
  // longer than twice this time plus 1 ms.
  void expect_answer(double seconds) noexcept {
    answer_ns_.store(std::llround(1e9 * seconds), std::memory_order_relaxed);
  }
  void end() noexcept { end_.store(true, std::memory_order_relaxed); }  // makes stream() return
  // Returns the next problem since the device was prepared, as one sentence, or an empty value if there is none. Each
  // kind of problem is returned once.
  std::optional<std::string> take_problem() { return problems_.take(); }

 private:
  struct Command {
    StickCommand command;
    std::uint64_t session = 0;   // session of the state that the command was computed from
    std::uint64_t releases = 0;  // number of releases before the command
  };

  struct Arrivals {  // arrived outputs
    std::int64_t since_ns = 0, all = 0, late = 0;
    std::int64_t transfer_ns = 0;  // sum of the transfer times
  };

  void post_command(const StickCommand& command) noexcept;
  void wake() const noexcept;
  void apply_command(std::int64_t now_ns) noexcept;
  void end_session() noexcept;
  void watch_silence(std::int64_t now_ns) noexcept;
  void watch_arrival(bool anything, std::int64_t now_ns) noexcept;
  void watch_slowness(std::int64_t now_ns) noexcept;
  void on_lever_report(const LeverCounts& counts, std::int64_t time_ns) noexcept;
  void on_state_report(const PidStatus& status, std::int64_t time_ns) noexcept;
  bool is_length_right(std::size_t size) noexcept;
  void publish() noexcept;

  // Constant properties of the device.
  ReportDescriptor descriptor_;
  LeverReport lever_;
  PidLayout pid_;
  std::array<std::size_t, 256> input_size_{};  // [bytes] size per report ID, ID included; 0: no such report
  int wake_fd_;

  // Shared by the threads.
  LatestValue<Command> commands_;
  LatestValue<StickState> states_;
  std::atomic<std::uint64_t> releases_{0};
  std::atomic<bool> end_{false};
  std::atomic<std::int64_t> answer_ns_{0};  // 0: not known
  std::atomic<StickStyle> style_;
  StickProblems problems_;

  // The port's thread.
  ReportScheduler scheduler_;
  InputWatch watch_;
  StickBlocks blocks_{};
  bool prepared_ = false;          // prepared and not finished
  std::size_t lever_size_ = 0;     // [bytes] of lever reports, as declared or as the stick sends them from the start
  std::size_t odd_size_ = 0;       // [bytes] of the newest lever reports, if different
  int odd_reports_ = 0;            // number of lever reports of odd_size_ in a row
  bool has_right_length_ = false;  // a report of lever_size_ has arrived
  StickState state_;
  std::uint64_t applied_releases_ = 0;
  std::int64_t command_ns_ = 0;  // when the last command was received
  StickCommand received_;        // the last command
  std::int64_t changed_ns_ = 0;  // when it was first received
  bool driven_ = false;          // the last command is valid and enables the motors
  std::int64_t unarrived_ns_ = 0;
  bool unarrived_ = false;      // an output has been in transit since unarrived_ns_
  std::int64_t handed_ns_ = 0;  // when the last output was handed to the port
  Arrivals arrivals_;

  // The haptic side.
  Command last_command_;
  std::uint64_t released_ = 0;
};

}  // namespace gearshift::haptics
