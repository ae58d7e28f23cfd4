#include "app/tour/held_tour.h"

#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "app/devices/stop_signals.h"
#include "app/event_words.h"
#include "app/program_name.h"
#include "app/trainer/trainer.h"
#include "haptics/files/file_error.h"
#include "haptics/loop/shift_script.h"

namespace gearshift {
namespace {

constexpr double kLookEvery = 0.02;                 // [s]
constexpr double kOpeningTakes = 2.0;               // [s] at most, where it is plugged in
constexpr std::int64_t kArmingTakes = 100'000'000;  // [ns] at most, until the loop has taken it

TrainerConfig trainer_config(const TourSetup& setup, StickLever& stick) {
  TrainerConfig config;
  config.layout = setup.layout;
  config.preset.haptics = setup.haptics;
  config.lever = [&stick](double period) { return stick.lever(period); };
  config.program = program_name();
  return config;
}

bool is_off(GuardState state) {
  return state == GuardState::idle || state == GuardState::damped || state == GuardState::released;
}

// As who holds the stick understands it.
const char* reason_words(GuardFault fault) {
  if (fault == GuardFault::stale_reading) return "no readings of the stick arrive";
  return fault == GuardFault::overruns ? "the computer was too late" : guard_fault_name(fault);
}

// [ns] Of the loop that runs.
std::int64_t first_cycle_of(Trainer& trainer) {
  const HapticSnapshot now = trainer.snapshot();
  const std::int64_t period = period_ns(trainer.config().preset.haptics);
  return now.time_ns - static_cast<std::int64_t>(now.cycle) * period;
}

// One look after another, until the drive is over.
class HeldDrive {
 public:
  HeldDrive(Trainer& trainer, StickLever& stick, Answers& answers, const TourWords& say, TourResult& result)
      : trainer_(trainer),
        stick_(stick),
        answers_(answers),
        say_(say),
        result_(result),
        begin_ns_(first_cycle_of(trainer)) {}

  void begin() {
    std::string order;
    for (const int gear : result_.wanted) order += fmt::format("{}{}", order.empty() ? "" : ", ", gear_name(gear));
    say_(fmt::format("The tour: {}.", order));
  }

  void look() {
    take_answer();
    follow_stick();
    const HapticSnapshot now = trainer_.snapshot();  // before the events: of a fall these tell
    follow_lever();
    watch_arming(now);
    if (const std::optional<std::string> problem = trainer_.take_recording_problem()) {
      (void)trainer_.stop_recording();
      throw std::runtime_error(*problem);
    }
  }

  // Cannot come to its end any more: nobody arms it.
  bool is_lost() const { return answers_.ended() && is_off(trainer_.snapshot().guard) && !armed_; }

 private:
  void ask_to_arm() {
    if (!is_there_ || asked_) return;
    while (answers_.line(0.0)) continue;  // what was said before it was asked for is no answer
    asked_ = true;
    say_("The motors are off. Hold the stick, then press Enter: its forces ramp up.");
  }
  void ask_for_gear() {
    if (next_ < result_.wanted.size()) say_(fmt::format("Shift to {}.", gear_name(result_.wanted[next_])));
  }

  void take_answer() {
    const std::optional<std::string> answer = answers_.line(kLookEvery);
    if (!answer) return;
    if (!stick_.connected()) return say_not_there();
    if (!std::exchange(asked_, false)) return;
    trainer_.arm();
    armed_ = true;
    armed_at_ns_ = trainer_.snapshot().time_ns;
    ask_for_gear();
  }

  // One that is gone has no forces, and none when it comes back.
  void follow_stick() {
    while (const std::optional<std::string> news = stick_.take_news()) {
      say_(*news);
      was_missed_ = true;  // and why is said
    }
    const bool was_there = std::exchange(is_there_, stick_.connected());
    if (was_there && !is_there_) {
      trainer_.stop();
      asked_ = false;
    }
    if (!was_there && is_there_) ask_to_arm();
    if (!is_there_ && !was_missed_ && trainer_.time() > kOpeningTakes) say_not_there();
    was_missed_ = was_missed_ || is_there_ || trainer_.time() > kOpeningTakes;
  }

  void say_not_there() { say_(fmt::format("{} cannot be used yet: plug it in.", stick_.name())); }

  void follow_lever() {
    for (const DriveSample& cycle : trainer_.take_cycles()) {
      if (cycle.lever.time_ns < begin_ns_) continue;
      measure(cycle.lever, result_);
      result_.duration = seconds_at(cycle.lever.time_ns);
    }
    for (const HapticEvent& event : trainer_.take_events())
      if (event.time_ns >= begin_ns_) tell(event);
  }

  // As the table counts: from the recording's first cycle on.
  double seconds_at(std::int64_t time_ns) const { return 1e-9 * static_cast<double>(time_ns - begin_ns_); }

  void tell(const HapticEvent& event) {
    if (event.kind == EventKind::over_push_begin) say_(event_words(event, true));
    if (event.kind == EventKind::gear_engaged) take_gear(event);
    if (event.kind == EventKind::guard_changed) tell_guard(static_cast<GuardState>(static_cast<int>(event.value)));
  }

  void take_gear(const HapticEvent& event) {
    const int gear = static_cast<int>(event.value);
    result_.engaged.push_back({gear, seconds_at(event.time_ns)});
    say_(fmt::format("{} engaged", gear_name(gear)));
    if (next_ == result_.wanted.size() || gear != result_.wanted[next_]) return;
    ++next_;
    if (armed_) ask_for_gear();
  }

  void tell_guard(GuardState state) {
    if (!is_off(state) || !std::exchange(armed_, false)) return;
    say_(fmt::format("forces off: {}", reason_words(trainer_.snapshot().fault)));
    ask_to_arm();
  }

  // Refused in the very cycle that takes it, of which no event tells: its stop button is held, or it lies too far out.
  void watch_arming(const HapticSnapshot& now) {
    if (!armed_ || !is_off(now.guard) || now.time_ns < armed_at_ns_ + kArmingTakes) return;
    armed_ = false;
    const bool is_held = now.fault == GuardFault::stopped;
    say_(fmt::format("no forces: {}", is_held ? "its stop button is held" : reason_words(now.fault)));
    ask_to_arm();
  }

  Trainer& trainer_;
  StickLever& stick_;
  Answers& answers_;
  const TourWords& say_;
  TourResult& result_;
  std::int64_t begin_ns_;
  std::size_t next_ = 0;  // of the gears that are wanted
  bool armed_ = false;    // by a person, and not fallen since
  std::int64_t armed_at_ns_ = 0;
  bool is_there_ = false;
  bool was_missed_ = false;  // and it was said; or has been there
  bool asked_ = false;       // to arm, and not answered yet
};

void drive(Trainer& trainer, StickLever& stick, double seconds, Answers& answers, const TourWords& say,
           TourResult& result) {
  HeldDrive held(trainer, stick, answers, say, result);
  held.begin();
  while (!result.came_in_order() && trainer.time() < seconds && !StopSignals::asked()) {
    held.look();
    if (held.is_lost()) throw std::runtime_error("nobody can arm the stick: standard input is at its end");
  }
  trainer.disarm();
}

}  // namespace

TourResult drive_held_tour(TourSetup& setup, StickLever& stick, double seconds, Answers& answers, const TourWords& say,
                           const TourProgress& progress) {
  Trainer trainer(trainer_config(setup, stick));
  setup.gate = trainer.gate();
  TourResult result;
  result.wanted = tour_order(setup.gate);
  result.limited = trainer.admitted().limited;
  result.admitted = result.softest = trainer.admitted().tuning.wall_stiffness;
  const std::filesystem::path trace = setup.folder / "tour.trace";
  trainer.start_recording(trace);
  drive(trainer, stick, seconds, answers, say, result);
  if (const std::optional<std::string> problem = trainer.stop_recording()) throw FileError(trace.string(), 0, *problem);
  result.hash = write_tour_table(setup.folder, progress);
  return result;
}

}  // namespace gearshift
