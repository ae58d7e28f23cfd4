#include "haptics/hardware/pid_driver.h"

#include <sys/eventfd.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace gearshift {
namespace {

constexpr std::int64_t kSilence = static_cast<std::int64_t>(1e9 * kCommandSilence);  // [ns]
constexpr std::int64_t kMillisecond = 1'000'000;                                     // [ns]
constexpr std::int64_t kUnarrived = 100 * kMillisecond;                              // [ns] under way: it takes none
constexpr std::int64_t kSlowness = 500 * kMillisecond;                               // [ns] over which it is judged
constexpr std::int64_t kFewestArrivals = 5;

LeverReport lever_of(const ReportDescriptor& descriptor) {
  if (std::optional<LeverReport> lever = find_lever_report(descriptor)) return *std::move(lever);
  throw HidError("this device is no stick: its descriptor has no axes X and Y");
}

PidLayout pid_of(const ReportDescriptor& descriptor) {
  if (const std::optional<PidLayout> pid = find_pid(descriptor)) return *pid;
  throw HidError("this stick has no force feedback: its descriptor has no reports that push (PID class)");
}

std::array<std::size_t, 2> stick_axes(const LeverReport& lever) {
  std::array<std::size_t, 2> found{};
  for (std::size_t i = 0; i < lever.axes.size(); ++i) {
    if (lever.axes[i].usage == kUsageX) found[0] = i;
    if (lever.axes[i].usage == kUsageY) found[1] = i;
  }
  return found;
}

// What is no number drives nothing.
bool is_number(const PidWish& wish) noexcept {
  bool finite = std::isfinite(wish.constant[0]) && std::isfinite(wish.constant[1]);
  for (const double damper : wish.damper) finite = finite && std::isfinite(damper);
  for (const PidSpring& spring : wish.spring) {
    finite = finite && std::isfinite(spring.centre) && std::isfinite(spring.dead_band) &&
             std::isfinite(spring.coefficient) && std::isfinite(spring.saturation);
  }
  return finite;
}

}  // namespace

PidDriver::PidDriver(const std::vector<std::uint8_t>& report_descriptor)
    : descriptor_(parse_report_descriptor(report_descriptor)),
      lever_(lever_of(descriptor_)),
      pid_(pid_of(descriptor_)),
      wake_fd_(eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC)),
      stream_(pid_),
      watch_(lever_, stick_axes(lever_)) {
  for (std::size_t id = 0; id < input_size_.size(); ++id) {
    input_size_[id] = descriptor_.report_size(ReportKind::input, static_cast<std::uint8_t>(id));
  }
  stream_.begin(blocks_, true);
}

PidDriver::~PidDriver() {
  if (wake_fd_ >= 0) close(wake_fd_);
}

PidAbility PidDriver::prepare(HidPort& port) {
  end_.store(false, std::memory_order_relaxed);
  prepared_ = false;
  PreparedStick prepared = prepare_stick(port, pid_);
  problems_.forget();
  blocks_ = prepared.blocks;
  stream_.begin(blocks_, prepared.ability.finite);
  watch_ = InputWatch(lever_, stick_axes(lever_));
  driven_ = unarrived_ = false;
  arrivals_ = {};
  prepared_ = true;
  ++sight_.session;
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
  quiet_stick(port, pid_, blocks_);
  blocks_ = {};
  prepared_ = false;
  stream_.begin(blocks_, true);
  publish();
}

void PidDriver::on_input(std::span<const std::uint8_t> report, std::int64_t time_ns) noexcept {
  if (report.empty()) return;
  const std::size_t expected = input_size_[report[0]];
  if (expected == 0) return problems_.raise(StickProblem::unknown_report, report[0]);
  if (report.size() != expected) {
    return problems_.raise(StickProblem::wrong_length, static_cast<std::int64_t>(report.size()),
                           static_cast<std::int64_t>(expected));
  }
  if (const std::optional<LeverCounts> counts = decode_lever(lever_, report)) see_lever(*counts, time_ns);
  if (const std::optional<PidStatus> status = decode_state(pid_, report)) hear_state(*status, time_ns);
}

// A dead sensor must not be taken for a live one: its readings do not count.
void PidDriver::see_lever(const LeverCounts& counts, std::int64_t time_ns) noexcept {
  watch_.see(counts, stream_.force(), stream_.spring(), time_ns);
  if (watch_.jump() > 0.0) problems_.raise(StickProblem::jumps, std::lround(100.0 * watch_.jump()));
  if (watch_.is_frozen()) return problems_.raise(StickProblem::frozen, std::lround(kFrozenTime));
  if (watch_.has_yielded()) {
    problems_.raise(StickProblem::yields, std::lround(kFrozenTime + kYieldTime));
    end_session();
  }
  ++sight_.sequence;
  sight_.time_ns = time_ns;
  sight_.counts = counts;
  publish();
}

// What protected itself is not overruled: its motors stay off until a person has armed it again.
void PidDriver::hear_state(const PidStatus& status, std::int64_t time_ns) noexcept {
  switch (stream_.heard(status, time_ns)) {
    case StickLapse::none:
      return;
    case StickLapse::effect_stopped:
      problems_.raise(StickProblem::effect_stopped);
      return publish();
    case StickLapse::switched_off:
      problems_.raise(StickProblem::switched_off);
      break;
    case StickLapse::no_power:
      problems_.raise(StickProblem::no_power);
      break;
    case StickLapse::safety_switch:
      problems_.raise(StickProblem::safety_switch);
      break;
  }
  end_session();
}

HidBytes PidDriver::next_output(std::int64_t now_ns) noexcept {
  obey(now_ns);
  watch_silence(now_ns);
  const HidBytes report = stream_.next(now_ns);
  watch_arrival(report.size > 0, now_ns);
  return report;
}

// A release voids every order that does not know of it.
void PidDriver::obey(std::int64_t now_ns) noexcept {
  if (orders_.update()) ordered_ns_ = now_ns;
  const std::uint64_t releases = releases_.load(std::memory_order_acquire);
  if (releases != obeyed_releases_) stream_.release();
  obeyed_releases_ = releases;
  const Order& order = orders_.value();
  const bool counts = prepared_ && order.session == sight_.session && order.releases == releases;
  driven_ = counts && order.wish.enabled;
  PidWish wish = counts ? order.wish : PidWish{};
  for (std::size_t i = 0; i < 2; ++i) {  // its own walls, too: they are as blind as its sensor
    wish.constant[i] *= watch_.force_share(i);
    wish.spring[i].coefficient *= watch_.force_share(i);
  }
  stream_.want(wish);
}

// The haptic side is late or dead, and this thread is not: a renewed force would stay for ever.
void PidDriver::watch_silence(std::int64_t now_ns) noexcept {
  if (!driven_ || now_ns - ordered_ns_ <= kSilence) return;
  problems_.raise(StickProblem::nobody_commands, kSilence / 1'000'000);
  end_session();
}

// What was wished drives nothing any more.
void PidDriver::end_session() noexcept {
  ++sight_.session;
  stream_.want({});
  stream_.release();
  watch_.forget_force();
  publish();
}

void PidDriver::watch_arrival(bool anything, std::int64_t now_ns) noexcept {
  if (anything) handed_ns_ = now_ns;
  if (anything && !unarrived_) unarrived_ns_ = now_ns;
  if (anything && unarrived_ && now_ns - unarrived_ns_ > kUnarrived) problems_.raise(StickProblem::takes_no_output);
  unarrived_ = anything;
}

void PidDriver::on_sent(std::int64_t time_ns) noexcept {
  unarrived_ = false;
  stream_.arrived(time_ns);
  watch_slowness(time_ns);
  sight_.sent_ns = time_ns;
  ++sight_.outputs;
  publish();
}

// What is admitted on a prompt stick shakes on a slow one. Most outputs of half a second: one that is late says nothing.
void PidDriver::watch_slowness(std::int64_t now_ns) noexcept {
  const std::int64_t took = now_ns - handed_ns_, answer = answer_ns_.load(std::memory_order_relaxed);
  ++arrivals_.all;
  arrivals_.took_ns += took;
  if (took > 2 * answer + kMillisecond) ++arrivals_.late;
  if (now_ns - arrivals_.since_ns < kSlowness || arrivals_.all < kFewestArrivals) return;
  const Arrivals judged = std::exchange(arrivals_, {now_ns, 0, 0, 0});
  if (!driven_ || answer == 0 || 2 * judged.late <= judged.all) return;
  problems_.raise(StickProblem::slower, judged.took_ns / judged.all / kMillisecond,
                  (answer + kMillisecond - 1) / kMillisecond);
  end_session();
}

void PidDriver::publish() noexcept {
  sight_.sent = stream_.force();
  sight_.spring = stream_.spring();
  sight_.actuators = stream_.drives();
  sights_.write(sight_);
}

PidSight PidDriver::see() noexcept {
  sights_.update();
  return sights_.value();
}

void PidDriver::wish(const PidWish& wish) noexcept {
  order(is_number(wish) ? wish : PidWish{});
}

void PidDriver::release() noexcept {
  releases_.store(++released_, std::memory_order_release);
  order({});
  wake();
}

void PidDriver::order(const PidWish& wish) noexcept {
  const Order order{wish, sights_.value().session, released_};
  const bool is_new = order.wish != last_order_.wish || order.session != last_order_.session;
  last_order_ = order;
  orders_.write(order);
  if (is_new) wake();
}

// It does not block: full, it wakes all the same.
void PidDriver::wake() const noexcept {
  const std::uint64_t one = 1;
  [[maybe_unused]] const ssize_t written = write(wake_fd_, &one, sizeof one);
}

}  // namespace gearshift
