#include "app/demo/filmed_drive.h"

#include <stdexcept>
#include <utility>

#include "app/assets_path.h"
#include "app/vehicle/car_world.h"

namespace gearshift {
namespace {

constexpr const char* kUsualCar = "hatchback";

bool fits(const CarSpec& car, const Gate& gate) {
  try {
    check_car_fits(car, gate);
    return true;
  } catch (const std::invalid_argument&) {
    return false;
  }
}

}  // namespace

FilmedDrive film_drive(LessonDriveConfig config) {
  FilmedDrive drive;
  drive.lesson = config.lesson;
  std::vector<HapticEvent> events;
  config.hear = [&](const HapticEvent& event) { events.push_back(event); };
  config.watch = [&](const DriveSample& now) {
    const double time = static_cast<double>(drive.film.size()) * kWatchPeriod;
    if (now.time() >= time) drive.film.push_back({time, now.lever, std::exchange(events, {}), now.car});
  };
  drive.result = drive_lesson(config);
  return drive;
}

std::optional<CarSpec> fitting_car(const Gate& gate) {
  std::vector<std::string> names = shipped_names("cars");
  names.insert(names.begin(), kUsualCar);
  for (const std::string& name : names) {
    CarSpec car = read_car(find_asset("cars", name));
    if (fits(car, gate)) return car;
  }
  return std::nullopt;
}

}  // namespace gearshift
