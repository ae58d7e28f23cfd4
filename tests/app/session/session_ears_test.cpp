// The sound of a session, on the virtual clock and rendered to memory.
#include <vector>

#include <doctest/doctest.h>

#include "app/session/session.h"
#include "tests/engine/sound/measure.h"

using namespace gearshift::engine;
using namespace gearshift::haptics;
using namespace gearshift::runtime;
using namespace gearshift::session;
using namespace gearshift::test;

namespace {

constexpr double kFrame = 1.0 / 60.0;

SessionChoice held_still() {
  SessionChoice choice;
  choice.hand = "grip";  // a hand whose pedals only we move
  choice.clock = RuntimeClock::virtual_time;
  choice.sound = SoundOutput::memory;
  return choice;
}

struct Heard {
  double left = 0.0, right = 0.0;  // [1] RMS
};

// One second of the idling engine, heard from that pose.
Heard engine_heard(Session& session, const EyePose& ears) {
  session.set_ears(ears);
  std::vector<float> stereo;
  for (int i = 0; i < 70; ++i) {
    session.advance(kFrame);
    session.update_cabin();
    const std::vector<float> some = listen(session.sound(), kFrame);
    if (i >= 10) stereo.insert(stereo.end(), some.begin(), some.end());
  }
  return {rms(channel(stereo, Ear::left)), rms(channel(stereo, Ear::right))};
}

}  // namespace

TEST_CASE("the session's sound depends on the position and direction of the given ears") {
  Session session(held_still());
  DriverControls controls;
  controls.ignition = true;
  controls.clutch = 1.0;
  session.set_driver({}, controls);
  const glm::dvec3 seat{0.0, 0.65, 0.05};
  const Heard ahead = engine_heard(session, look_at(seat, seat + glm::dvec3(0.0, 0.0, -1.0)));
  CHECK(ahead.right > 1e-3);
  CHECK(ahead.right > ahead.left);  // the car's middle is to the right of the driver
  const Heard back = engine_heard(session, look_at(seat, seat + glm::dvec3(0.0, 0.0, 1.0)));
  CHECK(back.left > back.right);
  // The engine is ahead; from 20 m behind the seat it is more than ten times as far away.
  const glm::dvec3 behind{0.0, 0.65, 20.0};
  const Heard far = engine_heard(session, look_at(behind, behind + glm::dvec3(0.0, 0.0, -1.0)));
  CHECK(decibels(ahead.right / far.right) > 15.0);
}
