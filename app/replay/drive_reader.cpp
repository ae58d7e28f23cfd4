#include "app/replay/drive_reader.h"

#include <utility>

#include "app/training/lesson_world.h"

namespace gearshift {
namespace {

const CarWorld* car_in(const LeverWorld* world) noexcept {
  if (const auto* lesson = dynamic_cast<const LessonWorld*>(world)) return &lesson->car();
  return dynamic_cast<const CarWorld*>(world);
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

DriveReader::DriveReader(const std::filesystem::path& file)
    : reader_(file, TornTrace::salvage),
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

bool DriveReader::next(DriveSample& sample) {
  TraceSample recorded;
  do {
    if (!reader_.next(recorded)) return false;
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
