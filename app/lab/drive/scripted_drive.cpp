#include "app/lab/drive/scripted_drive.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <string_view>

#include <fmt/format.h>

#include "app/lessons/assessment/error_detector.h"
#include "app/lessons/assessment/shift_meter.h"
#include "app/lessons/simulated_driver/driver_constants.h"
#include "app/lessons/simulated_driver/driver_skill.h"
#include "app/lessons/simulated_driver/simulated_drive.h"
#include "app/lessons/simulated_driver/stroke_hand.h"

namespace gearshift::lab {
namespace {

constexpr double kMaxStartSpeed = 250.0;  // [km/h]

// The hand of a practised driver: shifts into the gear that the script asks for, tries again where the lever is stuck,
// and lets go of the knob once the gear is in.
class ScriptHand {
 public:
  ScriptHand(const haptics::Gate& gate, double period, int gear) : gate_(gate), hand_(period), goal_(gear) {}

  haptics::HandTarget next(const vehicle::DriveSample& now, const ScriptRow& row) {
    if (row.lever) return {*row.lever, {0.0, 0.0}, {0.0, 0.0}, false, false};
    if (row.gear && *row.gear != goal_) {
      goal_ = *row.gear;
      reach(now);
    }
    if (is_shifting_) follow(now);
    return hand_.next(now.time(), now.lever.lever);
  }

 private:
  void reach(const vehicle::DriveSample& now) {
    hand_.start(lessons::strokes_to_gear(gate_, now.lever.lever, now.lever.gear, goal_, lessons::DriverSkill{}.pace),
                now.lever.lever, now.time());
    is_shifting_ = true;
    in_since_.reset();
  }

  void follow(const vehicle::DriveSample& now) {
    const bool ends_in_aisle = goal_ == haptics::kNeutralGear || haptics::is_sequential(gate_);
    const bool is_in = now.lever.gear == goal_ && (!ends_in_aisle || hand_.is_at_end(now.time()));
    if (is_in && !in_since_) in_since_ = now.time();
    if (in_since_ && now.time() - *in_since_ > lessons::kKnobReleaseTime) {
      hand_.release_lever();
      is_shifting_ = false;
      return;
    }
    const bool waits_for_ring = now.car.sync == vehicle::SyncPhase::synchronising;
    const double patience = waits_for_ring ? lessons::kSyncPatience : lessons::kStuckTime;
    if (!in_since_ && hand_.time_waiting(now.time()) > patience) reach(now);
  }

  haptics::Gate gate_;
  lessons::StrokeHand hand_;
  int goal_;
  bool is_shifting_ = false;
  std::optional<double> in_since_;  // [s]
};

// Finds shifts and errors as a lesson does.
class Assessor {
 public:
  Assessor(const vehicle::CarSpec& car, const haptics::Gate& gate) : meter_(car, gate), errors_(car, gate) {}

  void add(const vehicle::DriveSample& sample, ScriptedDrive& drive) {
    const std::optional<lessons::ShiftRecord> ended = meter_.add(sample);
    errors_.add(sample, haptics::kNeutralGear, meter_.is_open());
    collect(ended, drive);
  }

  void finish(ScriptedDrive& drive) {
    collect(meter_.finish(), drive);
    errors_.finish();
    collect({}, drive);
  }

 private:
  void collect(const std::optional<lessons::ShiftRecord>& ended, ScriptedDrive& drive) {
    if (ended) {
      errors_.check_shift(*ended);
      drive.shifts.push_back(*ended);
    }
    for (const lessons::DrivingError& error : errors_.drain_errors()) drive.errors.push_back(error);
  }

  lessons::ShiftMeter meter_;
  lessons::ErrorDetector errors_;
};

double start_number(std::string_view key, std::string_view value) {
  double number = NAN;
  const auto [end, error] = std::from_chars(value.data(), value.data() + value.size(), number);
  if (error != std::errc() || end != value.data() + value.size() || !(std::abs(number) <= kMaxStartSpeed))
    throw std::invalid_argument(
        fmt::format("{} = {}: must be a number between -{} and {}", key, value, kMaxStartSpeed, kMaxStartSpeed));
  return number;
}

int start_gear(std::string_view value) {
  for (int gear = haptics::kReverseGear; gear <= haptics::kMaxGear; ++gear)
    if (value == haptics::gear_name(gear)) return gear;
  throw std::invalid_argument(fmt::format("gear = {}: must be a gear as the gate names it, such as R, N or 1", value));
}

bool start_engine(std::string_view value) {
  if (value != "on" && value != "off")
    throw std::invalid_argument(fmt::format("engine = {}: must be on or off", value));
  return value == "on";
}

}  // namespace

ScriptedDrive drive_script(const ScriptedDriveConfig& config) {
  ScriptedDrive drive;
  const auto keep = [&drive](const haptics::HapticEvent& event) { drive.events.push_back(event); };
  lessons::SimulatedDrive run({config.car, config.gate, config.start, config.seed, 1000.0, config.trace, keep});
  check_script_fits(config.script, run.gate());
  if (!haptics::has_gear(run.gate(), config.start.gear))
    throw std::invalid_argument(fmt::format("this gate has no gear {}", haptics::gear_name(config.start.gear)));
  Assessor assessor(config.car, run.gate());
  ScriptHand hand(run.gate(), run.period(), config.start.gear);
  ScriptPlayer player(config.script);
  vehicle::DriverAction action;
  action.hand.position = haptics::rest_position(run.gate(), config.start.gear);
  action.controls = player.at(0.0).controls;
  const auto cycles = std::llround(config.script.end() / run.period());
  const auto stride = std::max(1LL, std::llround(config.interval / run.period()));
  for (long long cycle = 0; cycle <= cycles; ++cycle) {
    const vehicle::DriveSample& sample = run.step(action);
    assessor.add(sample, drive);
    if (cycle % stride == 0 || cycle == cycles) drive.samples.push_back(sample);
    const ScriptRow row = player.at(sample.time() + run.period());
    action = {hand.next(sample, row), row.controls};
  }
  assessor.finish(drive);
  run.finish();
  return drive;
}

vehicle::CarStart parse_drive_start(const std::string& text, int gear) {
  vehicle::CarStart start;
  start.gear = gear;
  for (std::string_view left = text; !left.empty();) {
    const std::string_view item = left.substr(0, left.find(','));
    left.remove_prefix(std::min(item.size() + 1, left.size()));
    const std::size_t equals = std::min(item.find('='), item.size());
    const std::string_view key = item.substr(0, equals), value = item.substr(std::min(equals + 1, item.size()));
    if (key == "gear")
      start.gear = start_gear(value);
    else if (key == "speed_km_per_h")
      start.road_speed = start_number(key, value) / haptics::kKmhPerMps;
    else if (key == "engine")
      start.running = start_engine(value);
    else
      throw std::invalid_argument(fmt::format(
          "\"{}\" is not known: write gear=GEAR, speed_km_per_h=SPEED or engine=off, with commas between them", item));
  }
  return start;
}

}  // namespace gearshift::lab
