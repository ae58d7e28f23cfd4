// The load on the lever during a lesson: the car, plus the guidance force.
#pragma once

#include <memory>
#include <string>

#include "app/vehicle/car_load.h"
#include "app/vehicle/guided_load.h"
#include "haptics/gate/gate.h"
#include "haptics/loop/lever_load.h"

namespace gearshift::vehicle {

class LessonLoad final : public haptics::LeverLoad {
 public:
  LessonLoad(std::unique_ptr<CarLoad> car, const haptics::Gate& gate) : car_(std::move(car)), guided_(*car_, gate) {}

  haptics::LeverOutput step(const haptics::LeverInput& in, double period) noexcept override {
    return guided_.step(in, period);
  }
  const char* replay_parameters() const noexcept override { return guided_.replay_parameters(); }
  const CarLoad& car() const noexcept { return *car_; }

 private:
  std::unique_ptr<CarLoad> car_;
  GuidedLoad guided_;
};

// For replay(): rebuilds the load that replay_parameters() describes, a LessonLoad or a CarLoad; returns null if the
// text describes neither. Throws FileError if the car file in the text is rejected, std::invalid_argument if the car
// does not fit the gate.
std::unique_ptr<haptics::LeverLoad> make_lesson_load(const std::string& parameters, const haptics::Gate& gate);

}  // namespace gearshift::vehicle
