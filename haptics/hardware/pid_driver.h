// A force-feedback stick of the PID class in raw terms: its counts in, shares of its full force out. No metre, no newton:
// the calibration knows these (pid_lever.h).
//
// Two sides. The port's thread prepares the device, streams and finishes it; the haptic thread, or who measures, sees and
// wishes. Between them: newest whole values.
//
//   prepare    pid_setup.h: effects are created and all zero; actuators stay off
//   stream     pid_stream.h: enabled: actuators on, effects started, and renewed long before they end, so that a dead
//              program goes silent; the value that is furthest from what the device has goes first, one report a tick
//   release    before anything else: actuators off (or stop all, or zero force, whichever the device knows)
//   finish     stop all, actuators off, blocks freed, reset
//
// Every wish answers a sight, and so belongs to its session. A session ends when the device is prepared anew and when the
// haptic side has fallen silent while it drove: what was wished before drives nothing after.
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
#include "haptics/hardware/pid_stream.h"
#include "haptics/hardware/pid_wish.h"
#include "haptics/hardware/stick_problem.h"
#include "haptics/hid/hid_port.h"
#include "haptics/hid/lever_report.h"
#include "haptics/hid/pid_report.h"
#include "haptics/rt/latest_value.h"

namespace gearshift {

inline constexpr double kCommandSilence = 0.1;  // [s] without a wish, while enabled, before the motors are switched off

// What it says.
struct PidSight {
  std::uint64_t session = 0;   // 0: it has not been prepared yet
  std::uint64_t sequence = 0;  // reports of the lever that are believed, so far
  std::int64_t time_ns = 0;    // [ns] CLOCK_MONOTONIC, of the newest
  LeverCounts counts;
  std::array<double, 2> sent{};       // [1] constant forces as the device has them now
  std::array<PidSpring, 2> spring{};  // the same of its springs
  std::int64_t sent_ns = 0;           // [ns] when the last output arrived
  std::uint64_t outputs = 0;          // that have arrived, so far
  bool actuators = false;             // on, and an effect plays, as far as is known
};

class PidDriver final : public HidStream {
 public:
  // Throws HidError where the descriptor has no lever with X and Y, or no PID reports that push.
  explicit PidDriver(const std::vector<std::uint8_t>& report_descriptor);
  ~PidDriver() override;
  PidDriver(const PidDriver&) = delete;
  PidDriver& operator=(const PidDriver&) = delete;

  const LeverReport& lever_report() const noexcept { return lever_; }
  const PidLayout& layout() const noexcept { return pid_; }

  // Port's thread.
  PidAbility prepare(HidPort& port);  // throws HidGone, HidError: it has no constant force to give
  StreamConfig stream_config(std::int64_t tick_ns) const noexcept;
  void finish(HidPort& port) noexcept;  // as much as it still takes
  void on_input(std::span<const std::uint8_t> report, std::int64_t time_ns) noexcept override;
  HidBytes next_output(std::int64_t now_ns) noexcept override;
  void on_sent(std::int64_t time_ns) noexcept override;
  bool should_end() const noexcept override { return end_.load(std::memory_order_relaxed); }

  // Haptic side: one thread. Real-time safe; wish() and release() write to the wake-up descriptor. A wish counts for
  // kCommandSilence: repeat it, each cycle.
  PidSight see() noexcept;
  void wish(const PidWish& wish) noexcept;
  void release() noexcept;  // off before all else; a later wish() may enable again

  // Any thread.
  // [s] The stick was calibrated to answer so soon. One that takes twice as long for its outputs is driven no longer.
  void expect_answer(double seconds) noexcept {
    answer_ns_.store(std::llround(1e9 * seconds), std::memory_order_relaxed);
  }
  void end() noexcept { end_.store(true, std::memory_order_relaxed); }  // stream() comes back
  // What the device did wrong since it was prepared: one sentence, each kind once.
  std::optional<std::string> take_problem() { return problems_.take(); }

 private:
  struct Order {
    PidWish wish;
    std::uint64_t session = 0;   // of the sight that it answers
    std::uint64_t releases = 0;  // that came before it
  };

  struct Arrivals {  // of outputs
    std::int64_t since_ns = 0, all = 0, late = 0;
    std::int64_t took_ns = 0;  // together
  };

  void order(const PidWish& wish) noexcept;
  void wake() const noexcept;
  void obey(std::int64_t now_ns) noexcept;
  void end_session() noexcept;
  void watch_silence(std::int64_t now_ns) noexcept;
  void watch_arrival(bool anything, std::int64_t now_ns) noexcept;
  void watch_slowness(std::int64_t now_ns) noexcept;
  void see_lever(const LeverCounts& counts, std::int64_t time_ns) noexcept;
  void hear_state(const PidStatus& status, std::int64_t time_ns) noexcept;
  void publish() noexcept;

  // Of the device, constant.
  ReportDescriptor descriptor_;
  LeverReport lever_;
  PidLayout pid_;
  std::array<std::size_t, 256> input_size_{};  // [bytes] of each report, ID included; 0: there is none
  int wake_fd_;

  // Between the threads.
  LatestValue<Order> orders_;
  LatestValue<PidSight> sights_;
  std::atomic<std::uint64_t> releases_{0};
  std::atomic<bool> end_{false};
  std::atomic<std::int64_t> answer_ns_{0};  // 0: not known
  StickProblems problems_;

  // The port's thread.
  PidStream stream_;
  InputWatch watch_;
  StickBlocks blocks_{};
  bool prepared_ = false;  // and not finished
  PidSight sight_;
  std::uint64_t obeyed_releases_ = 0;
  std::int64_t ordered_ns_ = 0;  // when the last order was seen
  bool driven_ = false;          // by that order
  std::int64_t unarrived_ns_ = 0;
  bool unarrived_ = false;      // an output is under way since then
  std::int64_t handed_ns_ = 0;  // when the last output was handed out
  Arrivals arrivals_;

  // The haptic side.
  Order last_order_;
  std::uint64_t released_ = 0;
};

}  // namespace gearshift
