// A lesson step's condition determines what the simulated driver does.
#include "app/lessons/simulated_driver/lesson_intent.h"

#include <doctest/doctest.h>

using namespace gearshift::lessons;

namespace {

LessonIntent intent_for(const DriveCondition& until, const DriveCondition& next = {}) {
  Lesson lesson;
  lesson.steps.resize(2);
  lesson.steps[0].until = until;
  lesson.steps[1].until = next;
  return intent_of(lesson, 0);
}

}  // namespace

TEST_CASE("a condition's speeds, revs and pedals determine how the driver controls the car") {
  DriveCondition c;
  c.clutch_above = 0.8;
  CHECK(intent_for(c).motion == Motion::stay);
  CHECK(intent_for(c).clutch_down);
  c.speed_above = -0.1, c.speed_below = 0.1;
  CHECK(intent_for(c).motion == Motion::stop);
  CHECK_FALSE(intent_for(c).clutch_down);

  DriveCondition creep;
  creep.speed_above = 0.3, creep.speed_below = 2.0;
  CHECK(intent_for(creep).motion == Motion::creep);
  CHECK(intent_for(creep).speed > 0.3);
  CHECK(intent_for(creep).speed < 2.0);

  DriveCondition slow;
  slow.speed_below = 10.0;
  CHECK(intent_for(slow).motion == Motion::slow);

  DriveCondition faster;
  faster.gear = 2;
  faster.engine_above = 230.0;
  CHECK(intent_for(faster).motion == Motion::go);
  CHECK(intent_for(faster).accelerates);
  faster.clutch_locked = true;
  CHECK(intent_for(faster).blip);
  CHECK_FALSE(intent_for(faster).accelerates);

  DriveCondition held;
  held.clutch_torque_above = 45.0;
  held.hand_brake_above = 0.5;
  CHECK(intent_for(held).motion == Motion::bite);
}

TEST_CASE("the clutch is pressed for a shift if the next step asks for a gear, and otherwise not") {
  DriveCondition down, gear, stop;
  down.clutch_above = 0.8;
  gear.gear = 3;
  CHECK(intent_for(down, gear).next_gear == 3);
  CHECK_FALSE(intent_for(gear, gear).next_gear);
  stop.clutch_above = 0.8;
  stop.speed_above = -0.1, stop.speed_below = 0.1;
  CHECK_FALSE(intent_for(stop, gear).next_gear);
}
