// Drives the trainer in place of a learner: a simulated driver that follows the lesson by itself, sample by sample.
#pragma once

#include <cstdint>
#include <memory>

#include "app/lessons/assessment/lesson.h"
#include "app/lessons/simulated_driver/driver_skill.h"
#include "app/vehicle/car_spec.h"
#include "app/vehicle/drive_sample.h"
#include "haptics/gate/gate.h"

namespace gearshift::lessons {

struct AutoDriverConfig {
  Lesson lesson;
  vehicle::CarSpec car;
  haptics::Gate gate;
  DriverSkill skill;
  DeliberateErrors errors;
  std::uint64_t seed = 1;
  double period = 1e-3;  // [s] between samples
  bool again = false;    // after the lesson, drive back to its start and repeat it; false: stop
};

class AutoDriver {
 public:
  explicit AutoDriver(const AutoDriverConfig& config);  // throws std::invalid_argument if the gate lacks a needed gear
  ~AutoDriver();
  AutoDriver(AutoDriver&&) noexcept;

  vehicle::DriverAction act(const vehicle::DriveSample& sample);  // call every cycle, in order; allocates memory
  bool is_over() const noexcept;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

// Default lesson of an automatic driver: a drive through every gear, up, down and back to a stop.
Lesson tour_lesson(const vehicle::CarSpec& car, const haptics::Gate& gate);

}  // namespace gearshift::lessons
