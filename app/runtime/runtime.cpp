#include "app/runtime/runtime.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <stdexcept>
#include <thread>
#include <utility>

#include "app/runtime/cycle_runner.h"
#include "app/runtime/driver_thread.h"
#include "app/runtime/exact_hand.h"
#include "app/runtime/input_mixer.h"
#include "app/runtime/runtime_loop.h"
#include "haptics/device/simulated_lever.h"
#include "haptics/device/smoothed_hand.h"
#include "haptics/gate/gate_compiler.h"
#include "haptics/joystick/kinematics.h"
#include "haptics/loop/trace_recorder.h"
#include "haptics/rt/realtime_thread.h"

namespace gearshift::runtime {
namespace {

// [cycles] Interval at which the queues are drained on the virtual clock. Each queue holds about 8 times as many
// cycles.
constexpr std::uint64_t kDrainInterval = 1000;
// Pause between checks whether the haptic thread has run a cycle. The thread's period is at least 250 us.
constexpr std::chrono::microseconds kPollPeriod{100};

RuntimeConfig checked(RuntimeConfig config) {
  haptics::check_config(config.preset.haptics);
  if (config.lever && config.driver)
    throw std::invalid_argument("a simulated driver needs the simulated lever, because a person holds the real stick");
  haptics::HandImpedance& hand = config.preset.lever.hand;
  hand = haptics::leading_hand(hand);
  return config;
}

constexpr std::int64_t kMaxPausePeriods = 11;  // longest time, in periods, by which the pedals advance per cycle

// The real lever; null if the simulated lever is used.
std::unique_ptr<haptics::HapticDevice> make_lever(const RuntimeConfig& config) {
  return config.lever ? config.lever(haptics::period_s(config.preset.haptics)) : nullptr;
}

// The gate, compiled for the range of the lever, which moves on the sphere of a yoke or in a plane.
haptics::Gate gate_for(const RuntimeConfig& config, const haptics::HapticDevice* real_device) {
  const haptics::YokeGeometry& yoke = config.preset.lever.yoke;
  if (real_device == nullptr)
    return haptics::compile_gate(config.layout, haptics::workspace_half_extent(yoke), yoke.radius);
  const haptics::DeviceSpec& spec = real_device->spec();
  return haptics::compile_gate(config.layout, spec.workspace, spec.yoke_radius > 0.0 ? spec.yoke_radius : HUGE_VAL);
}

std::unique_ptr<vehicle::CarLoad> make_car(const RuntimeConfig& config, const haptics::Gate& gate,
                                           const haptics::DeviceSpec& device, const vehicle::CarStart& from) {
  if (!config.car) return nullptr;
  return std::make_unique<vehicle::CarLoad>(*config.car, gate, device.max_force.y, from, config.seed);
}

}  // namespace

haptics::Gate check_runtime(const RuntimeConfig& wanted) {
  const RuntimeConfig config = checked(wanted);
  const std::unique_ptr<haptics::HapticDevice> real_device = make_lever(config);
  const haptics::Gate gate = gate_for(config, real_device.get());
  haptics::IdleHand idle_hand;
  std::optional<haptics::SimulatedLever> simulated;
  if (!real_device) simulated.emplace(config.preset.lever, haptics::period_ns(config.preset.haptics), idle_hand);
  haptics::HapticDevice& lever = real_device ? *real_device : *simulated;
  const LoopRun run(config.preset.haptics, gate, lever, make_car(config, gate, lever.spec(), config.start));
  return gate;
}

struct Runtime::State {
  explicit State(const RuntimeConfig& wanted);
  ~State();

  std::unique_ptr<haptics::HandDriver> make_hand();
  vehicle::DriverAction resting_action() const;
  std::unique_ptr<LoopRun> make_run();
  glm::dvec2 start_position() const { return haptics::rest_position(gate, config.start.gear); }
  haptics::HapticConfig running_config() const;
  haptics::TraceHeader header(const char* replay_parameters, bool armed) const;
  bool requires_manual_arming() const;
  void switch_to(std::unique_ptr<LoopRun> next);
  void begin();
  bool has_driver() const { return driver || feet; }
  void act(const vehicle::DriveSample& cycle);
  void cycle_once();
  void drain_queues();
  void update_snapshot();
  void read_records();
  void drain_events();
  void send(haptics::LoopCommand command);

  bool is_virtual() const { return config.clock == RuntimeClock::virtual_time; }
  std::int64_t now_ns() const { return is_virtual() ? virtual_ns : runner.now_ns(); }

  RuntimeConfig config;
  const DriverFunction driver;
  const PedalSource feet;
  std::int64_t period_ns;
  std::unique_ptr<haptics::HapticDevice> real_device;  // null: the lever is simulated
  haptics::Gate gate;
  InputMixer input;
  std::unique_ptr<haptics::HandDriver> hand;  // the hand that holds the simulated lever
  std::unique_ptr<haptics::SimulatedLever> simulated;
  haptics::HapticDevice& lever;
  std::unique_ptr<LoopRun> run;
  haptics::AdmittedTuning admitted;
  CycleRunner runner;
  std::optional<std::int64_t> acted_ns;       // [ns] time of the last cycle passed to the pedals
  std::optional<DriverThread> driver_thread;  // empty on the virtual clock
  std::unique_ptr<haptics::TraceRecorder> recorder;
  haptics::RealtimeThread thread;

  // The members below are used only by the frame side, i.e. not by the haptic thread.
  haptics::HapticSnapshot newest;
  std::vector<vehicle::DriveSample> cycles;  // not yet returned by drain_cycles()
  std::vector<haptics::HapticEvent> events;
  haptics::DurationHistogram lateness;
  std::uint64_t events_lost = 0;      // number of events lost in earlier loops
  bool wants_forces = false;          // true if the last request was arm(), false after disarm() or stop()
  std::int64_t start_ns = 0;          // [ns] one period before the first cycle, on the loop's clock
  std::int64_t virtual_ns = 0;        // [ns] time of the last cycle on the virtual clock
  double pending_time = 0.0;          // [s] time passed to advance() but not yet simulated, less than one period
  std::uint64_t unserved_cycles = 0;  // number of cycles since the queues were last drained; virtual clock only
};

Runtime::State::State(const RuntimeConfig& wanted)
    : config(checked(wanted)),
      driver(config.driver),
      feet(config.driver ? PedalSource{} : config.feet),
      period_ns(haptics::period_ns(config.preset.haptics)),
      real_device(make_lever(config)),
      gate(gate_for(config, real_device.get())),
      input(static_cast<bool>(config.driver), resting_action()),
      hand(real_device ? nullptr : make_hand()),
      simulated(real_device ? nullptr
                            : std::make_unique<haptics::SimulatedLever>(config.preset.lever, period_ns, *hand)),
      lever(real_device ? *real_device : *simulated),
      run(std::make_unique<LoopRun>(config.preset.haptics, gate, lever,
                                    make_car(config, gate, lever.spec(), config.start))),
      admitted(run->loop.admitted()),
      runner(period_ns) {
  const glm::dvec2 start = start_position();
  if (simulated) simulated->place(start);
  newest.lever = newest.proxy = start;
  newest.wall_stiffness = admitted.tuning.wall_stiffness;
  if (run->car() != nullptr) runner.car.write(run->car()->state());
  if (feet) input.press(feet({}, 0.0));
  input.connect(run->channels);
  begin();
}

Runtime::State::~State() {
  thread.stop();
  lever.release();
}

std::unique_ptr<haptics::HandDriver> Runtime::State::make_hand() {
  if (driver) return std::make_unique<ExactHand>(input.hand());
  return std::make_unique<haptics::SmoothedHand>(input.hand(), haptics::period_s(config.preset.haptics));
}

// Hand and controls that apply until set_hand(), set_controls() or the driver changes them.
vehicle::DriverAction Runtime::State::resting_action() const {
  vehicle::DriverAction action;
  action.hand.position = start_position();
  action.controls.ignition = config.car && config.start.running;
  action.controls.hand_brake = config.hand_brake;
  return action;
}

// Creates the next run, in which the car continues from its current state.
std::unique_ptr<LoopRun> Runtime::State::make_run() {
  runner.car.update();
  const vehicle::CarStart from = vehicle::start_from(runner.car.value());
  return std::make_unique<LoopRun>(running_config(), gate, lever, make_car(config, gate, lever.spec(), from));
}

void Runtime::State::begin() {
  runner.switch_to(*run);
  if (is_virtual()) {
    start_ns = virtual_ns = -period_ns;
    return;
  }
  if (has_driver()) {
    runner.for_driver = std::make_unique<haptics::SpscQueue<vehicle::DriveSample>>(CycleRunner::kMaxForDriver);
    driver_thread.emplace([this](const vehicle::DriveSample& cycle) { act(cycle); }, *runner.for_driver);
  }
  haptics::RealtimeConfig realtime;
  realtime.period_ns = period_ns;
  thread.start(realtime, [this](const haptics::CycleCall& call) { runner.cycle(call, &thread.statistics()); });
  while (!runner.has_run(*run)) std::this_thread::sleep_for(kPollPeriod);
  update_snapshot();
  start_ns = newest.time_ns - period_ns;
}

// The configuration with the tuning as last requested and the contact hold method in use. With the same method, the
// next loop limits the tuning in the same way as change_tuning() did.
haptics::HapticConfig Runtime::State::running_config() const {
  haptics::HapticConfig haptics = config.preset.haptics;
  haptics.contact.hold = admitted.hold;
  return haptics;
}

haptics::TraceHeader Runtime::State::header(const char* replay_parameters, bool armed) const {
  return {config.program,     running_config(),  lever.spec(), config.layout.file,
          config.layout.text, replay_parameters, armed};
}

// True if a fault has ended the forces and only arm() may restore them. HapticLoop::watch_guard() has the same rule.
bool Runtime::State::requires_manual_arming() const {
  const bool may_rearm = lever.spec().simulated && newest.fault != haptics::GuardFault::chatter;
  return newest.guard == haptics::GuardState::released || (newest.guard == haptics::GuardState::damped && !may_rearm);
}

// Replaces the running loop. Returns after the first cycle of the next loop, so that later commands reach that loop and
// its recording misses no cycle. If the old loop had a fault after the next loop was created, the forces of the next
// loop are ended too.
void Runtime::State::switch_to(std::unique_ptr<LoopRun> next) {
  input.connect(next->channels);
  runner.switch_to(*next);
  if (is_virtual()) {
    cycle_once();
    pending_time -= 1e-9 * static_cast<double>(period_ns);
  }
  while (!runner.has_run(*next)) std::this_thread::sleep_for(kPollPeriod);
  drain_events();
  events_lost += run->channels.events_lost.load();
  update_snapshot();
  run = std::move(next);
  if (!wants_forces || !requires_manual_arming()) return;
  wants_forces = false;
  send(haptics::LoopCommand::stop);
}

// Lets the driver or the pedals respond to the cycle. On the virtual clock the frame's thread calls this function,
// otherwise the DriverThread.
void Runtime::State::act(const vehicle::DriveSample& cycle) {
  if (driver) return input.act(driver(cycle));
  const std::int64_t before_ns = std::exchange(acted_ns, cycle.lever.time_ns).value_or(cycle.lever.time_ns);
  const std::int64_t passed_ns = std::min(cycle.lever.time_ns - before_ns, kMaxPausePeriods * period_ns);
  input.press(feet(cycle, 1e-9 * static_cast<double>(passed_ns)));
}

void Runtime::State::cycle_once() {
  virtual_ns += period_ns;
  runner.cycle({virtual_ns, 0}, nullptr);
  if (has_driver()) act(runner.newest());
  if (++unserved_cycles >= kDrainInterval) drain_queues();
}

// Drains the queues on the virtual clock. On the real clock, the frame's thread and the recorder's thread do this.
void Runtime::State::drain_queues() {
  unserved_cycles = 0;
  if (recorder) recorder->pump();
  read_records();
  drain_events();
}

void Runtime::State::update_snapshot() {
  if (run->channels.snapshot.update()) newest = run->channels.snapshot.value();
}

void Runtime::State::read_records() {
  for (CycleRecord record; runner.records.pop(record);) {
    if (cycles.size() < CycleRunner::kMaxRecords) cycles.push_back(record.sample);
    lateness.add(record.late_ns);
  }
}

void Runtime::State::drain_events() {
  for (haptics::HapticEvent event; run->channels.events.pop(event);) events.push_back(event);
}

// Queues the command; the loop processes one command per cycle. If the queue is full on the virtual clock, which may be
// stopped, drops the oldest command. If it is full on the real clock, waits until the loop has processed a command.
void Runtime::State::send(haptics::LoopCommand command) {
  while (!run->channels.commands.push(command)) {
    haptics::LoopCommand oldest;
    if (is_virtual())
      (void)run->channels.commands.pop(oldest);
    else
      std::this_thread::sleep_for(kPollPeriod);
  }
}

Runtime::Runtime(const RuntimeConfig& config) : state_(std::make_unique<State>(config)) {}
Runtime::~Runtime() = default;

const RuntimeConfig& Runtime::config() const noexcept {
  return state_->config;
}

const haptics::Gate& Runtime::gate() const noexcept {
  return state_->gate;
}

const haptics::DeviceSpec& Runtime::device() const noexcept {
  return state_->lever.spec();
}

const haptics::AdmittedTuning& Runtime::admitted() const noexcept {
  return state_->admitted;
}

haptics::HapticSnapshot Runtime::snapshot() {
  state_->update_snapshot();
  return state_->newest;
}

vehicle::VehicleState Runtime::car() {
  state_->runner.car.update();
  return state_->runner.car.value();
}

std::vector<haptics::HapticEvent> Runtime::drain_events() {
  state_->drain_events();
  return std::exchange(state_->events, {});
}

std::vector<vehicle::DriveSample> Runtime::drain_cycles() {
  state_->read_records();
  return std::exchange(state_->cycles, {});
}

void Runtime::set_hand(const haptics::HandTarget& target) {
  state_->input.set_hand(target);
}

void Runtime::set_controls(const haptics::DriverControls& controls) {
  state_->input.set_controls(controls);
}

haptics::AdmittedTuning Runtime::change_tuning(const haptics::HapticTuning& wanted) {
  state_->admitted = state_->run->loop.change_tuning(wanted);
  state_->config.preset.haptics.tuning = wanted;
  return state_->admitted;
}

void Runtime::arm() {
  state_->wants_forces = true;
  state_->send(haptics::LoopCommand::arm);
}

void Runtime::disarm() {
  state_->wants_forces = false;
  state_->send(haptics::LoopCommand::disarm);
}

void Runtime::stop() {
  state_->wants_forces = false;
  state_->send(haptics::LoopCommand::stop);
}

LoopHealth Runtime::health() {
  State& s = *state_;
  s.read_records();
  s.runner.figures.update();
  const LoopFigures& figures = s.runner.figures.value();
  LoopHealth health;
  health.rate = s.config.preset.haptics.rate;
  health.late_p50 = 1e-9 * static_cast<double>(s.lateness.quantile(0.5));
  health.late_p99 = 1e-9 * static_cast<double>(s.lateness.quantile(0.99));
  health.late_worst = 1e-9 * static_cast<double>(s.lateness.max());
  s.lateness = {};
  health.overruns = figures.overruns;
  health.skipped = figures.skipped;
  health.events_lost = s.events_lost + s.run->channels.events_lost.load();
  health.stage_ns = figures.stage_ns;
  health.cycle_ns = figures.cycle_ns;
  health.realtime = s.thread.is_realtime();
  health.not_realtime_reason =
      s.is_virtual() ? "not real-time, because the virtual clock is used" : s.thread.not_realtime_reason();
  return health;
}

void Runtime::start_recording(const std::filesystem::path& file) {
  State& s = *state_;
  if (s.recorder) throw std::logic_error("a recording is already running; stop it first");
  s.update_snapshot();
  std::unique_ptr<LoopRun> next = s.make_run();
  // Forces that were requested count as on even if the loop has not processed the command yet.
  const bool armed = s.wants_forces && !s.requires_manual_arming();
  if (armed) next->loop.arm();
  const haptics::TracePump pump = s.is_virtual() ? haptics::TracePump::by_caller : haptics::TracePump::by_recorder;
  s.recorder = std::make_unique<haptics::TraceRecorder>(file, s.header(next->load().replay_parameters(), armed),
                                                        next->channels, pump);
  s.wants_forces = armed;
  s.switch_to(std::move(next));
}

std::optional<std::string> Runtime::poll_recording_problem() {
  return state_->recorder ? state_->recorder->take_problem() : std::nullopt;
}

std::optional<std::string> Runtime::stop_recording() {
  if (!state_->recorder) return std::nullopt;
  const haptics::RecordingResult result = state_->recorder->finish();
  state_->recorder.reset();
  return result.problem.empty() ? std::nullopt : std::optional(result.problem);
}

bool Runtime::is_recording() const noexcept {
  return state_->recorder != nullptr;
}

void Runtime::advance(double seconds) {
  State& s = *state_;
  if (!s.is_virtual()) throw std::logic_error("advance() works only with the virtual clock");
  if (!(seconds > 0.0) || !std::isfinite(seconds)) return;
  const double period = 1e-9 * static_cast<double>(s.period_ns);
  s.pending_time += seconds;
  // The small margin prevents a rounding error from dropping a cycle.
  const std::int64_t cycles = std::llround(std::floor(s.pending_time / period + 1e-6));
  for (std::int64_t i = 0; i < cycles; ++i) s.cycle_once();
  s.pending_time -= static_cast<double>(cycles) * period;
}

double Runtime::time() const noexcept {
  return 1e-9 * static_cast<double>(std::max<std::int64_t>(0, state_->now_ns() - state_->start_ns));
}

}  // namespace gearshift::runtime
