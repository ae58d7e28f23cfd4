#include "app/runtime/runtime.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <mutex>
#include <stdexcept>
#include <thread>
#include <utility>

#include "app/runtime/cycle_runner.h"
#include "app/runtime/exact_hand.h"
#include "app/runtime/stream_thread.h"
#include "haptics/device/simulated_lever.h"
#include "haptics/device/smoothed_hand.h"
#include "haptics/gate/gate_compiler.h"
#include "haptics/joystick/kinematics.h"
#include "haptics/loop/trace_recorder.h"
#include "haptics/rt/realtime_thread.h"

namespace gearshift::runtime {
namespace {

// [cycles] Interval at which the stream is read on the virtual clock. The stream holds about 8 times as many cycles.
constexpr std::uint64_t kReadInterval = 1000;
// Intervals at which the threads of driver and recorder poll the stream, which holds the cycles of two seconds or more.
constexpr std::chrono::microseconds kDriverInterval{250}, kRecorderInterval{20'000};
// Pause between checks whether the haptic thread has run a cycle. The thread's period is at least 250 us.
constexpr std::chrono::microseconds kPollPeriod{100};
constexpr std::size_t kStamps = 16;  // stamped cycles over which LoopHealth::stage_ns is averaged

RuntimeConfig checked(RuntimeConfig config) {
  haptics::check_config(config.preset.haptics);
  if (config.lever && config.driver)
    throw std::invalid_argument("a simulated driver needs the simulated lever, because a person holds the real stick");
  haptics::HandImpedance& hand = config.preset.lever.hand;
  hand = haptics::leading_hand(hand);
  return config;
}

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
                                           const haptics::DeviceSpec& device, const vehicle::CarStart& from,
                                           const haptics::Pedals& keyboard) {
  if (!config.car) return nullptr;
  auto car =
      std::make_unique<vehicle::CarLoad>(*config.car, gate, device.max_force.y, from, config.seed, config.pedal_timing);
  car->place_pedals(keyboard);
  return car;
}

std::unique_ptr<haptics::LeverLoad> make_other_load(const RuntimeConfig& config, const haptics::Gate& gate,
                                                    const haptics::DeviceSpec& device) {
  return config.load ? config.load(gate, device) : nullptr;
}

// Combines the driver's controls with the instructor's slope and guidance.
haptics::DriverControls merged(const haptics::DriverControls& driver,
                               const haptics::DriverControls& instructor) noexcept {
  haptics::DriverControls both = driver;
  both.slope = instructor.slope;
  both.guided_gear = instructor.guided_gear;
  both.guidance = instructor.guidance;
  return both;
}

}  // namespace

// Selects the hand and the controls that the lever receives: the user's or, if a driver function drives, the driver's
// with the instructor's slope and guidance.
//
// This class is the only writer of the hand's target and of the controls. The frame's thread and the driver's thread
// call it, one at a time. The haptic thread reads the newest values and never waits.
class InputMixer {
 public:
  // `driven`: a driver function drives. `first`, `keys`: initial hand, controls and pedal keys. `inputs` receives the
  // controls and must outlive this object.
  InputMixer(bool driven, const vehicle::DriverAction& first, const haptics::PedalKeys& keys,
             haptics::LoopInputs& inputs)
      : driven_(driven), controls_(first.controls), inputs_(inputs), hand_(first.hand) {
    inputs_.controls.write(controls_);
    if (!driven_) inputs_.pedal_keys.write(keys);
  }

  void set_hand(const haptics::HandTarget& target) {
    const std::lock_guard lock(mutex_);
    if (!driven_) hand_.write(target);
  }

  void set_controls(const haptics::DriverControls& controls, const haptics::PedalKeys& keys) {
    const std::lock_guard lock(mutex_);
    controls_ = driven_ ? merged(controls_, controls) : controls;
    inputs_.controls.write(controls_);
    if (!driven_) inputs_.pedal_keys.write(keys);
  }

  // The driver function's hand and controls.
  void act(const vehicle::DriverAction& action) {
    const std::lock_guard lock(mutex_);
    hand_.write(action.hand);
    controls_ = merged(action.controls, controls_);
    inputs_.controls.write(controls_);
  }

  haptics::LatestValue<haptics::HandTarget>& hand() noexcept { return hand_; }  // read by the device's hand

 private:
  const bool driven_;
  std::mutex mutex_;  // guards everything below
  haptics::DriverControls controls_;
  haptics::LoopInputs& inputs_;
  haptics::LatestValue<haptics::HandTarget> hand_;
};

haptics::Gate check_runtime(const RuntimeConfig& wanted) {
  const RuntimeConfig config = checked(wanted);
  const std::unique_ptr<haptics::HapticDevice> real_device = make_lever(config);
  const haptics::Gate gate = gate_for(config, real_device.get());
  haptics::IdleHand idle_hand;
  std::optional<haptics::SimulatedLever> simulated;
  if (!real_device) simulated.emplace(config.preset.lever, haptics::period_ns(config.preset.haptics), idle_hand);
  haptics::HapticDevice& lever = real_device ? *real_device : *simulated;
  haptics::LoopInputs inputs;
  const LoopRun run(config.preset.haptics, gate, lever, inputs, 1,
                    make_car(config, gate, lever.spec(), config.start, config.keyboard), haptics::kNeutralGear,
                    make_other_load(config, gate, lever.spec()));
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
  bool has_lost_forces(const CycleRecord& record) const;
  bool wants_forces_after(ForceCause cause) const;
  bool notice_fault(const CycleRecord& record);
  void switch_to(std::unique_ptr<LoopRun> next);
  void begin();
  void cycle_once();
  void record(const CycleRecord& record);
  void update_newest();
  void read_records();
  void note_stages(const haptics::StageStamps& stamps);
  void update_health();
  void send(haptics::LoopCommand command);

  bool is_virtual() const { return config.clock == RuntimeClock::virtual_time; }

  RuntimeConfig config;
  const DriverFunction driver;
  std::int64_t period_ns;
  std::unique_ptr<haptics::HapticDevice> real_device;  // null: the lever is simulated
  haptics::Gate gate;
  CycleRunner runner;
  InputMixer input;
  std::unique_ptr<haptics::HandDriver> hand;  // the hand that holds the simulated lever
  std::unique_ptr<haptics::SimulatedLever> simulated;
  haptics::HapticDevice& lever;
  std::unique_ptr<LoopRun> run;
  haptics::AdmittedTuning admitted;
  std::unique_ptr<haptics::TraceRecorder> recorder;
  std::uint64_t recorded_run = 0;  // number of the run that `recorder` records
  haptics::RealtimeThread thread;
  // The stream's other readers; empty on the virtual clock.
  std::optional<StreamThread> driver_thread, recorder_thread;

  // The members below are used only by the frame side, i.e. not by the haptic thread.
  CycleStream::Reader reader;
  CycleRecord newest;
  std::vector<vehicle::DriveSample> cycles;  // not yet returned by read_frame()
  haptics::EventDetector detector;
  std::uint64_t last_read_run = 0;
  std::vector<haptics::HapticEvent> events;  // not yet returned by read_frame()
  std::vector<std::int64_t> lateness;        // [ns] of `cycles`
  LoopHealth health;                         // as of the last read_frame()
  // [ns] durations of the stages in the latest stamped cycles
  std::array<std::array<std::int64_t, 8>, kStamps> stages{};
  std::size_t stamps_read = 0;
  std::uint64_t stamped_cycle = 0;
  std::uint64_t commanded_run = 0, commanded_cycle = 0;  // newest cycle when the last command was sent
  bool wants_forces = false;                             // see Runtime::wants_forces()
  std::int64_t start_ns = 0;                             // [ns] one period before the first cycle, on the loop's clock
  std::int64_t virtual_ns = 0;                           // [ns] time of the last cycle on the virtual clock
  double pending_time = 0.0;        // [s] time passed to advance() but not yet simulated, less than one period
  std::uint64_t unread_cycles = 0;  // number of cycles since the stream was last read; virtual clock only
};

Runtime::State::State(const RuntimeConfig& wanted)
    : config(checked(wanted)),
      driver(config.driver),
      period_ns(haptics::period_ns(config.preset.haptics)),
      real_device(make_lever(config)),
      gate(gate_for(config, real_device.get())),
      input(static_cast<bool>(config.driver), resting_action(), config.pedal_keys, runner.inputs),
      hand(real_device ? nullptr : make_hand()),
      simulated(real_device ? nullptr
                            : std::make_unique<haptics::SimulatedLever>(config.preset.lever, period_ns, *hand)),
      lever(real_device ? *real_device : *simulated),
      run(std::make_unique<LoopRun>(config.preset.haptics, gate, lever, runner.inputs, 1,
                                    make_car(config, gate, lever.spec(), config.start, config.keyboard),
                                    haptics::kNeutralGear, make_other_load(config, gate, lever.spec()))),
      admitted(run->loop.admitted()),
      reader(runner.stream) {
  const glm::dvec2 start = start_position();
  if (simulated) simulated->place(start);
  newest.cycle.out.lever = newest.cycle.out.proxy = start;
  newest.cycle.out.wall_stiffness = admitted.tuning.wall_stiffness;
  if (run->car) {
    newest.car = run->car->state();
    newest.keyboard = config.keyboard;
  }
  begin();
}

// The motors first: the other threads may take some time to end.
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
  action.controls.pedals = config.pedals;
  return action;
}

// Creates the next run, in which the car continues from its current state.
std::unique_ptr<LoopRun> Runtime::State::make_run() {
  update_newest();
  const vehicle::CarStart from = vehicle::start_from(newest.car);
  const int gear = haptics::is_sequential(gate) ? newest.cycle.out.gear : haptics::kNeutralGear;
  return std::make_unique<LoopRun>(running_config(), gate, lever, runner.inputs, run->number + 1,
                                   make_car(config, gate, lever.spec(), from, newest.keyboard), gear,
                                   make_other_load(config, gate, lever.spec()));
}

void Runtime::State::begin() {
  runner.switch_to(*run);
  health.rate = config.preset.haptics.rate;
  if (is_virtual()) {
    health.not_realtime_reason = "not real-time, because the virtual clock is used";
    start_ns = virtual_ns = -period_ns;
    return;
  }
  if (driver) {
    driver_thread.emplace(runner.stream, kDriverInterval, StreamThread::AtEnd::stop,
                          [this](const CycleRecord& record) { input.act(driver(record.sample())); });
  }
  runner.watched.follow(config.watch.get(), real_device != nullptr);
  haptics::RealtimeConfig realtime;
  realtime.period_ns = period_ns;
  thread.start(realtime, [this](const haptics::CycleCall& call) { runner.cycle(call, &thread.statistics()); });
  health.realtime = thread.is_realtime();
  health.not_realtime_reason = thread.not_realtime_reason();
  for (update_newest(); newest.run != run->number; update_newest()) std::this_thread::sleep_for(kPollPeriod);
  start_ns = newest.cycle.deadline_ns - period_ns;
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

// True if a fault has ended the forces, or arming was refused, and the lever does not recover by itself. False while the
// last command may not have been processed: until the second cycle after it.
bool Runtime::State::has_lost_forces(const CycleRecord& record) const {
  const haptics::HapticSnapshot& now = record.cycle.out;
  if (record.run == commanded_run && now.cycle < commanded_cycle + 2) return false;
  if (now.guard == haptics::GuardState::idle) return now.fault == haptics::GuardFault::stopped;
  return now.guard == haptics::GuardState::released ||
         (now.guard == haptics::GuardState::damped && !haptics::rearms_itself(lever.spec(), now.fault));
}

bool Runtime::State::wants_forces_after(ForceCause cause) const {
  return runtime::wants_forces_after(cause, real_device != nullptr, wants_forces);
}

// Returns true if forces were wanted up to now, and the cycle has a fault.
bool Runtime::State::notice_fault(const CycleRecord& record) {
  if (!wants_forces || !has_lost_forces(record)) return false;
  wants_forces = wants_forces_after(ForceCause::fault);
  return !wants_forces;
}

// Replaces the running loop. Returns after the first cycle of the next loop, so that later commands reach that loop and
// its recording misses no cycle. If the old loop had a fault after the next loop was created, the forces of the next
// loop are ended too.
void Runtime::State::switch_to(std::unique_ptr<LoopRun> next) {
  CycleStream::Reader cycles_since(runner.stream);
  update_newest();
  CycleRecord last = newest;  // of the old loop
  runner.switch_to(*next);
  if (is_virtual()) {
    cycle_once();
    pending_time -= 1e-9 * static_cast<double>(period_ns);
  }
  while (newest.run != next->number) {
    if (cycles_since.pop(newest))
      last = newest.run == run->number ? newest : last;
    else
      std::this_thread::sleep_for(kPollPeriod);
  }
  run = std::move(next);
  if (notice_fault(last)) send(haptics::LoopCommand::stop);
}

// Runs one cycle on the virtual clock, on which this thread does the work of the driver's and the recorder's threads.
void Runtime::State::cycle_once() {
  virtual_ns += period_ns;
  runner.cycle({virtual_ns, 0}, nullptr);
  record(runner.newest());
  if (driver) input.act(driver(runner.newest().sample()));
  if (++unread_cycles >= kReadInterval) read_records();
}

void Runtime::State::record(const CycleRecord& record) {
  if (recorder && record.run == recorded_run) recorder->add(record.cycle);
}

void Runtime::State::update_newest() {
  if (const std::optional<CycleRecord> record = runner.stream.newest()) newest = *record;
}

void Runtime::State::read_records() {
  unread_cycles = 0;
  for (CycleRecord record; reader.pop(record);) {
    if (cycles.size() < CycleRunner::kMaxRecords) {
      cycles.push_back(record.sample());
      lateness.push_back(record.late_ns);
    }
    if (std::exchange(last_read_run, record.run) != record.run) detector = {};
    detector.update(record.cycle, events);
    note_stages(record.stamps);
  }
}

void Runtime::State::note_stages(const haptics::StageStamps& stamps) {
  if (stamps_read > 0 && stamps.cycle == stamped_cycle) return;
  stamped_cycle = stamps.cycle;
  std::array<std::int64_t, 8>& latest = stages[stamps_read++ % kStamps];
  for (std::size_t i = 0; i < latest.size(); ++i) latest[i] = stamps.ns[i + 1] - stamps.ns[i];
}

void Runtime::State::update_health() {
  std::sort(lateness.begin(), lateness.end());
  const auto late = [this](double quantile) {  // [s] nearest rank
    if (lateness.empty()) return 0.0;
    const double rank = std::max(1.0, std::ceil(quantile * static_cast<double>(lateness.size())));
    return 1e-9 * static_cast<double>(lateness[static_cast<std::size_t>(rank) - 1]);
  };
  health.late_p50 = late(0.5);
  health.late_p99 = late(0.99);
  health.late_worst = late(1.0);
  lateness.clear();
  health.overruns = newest.overruns;
  health.skipped = newest.skipped;
  health.lost = reader.lost();
  const std::size_t stamped = std::min(stamps_read, kStamps);
  health.cycle_ns = 0.0;
  for (std::size_t stage = 0; stage < health.stage_ns.size(); ++stage) {
    health.stage_ns[stage] = 0.0;
    for (std::size_t i = 0; i < stamped; ++i)
      health.stage_ns[stage] += static_cast<double>(stages[i][stage]) / static_cast<double>(stamped);
    health.cycle_ns += health.stage_ns[stage];
  }
}

// Queues the command; the loop processes one command per cycle. If the queue is full on the virtual clock, which may be
// stopped, drops the oldest command. If it is full on the real clock, waits until the loop has processed a command.
void Runtime::State::send(haptics::LoopCommand command) {
  update_newest();
  commanded_run = newest.run;
  commanded_cycle = newest.cycle.out.cycle;
  while (!runner.inputs.commands.push(command)) {
    haptics::LoopCommand oldest;
    if (is_virtual())
      (void)runner.inputs.commands.pop(oldest);
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

RuntimeFrame Runtime::read_frame() {
  state_->read_records();
  state_->update_newest();  // after the records, so that the state is not older
  state_->update_health();
  const CycleRecord& newest = state_->newest;
  return {std::exchange(state_->cycles, {}), std::exchange(state_->events, {}), newest.cycle.out, newest.car};
}

haptics::HapticSnapshot Runtime::snapshot() {
  state_->update_newest();
  return state_->newest.cycle.out;
}

vehicle::VehicleState Runtime::car() {
  state_->update_newest();
  return state_->newest.car;
}

haptics::Pedals Runtime::keyboard() {
  state_->update_newest();
  return state_->newest.keyboard;
}

void Runtime::set_hand(const haptics::HandTarget& target) {
  state_->input.set_hand(target);
}

void Runtime::set_controls(const haptics::DriverControls& controls, const haptics::PedalKeys& keys) {
  state_->input.set_controls(controls, keys);
}

haptics::AdmittedTuning Runtime::change_tuning(const haptics::HapticTuning& wanted) {
  state_->admitted = state_->run->loop.change_tuning(wanted);
  state_->config.preset.haptics.tuning = wanted;
  return state_->admitted;
}

void Runtime::follow(ForceCause cause) {
  static constexpr haptics::LoopCommand kCommands[] = {haptics::LoopCommand::none, haptics::LoopCommand::arm,
                                                       haptics::LoopCommand::disarm, haptics::LoopCommand::stop};
  const ForceEffect effect = force_effect(cause, state_->real_device != nullptr);
  if (effect == ForceEffect::keep) return;
  state_->wants_forces = effect == ForceEffect::on;
  state_->send(kCommands[static_cast<std::size_t>(effect)]);
}

bool Runtime::wants_forces() {
  state_->update_newest();
  (void)state_->notice_fault(state_->newest);
  return state_->wants_forces;
}

const LoopHealth& Runtime::health() const noexcept {
  return state_->health;
}

void Runtime::start_recording(const std::filesystem::path& file) {
  State& s = *state_;
  if (s.recorder) throw std::logic_error("a recording is already running; stop it first");
  std::unique_ptr<LoopRun> next = s.make_run();
  // Forces that were requested count as on even if the loop has not processed the command yet.
  (void)s.notice_fault(s.newest);
  const bool armed = s.wants_forces_after(ForceCause::recording);
  if (armed) next->loop.arm();
  s.recorder = std::make_unique<haptics::TraceRecorder>(file, s.header(next->load().replay_parameters(), armed));
  s.recorded_run = next->number;
  try {
    if (!s.is_virtual())
      s.recorder_thread.emplace(s.runner.stream, kRecorderInterval, StreamThread::AtEnd::finish,
                                [&s](const CycleRecord& record) { s.record(record); });
  } catch (...) {
    s.recorder.reset();
    throw;
  }
  s.wants_forces = armed;
  s.switch_to(std::move(next));
}

std::optional<std::string> Runtime::poll_recording_problem() {
  return state_->recorder ? state_->recorder->take_problem() : std::nullopt;
}

std::optional<std::string> Runtime::stop_recording() {
  if (!state_->recorder) return std::nullopt;
  state_->recorder_thread.reset();
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
  state_->update_newest();
  const std::int64_t now_ns = state_->is_virtual() ? state_->virtual_ns : state_->newest.cycle.deadline_ns;
  return 1e-9 * static_cast<double>(std::max<std::int64_t>(0, now_ns - state_->start_ns));
}

}  // namespace gearshift::runtime
