// What lies behind the lever in a lesson: the car and, over it, the teacher's hand.
#pragma once

#include <memory>
#include <string>

#include "app/training/guided_world.h"
#include "app/training/lesson.h"
#include "app/vehicle/car_world.h"
#include "haptics/gate/gate.h"
#include "haptics/loop/lever_world.h"

namespace gearshift {

class LessonWorld final : public LeverWorld {
 public:
  LessonWorld(std::unique_ptr<CarWorld> car, const Gate& gate) : car_(std::move(car)), guided_(*car_, gate) {}

  LeverOutput step(const LeverInput& in, double period) noexcept override { return guided_.step(in, period); }
  const char* name() const noexcept override { return guided_.name(); }
  const CarWorld& car() const noexcept { return *car_; }

 private:
  std::unique_ptr<CarWorld> car_;
  GuidedWorld guided_;
};

// The car as the lesson begins.
CarStart car_start(const LessonStart& start) noexcept;

// For replay(): the world of that name, a LessonWorld, a bare car, or nothing where it names neither. Throws FileError
// where the car in it is refused, std::invalid_argument where it does not fit the gate.
std::unique_ptr<LeverWorld> make_lesson_world(const std::string& name, const Gate& gate);

}  // namespace gearshift
