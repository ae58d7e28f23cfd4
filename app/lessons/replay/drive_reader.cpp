#include "app/lessons/replay/drive_reader.h"

#include <cmath>
#include <utility>

#include "app/vehicle/car_load.h"
#include "haptics/files/file_error.h"
#include "haptics/loop/trace_fields.h"

namespace gearshift::lessons {
namespace {

// Largest magnitude of a plausible number, in any unit. Its square must fit into a float for drawing. Engineering
// value.
constexpr double kMaxMagnitude = 1e9;

// True if the number is finite and at most kMaxMagnitude. Used for the loop's outputs and the driver's controls. Device
// readings are not checked, because a faulty device may report any number.
template <class T>
bool is_plausible(const T& value) noexcept {
  if constexpr (std::is_same_v<T, double>) {
    return std::abs(value) <= kMaxMagnitude;  // false for NaN
  } else {
    bool all = true;
    if constexpr (!haptics::LeafField<T>)
      haptics::each_field(value, [&](const char*, const auto& member) { all = all && is_plausible(member); });
    return all;
  }
}

// Copies the part of the car's state that the recording contains.
void apply_recorded(const haptics::TraceSample& sample, vehicle::VehicleState& car) noexcept {
  car.pedals = sample.controls.pedals;
  car.ignition = sample.controls.ignition;
  car.slope = sample.controls.slope;
  car.gear = sample.out.gear;
  car.road_speed = sample.out.road_speed;
}

}  // namespace

DriveReader::DriveReader(const std::filesystem::path& file, std::uint64_t max_cycles)
    : name_(file.string()),
      reader_(file, haptics::TornTrace::salvage),
      max_cycles_(max_cycles),
      replayer_(reader_.header(), file.string(),
                [this](const std::string& name, const haptics::Gate& gate) { return make_load(name, gate); }) {}

// Creates the lever load with the name in the recording. car_ points to the car in the load, if any. The pointer stays
// valid, because the replayer owns the load and never moves it.
std::unique_ptr<haptics::LeverLoad> DriveReader::make_load(const std::string& name, const haptics::Gate& gate) {
  gate_ = gate;
  if (std::unique_ptr<haptics::LeverLoad> no_load = haptics::make_no_load(name, gate)) return no_load;
  std::unique_ptr<vehicle::CarLoad> car = vehicle::make_car_load(name, gate);
  car_ = car.get();
  return car;
}

void DriveReader::check(const haptics::TraceSample& sample) const {
  if (is_plausible(sample.out) && is_plausible(sample.controls)) return;
  throw haptics::FileError(
      name_, 0, "the trace is damaged; cycle " + std::to_string(sample.out.cycle) + " contains an invalid number");
}

bool DriveReader::next(vehicle::DriveSample& sample) {
  haptics::TraceSample recorded;
  do {
    if (cycles_read_ == max_cycles_ || !reader_.next(recorded)) return false;
    ++cycles_read_;
    check(recorded);
    if (!has_diverged_) has_diverged_ = !replayer_.step(recorded);
  } while (last_ns_ && recorded.out.time_ns <= *last_ns_);
  last_ns_ = recorded.out.time_ns;
  if (car_ && !has_diverged_)
    state_ = car_->state();
  else
    apply_recorded(recorded, state_);
  sample.lever = recorded.out;
  sample.car = state_;
  sample.controls = recorded.controls;
  return true;
}

}  // namespace gearshift::lessons
