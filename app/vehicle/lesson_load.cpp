#include "app/vehicle/lesson_load.h"

#include <string_view>
#include <utility>

namespace gearshift::vehicle {
namespace {

constexpr std::string_view kGuided = "guided ";

}  // namespace

std::unique_ptr<haptics::LeverLoad> make_lesson_load(const std::string& parameters, const haptics::Gate& gate) {
  if (!std::string_view(parameters).starts_with(kGuided)) return make_car_load(parameters, gate);
  std::unique_ptr<CarLoad> car = make_car_load(parameters.substr(kGuided.size()), gate);
  if (!car) return nullptr;
  return std::make_unique<LessonLoad>(std::move(car), gate);
}

}  // namespace gearshift::vehicle
