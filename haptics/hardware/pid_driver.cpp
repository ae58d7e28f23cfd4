#include "haptics/hardware/pid_driver.h"

#include <sys/eventfd.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace gearshift::haptics {
namespace {

constexpr std::int64_t kSilence = static_cast<std::int64_t>(1e9 * kCommandSilence);  // [ns]
constexpr std::int64_t kMillisecond = 1'000'000;                                     // [ns]
constexpr std::int64_t kUnarrived = 100 * kMillisecond;  // [ns] an output that is in transit for longer is stuck
constexpr std::int64_t kSlowness = 500 * kMillisecond;   // [ns] period for which transfer times are averaged
constexpr std::int64_t kMinArrivals = 5;
constexpr int kSteadyReports = 20;  // so many lever reports in a row of an undeclared length are right

LeverReport lever_of(const ReportDescriptor& descriptor) {
  if (std::optional<LeverReport> lever = find_lever_report(descriptor)) return *std::move(lever);
  throw HidError("this device is not a stick, because its descriptor has no X and Y axes");
}

PidLayout pid_of(const ReportDescriptor& descriptor) {
  if (const std::optional<PidLayout> pid = find_pid(descriptor)) return *pid;
  throw HidError("this stick has no force feedback, because its descriptor has no force reports (PID class)");
}

std::array<std::size_t, 2> stick_axes(const LeverReport& lever) {
  std::array<std::size_t, 2> found{};
  for (std::size_t i = 0; i < lever.axes.size(); ++i) {
    if (lever.axes[i].usage == kUsageX) found[0] = i;
    if (lever.axes[i].usage == kUsageY) found[1] = i;
  }
  return found;
}

StickProblem problem_of(StickFault fault) noexcept {
  if (fault == StickFault::no_power) return StickProblem::no_power;
  return fault == StickFault::safety_switch ? StickProblem::safety_switch : StickProblem::switched_off;
}

// False if the command contains a NaN or an infinity.
bool is_number(const StickCommand& command) noexcept {
  bool finite = std::isfinite(command.constant[0]) && std::isfinite(command.constant[1]);
  for (const double damper : command.damper) finite = finite && std::isfinite(damper);
  for (const PidSpring& spring : command.spring) {
    finite = finite && std::isfinite(spring.centre) && std::isfinite(spring.dead_band) &&
             std::isfinite(spring.coefficient) && std::isfinite(spring.saturation);
  }
  return finite;
}

}  // namespace

PidDriver::PidDriver(const std::vector<std::uint8_t>& report_descriptor, StickStyle style)
    : descriptor_(parse_report_descriptor(report_descriptor)),
      lever_(lever_of(descriptor_)),
      pid_(pid_of(descriptor_)),
      wake_fd_(eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC)),
      style_(style),
      scheduler_(pid_),
      watch_(lever_, stick_axes(lever_)) {
  for (std::size_t id = 0; id < input_size_.size(); ++id) {
    input_size_[id] = descriptor_.report_size(ReportKind::input, static_cast<std::uint8_t>(id));
  }
  scheduler_.begin(blocks_, true, {});
}

PidDriver::~PidDriver() {
  if (wake_fd_ >= 0) close(wake_fd_);
}

PidAbility PidDriver::prepare(HidPort& port) {
  end_.store(false, std::memory_order_relaxed);
  prepared_ = false;
  const StickStyle style = style_.load(std::memory_order_relaxed);
  PreparedStick prepared = prepare_stick(port, pid_, style);
  problems_.reset();
  blocks_ = prepared.blocks;
  scheduler_.begin(blocks_, prepared.ability.finite, style);
  lever_size_ = lever_.size;
  odd_size_ = 0;
  odd_reports_ = 0;
  has_right_length_ = false;
  watch_ = InputWatch(lever_, stick_axes(lever_));
  driven_ = unarrived_ = false;
  arrivals_ = {};
  prepared_ = true;
  state_.style = style;
  state_.style_ns = state_.off_ns = 0;
  ++state_.session;
  publish();
  return std::move(prepared.ability);
}

StreamConfig PidDriver::stream_config(std::int64_t tick_ns) const noexcept {
  StreamConfig config;
  config.wake_fd = wake_fd_;
  config.tick_ns = tick_ns;
  config.lever_report = lever_.id;
  return config;
}

void PidDriver::finish(HidPort& port) noexcept {
  silence_stick(port, pid_, blocks_);
  blocks_ = {};
  prepared_ = false;
  scheduler_.begin(blocks_, true, {});
  publish();
}

void PidDriver::on_input(std::span<const std::uint8_t> report, std::int64_t time_ns) noexcept {
  if (report.empty()) return;
  if (input_size_[report[0]] == 0) return problems_.raise(StickProblem::unknown_report, report[0]);
  if (report[0] == lever_.id) {
    const bool is_right = is_length_right(report.size());
    const std::optional<LeverCounts> counts = decode_lever(lever_, report);
    if (is_right && counts) {
      on_lever_report(*counts, time_ns);
    } else if (has_right_length_ || !counts) {
      problems_.raise(StickProblem::wrong_length, static_cast<std::int64_t>(report.size()),
                      static_cast<std::int64_t>(lever_size_));
    }
  }
  if (const std::optional<PidStatus> status = decode_state(pid_, report)) on_state_report(*status, time_ns);
}

// Some sticks send more or fewer bytes than their descriptor declares, from the first report on. A single report of
// another length may be anything, an echo of an output for example.
bool PidDriver::is_length_right(std::size_t size) noexcept {
  if (size == lever_size_) {
    odd_reports_ = 0;
    has_right_length_ = true;
    return true;
  }
  odd_reports_ = size == odd_size_ ? odd_reports_ + 1 : 1;
  odd_size_ = size;
  if (has_right_length_ || odd_reports_ < kSteadyReports) return false;
  lever_size_ = size;
  return true;
}

// Checks the position sensors and publishes the reading. Readings of a frozen sensor are dropped, so that the loop sees
// no fresh reading.
void PidDriver::on_lever_report(const LeverCounts& counts, std::int64_t time_ns) noexcept {
  watch_.update(counts, scheduler_.force(), scheduler_.spring(), time_ns);
  if (watch_.jump() > 0.0) problems_.raise(StickProblem::position_jump, std::lround(100.0 * watch_.jump()));
  const StickFault doubt = scheduler_.doubt();
  if (doubt != StickFault::none && (watch_.is_frozen() || watch_.is_faded_out())) {
    problems_.raise_again(problem_of(doubt));  // a better reason than a dead sensor
    end_session();
  } else if (watch_.is_frozen()) {
    return problems_.raise(StickProblem::frozen, std::lround(kFrozenTime));
  } else if (watch_.is_faded_out()) {
    problems_.raise(StickProblem::faded_out, std::lround(kFrozenTime + kFadeOutTime));
    end_session();
  }
  ++state_.sequence;
  state_.time_ns = time_ns;
  state_.counts = counts;
  publish();
}

// After any fault except effect_stopped, the motors stay off until the user arms the lever again.
void PidDriver::on_state_report(const PidStatus& status, std::int64_t time_ns) noexcept {
  if (!status.actuators_enabled && pid_.state.actuators_enabled.exists()) state_.off_ns = time_ns;
  const StickFault fault = scheduler_.on_report(status, time_ns);
  if (fault == StickFault::none) return publish();
  if (fault == StickFault::effect_stopped) {
    problems_.raise(StickProblem::effect_stopped);
    return publish();
  }
  problems_.raise_again(problem_of(fault));
  end_session();
}

HidBytes PidDriver::next_output(std::int64_t now_ns) noexcept {
  apply_command(now_ns);
  watch_silence(now_ns);
  const HidBytes report = scheduler_.next(now_ns);
  watch_arrival(report.size > 0, now_ns);
  return report;
}

// Applies the newest command. Replaces it with an empty command if it was sent before the last release or belongs to an
// ended session.
void PidDriver::apply_command(std::int64_t now_ns) noexcept {
  if (commands_.update()) command_ns_ = now_ns;
  if (commands_.value().command != received_) changed_ns_ = now_ns;
  received_ = commands_.value().command;
  const std::uint64_t releases = releases_.load(std::memory_order_acquire);
  if (releases != applied_releases_) scheduler_.release();
  applied_releases_ = releases;
  const Command& newest = commands_.value();
  const bool is_current = prepared_ && newest.session == state_.session && newest.releases == releases;
  driven_ = is_current && newest.command.enabled;
  StickCommand command = is_current ? newest.command : StickCommand{};
  if (command.push_time > 0.0 && 1e-9 * static_cast<double>(now_ns - changed_ns_) >= command.push_time)
    command.constant = {};
  for (std::size_t i = 0; i < 2; ++i) {  // also fades the device walls, because they use the same sensor
    command.constant[i] *= watch_.force_fraction(i);
    command.spring[i].coefficient *= watch_.force_fraction(i);
  }
  scheduler_.set_style(style_.load(std::memory_order_relaxed));
  scheduler_.set_command(command);
}

// Switches the motors off if the haptic side sends no commands. Otherwise this thread would renew the last force
// forever.
void PidDriver::watch_silence(std::int64_t now_ns) noexcept {
  if (!driven_ || now_ns - command_ns_ <= kSilence) return;
  problems_.raise(StickProblem::no_commands, kSilence / 1'000'000);
  end_session();
}

// Invalidates all earlier commands and switches the motors off.
void PidDriver::end_session() noexcept {
  ++state_.session;
  scheduler_.set_command({});
  scheduler_.release();
  watch_.reset_force();
  publish();
}

void PidDriver::watch_arrival(bool has_report, std::int64_t now_ns) noexcept {
  if (has_report) handed_ns_ = now_ns;
  if (has_report && !unarrived_) unarrived_ns_ = now_ns;
  if (has_report && unarrived_ && now_ns - unarrived_ns_ > kUnarrived) problems_.raise(StickProblem::output_stuck);
  unarrived_ = has_report;
}

void PidDriver::on_sent(std::int64_t time_ns) noexcept {
  unarrived_ = false;
  scheduler_.arrived(time_ns);
  watch_slowness(time_ns);
  if (scheduler_.style() != state_.style) state_.style_ns = time_ns;
  state_.style = scheduler_.style();
  state_.sent_ns = time_ns;
  ++state_.outputs;
  publish();
}

// A wall that is stable at the calibrated answer time can vibrate on a slower stick, so the motors are switched off if
// most outputs within half a second are late. A single late output proves nothing.
void PidDriver::watch_slowness(std::int64_t now_ns) noexcept {
  const std::int64_t transfer = now_ns - handed_ns_, answer = answer_ns_.load(std::memory_order_relaxed);
  ++arrivals_.all;
  arrivals_.transfer_ns += transfer;
  if (transfer > 2 * answer + kMillisecond) ++arrivals_.late;
  if (now_ns - arrivals_.since_ns < kSlowness || arrivals_.all < kMinArrivals) return;
  const Arrivals window = std::exchange(arrivals_, {now_ns, 0, 0, 0});
  if (!driven_ || answer == 0 || 2 * window.late <= window.all) return;
  problems_.raise(StickProblem::slow_output, window.transfer_ns / window.all / kMillisecond,
                  (answer + kMillisecond - 1) / kMillisecond);
  end_session();
}

void PidDriver::publish() noexcept {
  state_.sent = scheduler_.force();
  state_.spring = scheduler_.spring();
  state_.damper = scheduler_.damper();
  state_.doubt = scheduler_.doubt();
  state_.actuators = scheduler_.drives();
  states_.write(state_);
}

StickState PidDriver::state() noexcept {
  states_.update();
  return states_.value();
}

void PidDriver::command(const StickCommand& command) noexcept {
  post_command(is_number(command) ? command : StickCommand{});
}

void PidDriver::release() noexcept {
  releases_.store(++released_, std::memory_order_release);
  post_command({});
  wake();
}

void PidDriver::post_command(const StickCommand& command) noexcept {
  const Command newest{command, states_.value().session, released_};
  const bool is_new = newest.command != last_command_.command || newest.session != last_command_.session;
  last_command_ = newest;
  commands_.write(newest);
  if (is_new) wake();
}

// This write does not block. It fails only if the counter of the eventfd is full, and then the reader wakes up anyway.
void PidDriver::wake() const noexcept {
  const std::uint64_t one = 1;
  [[maybe_unused]] const ssize_t written = write(wake_fd_, &one, sizeof one);
}

}  // namespace gearshift::haptics
