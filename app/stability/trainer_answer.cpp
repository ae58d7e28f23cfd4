#include "app/stability/trainer_answer.h"

#include <algorithm>
#include <stdexcept>

#include "haptics/gate/plain_aisle.h"

namespace gearshift {
namespace {

constexpr double kMostStiffness = 20000.0;  // [N/m] and
constexpr double kMostDamping = 100.0;      // [N s/m]: check_tuning() admits no more

HapticConfig config_of(const StabilityQuestion& question) {
  HapticConfig config;
  config.rate = question.rate;
  config.tuning.wall_stiffness = std::min(question.wall.stiffness, kMostStiffness);
  config.tuning.wall_damping = std::min(question.wall.damping, kMostDamping);
  config.contact.hold = question.wall.hold;
  config.estimator.window = question.wall.window;
  return config;
}

DeviceSpec device_of(const StabilityQuestion& question) {
  DeviceSpec device;
  device.axis_x = device.axis_y = question.handle;
  device.delay = question.wall.delay;
  device.simulated = true;
  return device;
}

}  // namespace

TrainerAnswer ask_trainer(const StabilityQuestion& question) {
  const HapticConfig config = config_of(question);
  TrainerAnswer answer{{}, config.tuning.wall_stiffness, config.tuning.wall_damping, {}};
  try {
    check_config(config);
    answer.admitted = admit_tuning(config, device_of(question), plain_aisle(1.0, 1.0));
  } catch (const std::invalid_argument& refused) {
    answer.problem = refused.what();
  }
  return answer;
}

}  // namespace gearshift
