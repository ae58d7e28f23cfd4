#include "app/training/lesson_world.h"

#include <string_view>
#include <utility>

namespace gearshift {
namespace {

constexpr std::string_view kGuided = "guided ";

}  // namespace

CarStart car_start(const LessonStart& start) noexcept {
  CarStart from;
  from.road_speed = start.speed;
  from.gear = start.gear;
  from.running = start.running;
  return from;
}

std::unique_ptr<LeverWorld> make_lesson_world(const std::string& name, const Gate& gate) {
  if (!std::string_view(name).starts_with(kGuided)) return make_car_world(name, gate);
  std::unique_ptr<CarWorld> car = make_car_world(name.substr(kGuided.size()), gate);
  if (!car) return nullptr;
  return std::make_unique<LessonWorld>(std::move(car), gate);
}

}  // namespace gearshift
