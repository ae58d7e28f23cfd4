#include "app/vehicle/car_load.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <locale>
#include <sstream>
#include <stdexcept>

#include <fmt/format.h>

#include "haptics/gate/feel_curve.h"

namespace gearshift::vehicle {
namespace {

// The name of the physics in a trace. A change that makes older drives replay differently must change it.
constexpr const char* kName = "car-3";
constexpr std::string_view kOldName = "car";                     // and what begins with it
constexpr int kEngineOff = 0, kEngineRunning = 1, kStalled = 2;  // codes for the engine's state in replay_parameters()

double force_scale(double force_limit) {
  if (!(force_limit > 0.0)) throw std::invalid_argument("the device's maximum force must be greater than 0 N");
  return std::min(1.0, force_limit / kMaxHandForce);
}

int engine_code(const CarStart& start) noexcept {
  if (start.running) return kEngineRunning;
  return start.stalled ? kStalled : kEngineOff;
}

double finite_or_zero(double value) noexcept {
  return std::isfinite(value) ? value : 0.0;
}

constexpr double kLightThrottle = 0.2;  // [1] fraction of full throttle; enough to move off
constexpr double kLightFree = 180.0;    // [rad/s] about 1700 rpm; an uncoupled engine gets no light throttle above this
// [rad/s] The same for a held throttle, and how much more it is for full throttle: half throttle keeps a free engine at
// 1500 rpm, as the prompt of a hill start asks.
constexpr double kHeldFree = 130.0, kHeldFreeMore = 130.0;
constexpr double kFreeBand = 50.0;  // [rad/s] range below this speed in which the throttle falls to 0

// Returns the throttle [1] of a foot that wants `pedal`. While the engine is not coupled to the wheels, the foot eases
// off as the engine comes near `free` [rad/s]: a constant throttle would over-rev it.
double eased_throttle(double pedal, double free, double engine_speed) noexcept {
  return pedal * std::clamp((free - engine_speed) / kFreeBand, 0.0, 1.0);
}

// The right foot's aim while the engine is not coupled to the wheels.
struct Foot {
  double pedal = 0.0;       // [1]
  double free = kHeldFree;  // [rad/s] see eased_throttle()
};

Foot foot_of(const haptics::PedalKeys& keys) noexcept {
  const double held = keys.throttle ? 1.0 : std::clamp(finite_or_zero(keys.held_throttle), 0.0, 1.0);
  if (keys.throttle_light && held <= kLightThrottle) return {kLightThrottle, kLightFree};
  return {held, kHeldFree + kHeldFreeMore * held};
}

double throttle_of(const haptics::PedalKeys& keys, double engine_speed, bool coupled) noexcept {
  const Foot foot = foot_of(keys);
  return keys.throttle || coupled ? foot.pedal : eased_throttle(foot.pedal, foot.free, engine_speed);
}

constexpr double kPulledDown = 65.0;  // [rad/s] below the foot's free speed: the clutch takes all that the engine gives
constexpr double kMaxPulledDown = 150.0;  // [rad/s] a faster engine is never pulled down too far
constexpr double kYieldBand = 15.0;       // [rad/s]
constexpr double kMinEagerness = 1e-3;    // [1] avoids a division by 0
constexpr double kDead = 25.0;            // [rad/s] a slower engine has stalled

// Returns how fast the left foot lets the clutch up in the bite zone [1]: 1 is its usual speed. A foot feels that the
// engine is pulled down, waits at the bite point, and yields before the engine stalls.
double eagerness(const haptics::PedalKeys& keys, double engine_speed) noexcept {
  if (!(engine_speed > kDead)) return 1.0;
  const double least = std::min(foot_of(keys).free - kPulledDown, kMaxPulledDown);
  return std::clamp((engine_speed - least) / kYieldBand, -1.0, 1.0);
}

// Returns the pedal position after `seconds` of motion towards `to`. `time`: duration of the full travel [s].
double ramped(double pedal, double to, double seconds, double time) noexcept {
  const double step = seconds / time;
  return std::clamp(to, pedal - step, pedal + step);
}

PedalTiming slowed(PedalTiming timing, double slow_clutch) noexcept {
  timing.slip_time *= 1.0 + (kSlowClutch - 1.0) * std::clamp(finite_or_zero(slow_clutch), 0.0, 1.0);
  return timing;
}

// Returns the position of the released clutch pedal after `seconds`: the pedal rises fast, but slowly from the bite
// point to the point of full capacity, unless the clutch has `gripped`. `eager`: see eagerness()
double release_clutch(double pedal, double seconds, const PedalTiming& timing, const ClutchSpec& clutch, bool gripped,
                      double eager) noexcept {
  const double edges[] = {clutch.bite, clutch.closed, 0.0};
  const double quick = 1.0 / timing.pedal_time, slow = (clutch.bite - clutch.closed) / timing.slip_time;
  const bool is_biting = pedal < clutch.bite && pedal > clutch.closed;
  if (!gripped && is_biting && eager <= 0.0) return std::min(clutch.bite, pedal - eager * slow * seconds);
  const double speeds[] = {quick, gripped ? quick : slow * std::max(eager, kMinEagerness), quick};
  for (int part = 0; part < 3; ++part) {
    const double step = std::min(std::max(pedal - edges[part], 0.0), speeds[part] * seconds);
    pedal -= step;
    seconds -= step / speeds[part];
  }
  return pedal;
}

// +1 for a slot in front of the aisle, -1 behind it.
double side_of(const haptics::Gate& gate, int slot) noexcept {
  return static_cast<int>(haptics::slot_of(gate, slot).side);
}

// Fills in the speeds that were left empty.
CarStart complete_start(const CarSpec& car, CarStart start) {
  const double shaft = shaft_per_road(car, start.gear) * start.road_speed;
  if (!start.engine_speed) start.engine_speed = start.running ? std::max(car.engine.idle, shaft) : 0.0;
  if (!start.shaft_speed) start.shaft_speed = start.gear == haptics::kNeutralGear ? *start.engine_speed : shaft;
  return start;
}

// Text for make_car_load(): a line of values, a line with the car file's name, then the car file's text. Each double is
// read back as exactly the same value.
std::string format_parameters(const CarSpec& car, double force_limit, const CarStart& start, std::uint64_t seed) {
  return fmt::format("{} {} {} {} {} {} {} {} {} {} {} {} {} {}\n{}\n{}", kName, force_limit, seed, start.road_speed,
                     start.gear, engine_code(start), *start.engine_speed, *start.shaft_speed, start.distance,
                     start.slip_energy, start.engine.integral, start.engine.lift, start.engine.cranked,
                     start.clutch_temperature, car.name + ".toml", car.text);
}

}  // namespace

CarStart start_from(const VehicleState& state) noexcept {
  CarStart start;
  start.road_speed = state.road_speed;
  start.gear = state.gear;
  start.running = state.running;
  start.stalled = state.stalled;
  start.engine_speed = state.engine_speed;
  start.shaft_speed = state.shaft_speed;
  start.distance = state.distance;
  start.slip_energy = state.slip_energy;
  start.engine = {state.idle_integral, state.idle_lift, state.cranked};
  start.clutch_temperature = state.clutch_temperature;
  return start;
}

const haptics::Pedals& KeyboardPedals::move(const haptics::PedalKeys& keys, double seconds, double engine_speed,
                                            bool coupled) noexcept {
  seconds = std::isfinite(seconds) ? std::max(seconds, 0.0) : 0.0;
  const double time = timing_.pedal_time;
  pedals_.throttle = ramped(pedals_.throttle, throttle_of(keys, engine_speed, coupled), seconds, time);
  pedals_.brake = ramped(pedals_.brake, keys.brake ? 1.0 : 0.0, seconds, time);
  if (keys.clutch)
    pedals_.clutch = ramped(pedals_.clutch, 1.0, seconds, time);
  else if (!keys.clutch_hold)
    pedals_.clutch = release_clutch(pedals_.clutch, seconds, slowed(timing_, keys.slow_clutch), clutch_, coupled,
                                    eagerness(keys, engine_speed));
  return pedals_;
}

void check_car_fits(const CarSpec& car, const haptics::Gate& gate) {
  if (haptics::is_mechanism(gate))
    throw std::invalid_argument(fmt::format("a gate of aisles works without a car, not with \"{}\"", car.name));
  const haptics::Gate sleeves = sleeves_of(gate);
  for (const haptics::Slot& slot : haptics::slots(sleeves)) {
    if (shaft_per_road(car, slot.gear) != 0.0) continue;
    throw std::invalid_argument(
        fmt::format("this gate has a gear {}, but the car \"{}\" does not", haptics::gear_name(slot.gear), car.name));
  }
}

CarLoad::CarLoad(const CarSpec& car, const haptics::Gate& gate, double force_limit, const CarStart& start,
                 std::uint64_t seed, const PedalTiming& timing)
    : car_(car),
      gate_(gate),
      start_(complete_start(car, start)),
      parameters_(format_parameters(car, force_limit, start_, seed)),
      drum_(gate),
      keyboard_(timing, car.clutch),
      driveline_(car),
      synchroniser_(car.synchro, sleeves_of(gate), force_scale(force_limit), start.gear, seed),
      vibration_(car.engine.shudder * force_scale(force_limit)),
      guidance_(gate) {
  check_car_fits(car, gate);
  const haptics::Gate sleeves = sleeves_of(gate);
  for (std::size_t i = 0; i < haptics::slots(sleeves).size(); ++i) {
    const haptics::Slot& slot = sleeves.slot[i];
    const double per_road = shaft_per_road(car, slot.gear);
    const double ratio = std::abs(per_road) * car.body.wheel_radius / car.gearbox.final_drive;
    gear_of_slot_[i] = {slot.gear, per_road, ratio};
  }
  driveline_.place(*start_.engine_speed, *start_.shaft_speed, start_.road_speed, start_.running, start_.stalled,
                   start_.engine, start_.clutch_temperature);
  state_ = driveline_.state();
  state_.distance = start_.distance;
  state_.slip_energy = start_.slip_energy;
  state_.gear = start_.gear;
  state_.force_scale = force_scale(force_limit);
}

void CarLoad::place_pedals(const haptics::Pedals& keyboard) noexcept {
  keyboard_.place(keyboard);
}

haptics::Pedals CarLoad::move_pedals(const haptics::Pedals& axes, const haptics::PedalKeys& keys,
                                     double period) noexcept {
  const bool coupled = state_.gear != haptics::kNeutralGear && state_.clutch_locked;
  const haptics::Pedals& pressed = keyboard_.move(keys, period, state_.engine_speed, coupled);
  return {std::max(axes.throttle, pressed.throttle), std::max(axes.brake, pressed.brake),
          std::max(axes.clutch, pressed.clutch), axes.hand_brake};
}

haptics::LeverOutput CarLoad::step(const haptics::LeverInput& in, double period) noexcept {
  const ShiftDrum::Sleeve moved = drum_.turn(in);
  const SleeveInput lever = sleeve_input(in, moved);
  const SleeveOutput sleeve = synchroniser_.step(lever, period);
  const haptics::DriverControls& driver = in.controls;
  DrivelineInput drive;
  drive.pedals = driver.pedals;
  drive.ignition = driver.ignition;
  drive.starter = driver.starter;
  drive.slope = driver.slope;
  drive.meshed = sleeve.meshed;
  drive.cone_gear = sleeve.cone_gear;
  drive.cone_torque = sleeve.cone_torque;
  driveline_.step(drive, period);
  update_state(driver, lever, sleeve);

  haptics::LeverOutput out;
  out.road_speed = state_.road_speed;
  if (in.slot != haptics::kNoSlot && lever.slot != haptics::kNoSlot && moved.way != 0.0) {
    const double towards = side_of(gate_, in.slot) * moved.way;
    out.force.y = towards * sleeve.force;
    out.vibration.y = towards * sleeve.rattle;
    out.limited_slot = in.slot;
    limit_lever(sleeve, moved.way, out);
  }
  const double vibration = vibration_.step(state_.shudder, state_.engine_speed, period);
  out.force.y += vibration;
  out.vibration.y += vibration;
  out.force += guidance_.step(driver, in.proxy, period);
  return out;
}

// The walls of a sleeve that moves out are walls of the lever in reverse order.
void CarLoad::limit_lever(const SleeveOutput& sleeve, double way, haptics::LeverOutput& out) const noexcept {
  const bool is_limited_inward = sleeve.depth_max < std::numeric_limits<double>::max();
  if (way > 0.0) {
    out.depth_min = sleeve.depth_min;
    out.depth_max = sleeve.depth_max;
    return;
  }
  if (is_limited_inward) out.depth_min = std::max(0.0, drum_.lever_depth(sleeve.depth_max));
  if (sleeve.depth_min > 0.0) out.depth_max = drum_.lever_depth(sleeve.depth_min);
}

SleeveInput CarLoad::sleeve_input(const haptics::LeverInput& in, const ShiftDrum::Sleeve& sleeve) const noexcept {
  SleeveInput lever;
  lever.slot = sleeve.slot;
  lever.clutch_open = clutch_capacity(car_.clutch, in.controls.pedals.clutch) <= 0.0;
  if (sleeve.slot == haptics::kNoSlot) return lever;
  const SlotGear& gear = gear_of_slot_[static_cast<std::size_t>(sleeve.slot)];
  lever.depth = sleeve.depth;
  if (in.slot != haptics::kNoSlot && sleeve.way != 0.0) {
    lever.push = sleeve.way * side_of(gate_, in.slot) * finite_or_zero(in.push.y);
    lever.feel = sleeve.way * haptics::feel_force(haptics::slot_of(gate_, in.slot).feel, in.depth);
  }
  lever.difference = difference(gear);
  lever.load = driveline_.state().drive_torque / car_.gearbox.final_drive;
  return lever;
}

double CarLoad::difference(const SlotGear& gear) const noexcept {
  const VehicleState& now = driveline_.state();
  return (now.shaft_speed - gear.per_road * now.road_speed) / gear.ratio;
}

void CarLoad::update_state(const haptics::DriverControls& controls, const SleeveInput& lever,
                           const SleeveOutput& sleeve) noexcept {
  const double scale = state_.force_scale;
  state_ = driveline_.state();
  state_.distance += start_.distance;
  state_.slip_energy += start_.slip_energy;
  state_.force_scale = scale;
  state_.gear = sleeve.meshed;
  state_.sync = sleeve.phase;
  if (lever.slot != haptics::kNoSlot && sleeve.meshed == haptics::kNeutralGear)
    state_.dog_difference = difference(gear_of_slot_[static_cast<std::size_t>(lever.slot)]);
  state_.grind_power = sleeve.grind_power;
  state_.grinding = sleeve.grind_power > 0.0;
  state_.torque_locked = sleeve.torque_locked;
  state_.slope = controls.slope;
}

std::unique_ptr<CarLoad> make_car_load(const std::string& parameters, const haptics::Gate& gate) {
  std::istringstream stream(parameters);
  stream.imbue(std::locale::classic());
  std::string kind, file;
  double force_limit = 0.0, engine_speed = 0.0, shaft_speed = 0.0;
  std::uint64_t seed = 0;
  int engine = kEngineOff;
  CarStart start;
  stream >> kind >> force_limit >> seed >> start.road_speed >> start.gear >> engine >> engine_speed >> shaft_speed >>
      start.distance >> start.slip_energy >> start.engine.integral >> start.engine.lift >> start.engine.cranked >>
      start.clutch_temperature;
  if (kind != kName && kind.starts_with(kOldName))
    throw std::invalid_argument("an earlier version recorded it, whose car drives differently");
  if (!stream || kind != kName || stream.get() != '\n' || !std::getline(stream, file)) return nullptr;
  if (engine < kEngineOff || engine > kStalled) return nullptr;
  start.running = engine == kEngineRunning;
  start.stalled = engine == kStalled;
  start.engine_speed = engine_speed;
  start.shaft_speed = shaft_speed;
  const std::string text(std::istreambuf_iterator<char>(stream), {});
  return std::make_unique<CarLoad>(parse_car(text, file), gate, force_limit, start, seed);
}

}  // namespace gearshift::vehicle
