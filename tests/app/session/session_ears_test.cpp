// The sound of a session on a virtual clock, rendered to memory.
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
  choice.hand = "grip";  // with this hand, only the test moves the pedals
  choice.clock = RuntimeClock::virtual_time;
  choice.sound = SoundOutput::memory;
  return choice;
}

struct EarLevels {
  double left = 0.0, right = 0.0;  // [1] RMS of the samples
};

// The RMS level at each ear over one second, with the engine at idle.
EarLevels engine_levels(Session& session, const EyePose& ears) {
  std::vector<float> stereo;
  for (int i = 0; i < 70; ++i) {
    session.advance(kFrame);
    session.update_cabin(ears);
    const std::vector<float> some = listen(session.sound(), kFrame);
    if (i >= 10) stereo.insert(stereo.end(), some.begin(), some.end());
  }
  return {rms(channel(stereo, Ear::left)), rms(channel(stereo, Ear::right))};
}

}  // namespace

TEST_CASE("the session's sound depends on the position and direction of the listener's ears") {
  Session session(held_still());
  DriverControls controls;
  controls.ignition = true;
  controls.pedals.clutch = 1.0;
  session.lever().set_driver({}, controls);
  const glm::dvec3 seat{0.0, 0.65, 0.05};
  const EarLevels ahead = engine_levels(session, look_at(seat, seat + glm::dvec3(0.0, 0.0, -1.0)));
  CHECK(ahead.right > 1e-3);
  CHECK(ahead.right > ahead.left);  // the engine's sound comes from the driver's right
  const EarLevels back = engine_levels(session, look_at(seat, seat + glm::dvec3(0.0, 0.0, 1.0)));
  CHECK(back.left > back.right);
  // From 20 m behind the seat, the engine is 13 times as far away as from the seat, i.e. 22 dB quieter. The test
  // requires 15 dB.
  const glm::dvec3 behind{0.0, 0.65, 20.0};
  const EarLevels far = engine_levels(session, look_at(behind, behind + glm::dvec3(0.0, 0.0, -1.0)));
  CHECK(decibels(ahead.right / far.right) > 15.0);
}
