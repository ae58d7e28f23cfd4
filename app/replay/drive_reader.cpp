#include "app/replay/drive_reader.h"

#include <cmath>
#include <utility>

#include "app/training/lesson_world.h"
#include "haptics/files/file_error.h"
#include "haptics/loop/trace_fields.h"

namespace gearshift {
namespace {

const CarWorld* car_in(const LeverWorld* world) noexcept {
  if (const auto* lesson = dynamic_cast<const LessonWorld*>(world)) return &lesson->car();
  return dynamic_cast<const CarWorld*>(world);
}

constexpr double kLargest = 1e9;  // in any unit of a cycle: a picture of floats holds its square [engineering value]

// What a device has read may be anything; what the loop made of it and what a person did is a number.
template <class T>
bool can_be(const T& value) noexcept {
  if constexpr (std::is_same_v<T, double>) {
    return std::abs(value) <= kLargest;  // not of what is no number
  } else {
    bool all = true;
    if constexpr (!LeafField<T>)
      each_field(value, [&](const char*, const auto& member) { all = all && can_be(member); });
    return all;
  }
}

// What a recording says of the car by itself.
void take_recorded(const TraceSample& sample, VehicleState& car) noexcept {
  car.throttle = sample.controls.throttle;
  car.brake = sample.controls.brake;
  car.clutch = sample.controls.clutch;
  car.hand_brake = sample.controls.hand_brake;
  car.ignition = sample.controls.ignition;
  car.slope = sample.controls.slope;
  car.gear = sample.out.gear;
  car.road_speed = sample.out.road_speed;
}

}  // namespace

DriveReader::DriveReader(const std::filesystem::path& file, std::uint64_t most)
    : name_(file.string()),
      reader_(file, TornTrace::salvage),
      most_(most),
      replayer_(reader_.header(), file.string(),
                [this](const std::string& name, const Gate& gate) { return make_world(name, gate); }) {}

// The replayer owns the world; where it stands it stays.
std::unique_ptr<LeverWorld> DriveReader::make_world(const std::string& name, const Gate& gate) {
  gate_ = gate;
  if (std::unique_ptr<LeverWorld> nothing = make_null_world(name, gate)) return nothing;
  std::unique_ptr<LeverWorld> world = make_lesson_world(name, gate);
  car_ = car_in(world.get());
  return world;
}

void DriveReader::check(const TraceSample& sample) const {
  if (can_be(sample.out) && can_be(sample.controls)) return;
  throw FileError(name_, 0, "is damaged: cycle " + std::to_string(sample.out.cycle) + " holds a number that cannot be");
}

bool DriveReader::next(DriveSample& sample) {
  TraceSample recorded;
  do {
    if (taken_ == most_ || !reader_.next(recorded)) return false;
    ++taken_;
    check(recorded);
    if (!differs_) differs_ = !replayer_.step(recorded);
  } while (last_ns_ && recorded.out.time_ns <= *last_ns_);
  last_ns_ = recorded.out.time_ns;
  if (car_ && !differs_)
    state_ = car_->state();
  else
    take_recorded(recorded, state_);
  sample.lever = recorded.out;
  sample.car = state_;
  sample.controls = recorded.controls;
  return true;
}

}  // namespace gearshift
