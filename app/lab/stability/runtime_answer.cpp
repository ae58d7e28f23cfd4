#include "app/lab/stability/runtime_answer.h"

#include <algorithm>
#include <stdexcept>

namespace gearshift::lab {
namespace {

constexpr double kMaxWallStiffness = haptics::parameter_of(&haptics::HapticTuning::wall_stiffness).range.max;  // [N/m]
constexpr double kMaxWallDamping = haptics::parameter_of(&haptics::HapticTuning::wall_damping).range.max;  // [N s/m]

haptics::HapticConfig config_of(const StabilityQuestion& question) {
  haptics::HapticConfig config;
  config.rate = question.rate;
  config.tuning.wall_stiffness = std::min(question.wall.stiffness, kMaxWallStiffness);
  config.tuning.wall_damping = std::min(question.wall.damping, kMaxWallDamping);
  config.contact.hold = question.wall.hold;
  config.estimator.window = question.wall.window;
  return config;
}

haptics::DeviceSpec device_of(const StabilityQuestion& question) {
  haptics::DeviceSpec device;
  device.axis_x = device.axis_y = question.handle;
  device.delay = question.wall.delay;
  device.position_step = question.encoder_step;
  device.simulated = true;
  return device;
}

}  // namespace

RuntimeAnswer query_runtime(const StabilityQuestion& question) {
  const haptics::HapticConfig config = config_of(question);
  RuntimeAnswer answer{{}, config.tuning.wall_stiffness, config.tuning.wall_damping, {}};
  try {
    haptics::check_config(config);
    answer.admitted = haptics::admit_tuning(config, device_of(question), 0.0);
  } catch (const std::invalid_argument& refused) {
    answer.problem = refused.what();
  }
  return answer;
}

}  // namespace gearshift::lab
