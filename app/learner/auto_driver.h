// Drives a trainer in a person's place: a simulated learner who follows the lesson by himself, sample by sample.
#pragma once

#include <cstdint>
#include <memory>

#include "app/learner/learner_skill.h"
#include "app/training/drive_sample.h"
#include "app/training/lesson.h"
#include "app/vehicle/car_spec.h"
#include "haptics/gate/gate.h"

namespace gearshift {

struct AutoDriverConfig {
  Lesson lesson;
  CarSpec car;
  Gate gate;
  LearnerSkill skill;
  LearnerFaults faults;
  std::uint64_t seed = 1;
  double period = 1e-3;  // [s] between samples
  bool again = false;    // when the lesson is over it is driven anew, from where the car is; else hand and feet rest
};

class AutoDriver {
 public:
  explicit AutoDriver(const AutoDriverConfig& config);  // throws std::invalid_argument: the gate lacks a gear
  ~AutoDriver();
  AutoDriver(AutoDriver&&) noexcept;

  DriverAction act(const DriveSample& sample);  // every cycle, in order. Allocates
  bool is_over() const noexcept;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

// A drive through every gear of the gate, up, down and back, to a stand: what a hand by itself does without a lesson.
Lesson tour_lesson(const CarSpec& car, const Gate& gate);

}  // namespace gearshift
