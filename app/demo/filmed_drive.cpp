#include "app/demo/filmed_drive.h"

#include <stdexcept>
#include <utility>

#include "app/base/assets_path.h"
#include "app/vehicle/car_load.h"

namespace gearshift::demo {
namespace {

constexpr const char* kDefaultCar = "hatchback";

bool fits(const vehicle::CarSpec& car, const haptics::Gate& gate) {
  try {
    vehicle::check_car_fits(car, gate);
    return true;
  } catch (const std::invalid_argument&) {
    return false;
  }
}

}  // namespace

FilmedDrive film_drive(lessons::LessonDriveConfig config) {
  FilmedDrive drive;
  drive.lesson = config.lesson;
  std::vector<haptics::HapticEvent> events;
  config.on_event = [&](const haptics::HapticEvent& event) { events.push_back(event); };
  config.on_cycle = [&](const vehicle::DriveSample& now) {
    const double time = static_cast<double>(drive.film.size()) * lab::kWatchPeriod;
    if (now.time() >= time) drive.film.push_back({time, now.lever, std::exchange(events, {}), now.car});
  };
  drive.result = lessons::drive_lesson(config);
  return drive;
}

std::optional<vehicle::CarSpec> fitting_car(const haptics::Gate& gate) {
  std::vector<std::string> names = base::shipped_names("cars");
  names.insert(names.begin(), kDefaultCar);
  for (const std::string& name : names) {
    vehicle::CarSpec car = vehicle::read_car(base::find_asset("cars", name));
    if (fits(car, gate)) return car;
  }
  return std::nullopt;
}

}  // namespace gearshift::demo
