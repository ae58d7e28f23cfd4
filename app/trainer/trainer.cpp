#include "app/trainer/trainer.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <stdexcept>
#include <thread>
#include <utility>

#include "app/trainer/cycle_runner.h"
#include "app/trainer/driver_seat.h"
#include "app/trainer/driver_thread.h"
#include "app/trainer/given_hand.h"
#include "app/trainer/loop_run.h"
#include "haptics/device/led_hand.h"
#include "haptics/device/simulated_lever.h"
#include "haptics/gate/gate_compiler.h"
#include "haptics/joystick/kinematics.h"
#include "haptics/loop/trace_recorder.h"
#include "haptics/rt/realtime_thread.h"

namespace gearshift {
namespace {

constexpr std::uint64_t kServeEvery = 1000;  // [cycles] of the virtual clock; the queues hold eight times that
constexpr std::chrono::microseconds kLookEvery{
    100};  // for the next cycle of a thread that has a period of 250 us or more

TrainerConfig checked(TrainerConfig config) {
  check_config(config.preset.haptics);
  if (config.lever && config.driver)
    throw std::invalid_argument(
        "a hand that drives by itself has the simulated lever alone: a stick is held by a person");
  HandImpedance& hand = config.preset.lever.hand;
  hand = leading_hand(hand);
  return config;
}

constexpr std::int64_t kMostPeriods = 11;  // of a pause: no more than the loop's world catches up, feet neither

// Null: the simulated one.
std::unique_ptr<HapticDevice> made_lever(const TrainerConfig& config) {
  return config.lever ? config.lever(period_s(config.preset.haptics)) : nullptr;
}

// As far as the lever reaches: on a yoke's sphere, or in the plane.
Gate gate_for(const TrainerConfig& config, const HapticDevice* made) {
  const YokeGeometry& yoke = config.preset.lever.yoke;
  if (made == nullptr) return compile_gate(config.layout, workspace_half_extent(yoke), yoke.radius);
  const DeviceSpec& spec = made->spec();
  return compile_gate(config.layout, spec.workspace, spec.yoke_radius > 0.0 ? spec.yoke_radius : HUGE_VAL);
}

std::unique_ptr<CarWorld> make_car(const TrainerConfig& config, const Gate& gate, const DeviceSpec& device,
                                   const CarStart& from) {
  if (!config.car) return nullptr;
  return std::make_unique<CarWorld>(*config.car, gate, device.max_force.y, from, config.seed);
}

}  // namespace

Gate check_trainer(const TrainerConfig& wanted) {
  const TrainerConfig config = checked(wanted);
  const std::unique_ptr<HapticDevice> made = made_lever(config);
  const Gate gate = gate_for(config, made.get());
  RestingHand nobody;
  std::optional<SimulatedLever> simulated;
  if (!made) simulated.emplace(config.preset.lever, period_ns(config.preset.haptics), nobody);
  HapticDevice& lever = made ? *made : *simulated;
  const LoopRun run(config.preset.haptics, gate, lever, make_car(config, gate, lever.spec(), config.start));
  return gate;
}

struct Trainer::State {
  explicit State(const TrainerConfig& wanted);
  ~State();

  std::unique_ptr<HandDriver> make_hand();
  DriverAction at_rest() const;
  std::unique_ptr<LoopRun> make_run();
  glm::dvec2 start_position() const { return rest_position(gate, config.start.gear); }
  HapticConfig as_it_runs() const;
  TraceHeader header(const char* world, bool armed) const;
  bool waits_for_person() const;
  void hand_over(std::unique_ptr<LoopRun> next);
  void begin();
  bool acts() const { return driver || feet; }
  void act(const DriveSample& cycle);
  void cycle_once();
  void serve();
  void take_snapshot();
  void take_records();
  void take_events();
  void send(LoopCommand command);

  bool is_virtual() const { return config.clock == TrainerClock::virtual_time; }
  std::int64_t now_ns() const { return is_virtual() ? virtual_ns : runner.now_ns(); }

  TrainerConfig config;
  const SelfDriver driver;
  const PersonFeet feet;
  std::int64_t period_ns;
  std::unique_ptr<HapticDevice> made;  // null: simulated
  Gate gate;
  DriverSeat seat;
  std::unique_ptr<HandDriver> hand;  // of the simulated one
  std::unique_ptr<SimulatedLever> simulated;
  HapticDevice& lever;
  std::unique_ptr<LoopRun> run;
  AdmittedTuning admitted;
  CycleRunner runner;
  std::optional<std::int64_t> acted_ns;       // [ns] of the last cycle that the feet have seen
  std::optional<DriverThread> driver_thread;  // of the real clock
  std::unique_ptr<TraceRecorder> recorder;
  RealtimeThread thread;

  // The frame's own.
  HapticSnapshot newest;
  std::vector<DriveSample> cycles;  // not taken yet
  std::vector<HapticEvent> events;
  DurationHistogram lateness;
  std::uint64_t events_lost = 0;      // in the loops before this one
  bool wants_forces = false;          // the last of arm, disarm and stop
  std::int64_t start_ns = 0;          // [ns] on the loop's clock, a period before the first cycle
  std::int64_t virtual_ns = 0;        // [ns] of the last cycle
  double owed = 0.0;                  // [s] asked for by advance() and less than a period
  std::uint64_t unserved_cycles = 0;  // of the virtual clock
};

Trainer::State::State(const TrainerConfig& wanted)
    : config(checked(wanted)),
      driver(config.driver),
      feet(config.driver ? PersonFeet{} : config.feet),
      period_ns(gearshift::period_ns(config.preset.haptics)),
      made(made_lever(config)),
      gate(gate_for(config, made.get())),
      seat(static_cast<bool>(config.driver), at_rest()),
      hand(made ? nullptr : make_hand()),
      simulated(made ? nullptr : std::make_unique<SimulatedLever>(config.preset.lever, period_ns, *hand)),
      lever(made ? *made : *simulated),
      run(std::make_unique<LoopRun>(config.preset.haptics, gate, lever,
                                    make_car(config, gate, lever.spec(), config.start))),
      admitted(run->loop.admitted()),
      runner(period_ns) {
  const glm::dvec2 start = start_position();
  if (simulated) simulated->place(start);
  newest.lever = newest.proxy = start;
  newest.wall_stiffness = admitted.tuning.wall_stiffness;
  if (run->car() != nullptr) runner.car.write(run->car()->state());
  if (feet) seat.press(feet({}, 0.0));
  seat.connect(run->channels);
  begin();
}

Trainer::State::~State() {
  thread.stop();
  lever.release();
}

std::unique_ptr<HandDriver> Trainer::State::make_hand() {
  if (driver) return std::make_unique<GivenHand>(seat.hand());
  return std::make_unique<LedHand>(seat.hand(), period_s(config.preset.haptics));
}

// Until somebody leads and drives.
DriverAction Trainer::State::at_rest() const {
  DriverAction action;
  action.hand.position = start_position();
  action.controls.ignition = config.car && config.start.running;
  action.controls.hand_brake = config.hand_brake;
  return action;
}

// The next one: the car goes on.
std::unique_ptr<LoopRun> Trainer::State::make_run() {
  runner.car.update();
  const CarStart from = start_from(runner.car.value());
  return std::make_unique<LoopRun>(as_it_runs(), gate, lever, make_car(config, gate, lever.spec(), from));
}

void Trainer::State::begin() {
  runner.hand_over(*run);
  if (is_virtual()) {
    start_ns = virtual_ns = -period_ns;
    return;
  }
  if (acts()) {
    runner.for_driver = std::make_unique<SpscQueue<DriveSample>>(CycleRunner::kMostForDriver);
    driver_thread.emplace([this](const DriveSample& cycle) { act(cycle); }, *runner.for_driver);
  }
  RealtimeConfig realtime;
  realtime.period_ns = period_ns;
  thread.start(realtime, [this](const CycleCall& call) { runner.cycle(call, &thread.statistics()); });
  while (!runner.has_run(*run)) std::this_thread::sleep_for(kLookEvery);
  take_snapshot();
  start_ns = newest.time_ns - period_ns;
}

// The tuning that was wanted last, under the hold that runs: what change_tuning() admitted is admitted again.
HapticConfig Trainer::State::as_it_runs() const {
  HapticConfig haptics = config.preset.haptics;
  haptics.contact.hold = admitted.hold;
  return haptics;
}

TraceHeader Trainer::State::header(const char* world, bool armed) const {
  return {config.program, as_it_runs(), lever.spec(), config.layout.file, config.layout.text, world, armed};
}

// A fault has taken the forces, and only a person may give them back: HapticLoop::watch_guard has the same law.
bool Trainer::State::waits_for_person() const {
  const bool may_rearm = lever.spec().simulated && newest.fault != GuardFault::chatter;
  return newest.guard == GuardState::released || (newest.guard == GuardState::damped && !may_rearm);
}

// Returns when the next loop has run its first cycle: what is sent from then on goes to it, and its recording is whole.
// A fault of the old loop after the next one was made ends that one's forces, too: they have hardly begun to ramp up.
void Trainer::State::hand_over(std::unique_ptr<LoopRun> next) {
  seat.connect(next->channels);
  runner.hand_over(*next);
  if (is_virtual()) {
    cycle_once();
    owed -= 1e-9 * static_cast<double>(period_ns);
  }
  while (!runner.has_run(*next)) std::this_thread::sleep_for(kLookEvery);
  take_events();
  events_lost += run->channels.events_lost.load();
  take_snapshot();
  run = std::move(next);
  if (!wants_forces || !waits_for_person()) return;
  wants_forces = false;
  send(LoopCommand::stop);
}

// On the virtual clock's thread, or on the driver's.
void Trainer::State::act(const DriveSample& cycle) {
  if (driver) return seat.act(driver(cycle));
  const std::int64_t before_ns = std::exchange(acted_ns, cycle.lever.time_ns).value_or(cycle.lever.time_ns);
  const std::int64_t passed_ns = std::min(cycle.lever.time_ns - before_ns, kMostPeriods * period_ns);
  seat.press(feet(cycle, 1e-9 * static_cast<double>(passed_ns)));
}

void Trainer::State::cycle_once() {
  virtual_ns += period_ns;
  runner.cycle({virtual_ns, 0}, nullptr);
  if (acts()) act(runner.newest());
  if (++unserved_cycles >= kServeEvery) serve();
}

// What a thread or a frame would do meanwhile.
void Trainer::State::serve() {
  unserved_cycles = 0;
  if (recorder) recorder->pump();
  take_records();
  take_events();
}

void Trainer::State::take_snapshot() {
  if (run->channels.snapshot.update()) newest = run->channels.snapshot.value();
}

void Trainer::State::take_records() {
  for (CycleRecord record; runner.records.pop(record);) {
    if (cycles.size() < CycleRunner::kMostRecords) cycles.push_back(record.sample);
    lateness.add(record.late_ns);
  }
}

void Trainer::State::take_events() {
  for (HapticEvent event; run->channels.events.pop(event);) events.push_back(event);
}

// Commands wait for the cycle that takes them, one each. Where so many wait that the queue is full, the oldest are void
// on a clock that stands; a thread takes one within a period.
void Trainer::State::send(LoopCommand command) {
  while (!run->channels.commands.push(command)) {
    LoopCommand oldest;
    if (is_virtual())
      (void)run->channels.commands.pop(oldest);
    else
      std::this_thread::sleep_for(kLookEvery);
  }
}

Trainer::Trainer(const TrainerConfig& config) : state_(std::make_unique<State>(config)) {}
Trainer::~Trainer() = default;

const TrainerConfig& Trainer::config() const noexcept {
  return state_->config;
}

const Gate& Trainer::gate() const noexcept {
  return state_->gate;
}

const DeviceSpec& Trainer::device() const noexcept {
  return state_->lever.spec();
}

const AdmittedTuning& Trainer::admitted() const noexcept {
  return state_->admitted;
}

HapticSnapshot Trainer::snapshot() {
  state_->take_snapshot();
  return state_->newest;
}

VehicleState Trainer::car() {
  state_->runner.car.update();
  return state_->runner.car.value();
}

std::vector<HapticEvent> Trainer::take_events() {
  state_->take_events();
  return std::exchange(state_->events, {});
}

std::vector<DriveSample> Trainer::take_cycles() {
  state_->take_records();
  return std::exchange(state_->cycles, {});
}

void Trainer::set_hand(const HandTarget& target) {
  state_->seat.set_hand(target);
}

void Trainer::set_controls(const DriverControls& controls) {
  state_->seat.set_controls(controls);
}

AdmittedTuning Trainer::change_tuning(const HapticTuning& wanted) {
  state_->admitted = state_->run->loop.change_tuning(wanted);
  state_->config.preset.haptics.tuning = wanted;
  return state_->admitted;
}

void Trainer::arm() {
  state_->wants_forces = true;
  state_->send(LoopCommand::arm);
}

void Trainer::disarm() {
  state_->wants_forces = false;
  state_->send(LoopCommand::disarm);
}

void Trainer::stop() {
  state_->wants_forces = false;
  state_->send(LoopCommand::stop);
}

LoopHealth Trainer::health() {
  State& s = *state_;
  s.take_records();
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
  health.why_not = s.is_virtual() ? "not real-time: a virtual clock" : s.thread.why_not();
  return health;
}

void Trainer::start_recording(const std::filesystem::path& file) {
  State& s = *state_;
  if (s.recorder) throw std::logic_error("a recording is running already: stop it first");
  s.take_snapshot();
  std::unique_ptr<LoopRun> next = s.make_run();
  // As the person wants it: a command that the loop has not taken yet counts already.
  const bool armed = s.wants_forces && !s.waits_for_person();
  if (armed) next->loop.arm();
  const TracePump pump = s.is_virtual() ? TracePump::by_caller : TracePump::own_thread;
  s.recorder = std::make_unique<TraceRecorder>(file, s.header(next->world().name(), armed), next->channels, pump);
  s.wants_forces = armed;
  s.hand_over(std::move(next));
}

std::optional<std::string> Trainer::take_recording_problem() {
  return state_->recorder ? state_->recorder->take_problem() : std::nullopt;
}

std::optional<std::string> Trainer::stop_recording() {
  if (!state_->recorder) return std::nullopt;
  const RecordingResult result = state_->recorder->finish();
  state_->recorder.reset();
  return result.problem.empty() ? std::nullopt : std::optional(result.problem);
}

bool Trainer::recording() const noexcept {
  return state_->recorder != nullptr;
}

void Trainer::advance(double seconds) {
  State& s = *state_;
  if (!s.is_virtual()) throw std::logic_error("a trainer on the real clock cannot be moved on");
  if (!(seconds > 0.0) || !std::isfinite(seconds)) return;
  const double period = 1e-9 * static_cast<double>(s.period_ns);
  s.owed += seconds;
  const std::int64_t cycles = std::llround(std::floor(s.owed / period + 1e-6));  // a whole number, but for rounding
  for (std::int64_t i = 0; i < cycles; ++i) s.cycle_once();
  s.owed -= static_cast<double>(cycles) * period;
}

double Trainer::time() const noexcept {
  return 1e-9 * static_cast<double>(std::max<std::int64_t>(0, state_->now_ns() - state_->start_ns));
}

}  // namespace gearshift
