#include "haptics/joystick/force_sensor.h"

#include <algorithm>
#include <cmath>

namespace gearshift::haptics {

double sensor_reading(const ForceSensorModel& sensor, double force, double noise_gw) noexcept {
  double gw = force / kNewtonPerGramWeight + noise_gw;
  if (sensor.resolution_gw > 0.0) gw = std::round(gw / sensor.resolution_gw) * sensor.resolution_gw;
  return sensor.offset + sensor.gain * std::clamp(gw, -sensor.range_gw, sensor.range_gw);
}

double force_from_reading(const ForceSensorModel& sensor, double reading) noexcept {
  return (reading - sensor.offset) / sensor.gain * kNewtonPerGramWeight;
}

}  // namespace gearshift::haptics
