// The keyboard's pedals move on the car's clock, so their path does not depend on the frame rate.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <set>
#include <thread>
#include <vector>

#include <doctest/doctest.h>

#include "app/session/session.h"
#include "tests/support/temp_folder.h"
#include "tests/support/variable.h"

using namespace gearshift::engine;
using namespace gearshift::haptics;
using namespace gearshift::runtime;
using namespace gearshift::session;
using namespace gearshift::test;
using namespace gearshift::ui;
using namespace gearshift::vehicle;

namespace {

constexpr double kCycle = 1e-3;                 // [s]
constexpr double kClosed = 0.15, kBite = 0.75;  // [1] clutch pedal positions of the hatchback, from its file
constexpr double kSlip = 1.0, kPedal = 0.25;    // [s] time from bite to closed; time for the full travel

struct FeetRig {
  TempFolder folder;
  Variable config{"XDG_CONFIG_HOME", folder.path().c_str()};
  Variable data{"XDG_DATA_HOME", folder.path().c_str()};

  SessionChoice choice(RuntimeClock clock, const std::string& lesson) const {
    SessionChoice choice;
    choice.lesson = lesson;
    choice.hand = "grip";
    choice.clock = clock;
    choice.sound = SoundOutput::none;
    choice.pedal_timing = {kPedal, kSlip};
    return choice;
  }
};

// [1] The expected clutch position at `time` [s], if the key is pressed at 0 s and released at 0.5 s. Computed from the
// constants above.
double clutch_at(double time) {
  if (time <= 0.5) return std::min(1.0, time / kPedal);
  const double quick = (1.0 - kBite) * kPedal, left = time - 0.5 - quick;
  if (left < 0.0) return 1.0 - (time - 0.5) / kPedal;
  if (left < kSlip) return kBite - (kBite - kClosed) * left / kSlip;
  return std::max(0.0, kClosed - (left - kSlip) / kPedal);
}

// [1] The clutch position that the car received in each cycle. The keys are read once per frame.
std::vector<double> clutch_driven(Session& session, double frames_per_second) {
  std::vector<double> path;
  const double frame = 1.0 / frames_per_second;
  session.lever().set_driver({}, {}, {});  // ignition off: the foot waits only for an engine that is pulled down
  session.lever().send_controls({});
  session.runtime().advance(3.0);
  (void)session.runtime().read_frame();
  for (int i = 0; i * frame < 2.0; ++i) {
    session.lever().set_driver({}, {}, {.clutch = i * frame < 0.5 - 1e-9});
    session.lever().send_controls({});
    session.runtime().advance(frame);
    for (const DriveSample& cycle : session.runtime().read_frame().cycles) path.push_back(cycle.controls.pedals.clutch);
  }
  return path;
}

}  // namespace

TEST_CASE("at 10, 30 and 144 frames per second a keyboard pedal follows the same path within three cycles") {
  for (const double rate : {10.0, 30.0, 144.0}) {
    CAPTURE(rate);
    const FeetRig rig;
    Session session(rig.choice(RuntimeClock::virtual_time, "none"));
    const std::vector<double> path = clutch_driven(session, rate);
    CHECK(path.size() >= 2000);
    for (std::size_t i = 0; i < path.size(); ++i)
      REQUIRE(std::abs(path[i] - clutch_at(static_cast<double>(i) * kCycle)) <= 3.0 * kCycle / kPedal);
  }
}

TEST_CASE("a pedal keeps its position when the lever is replaced, and a pad's pedal counts if it is pressed further") {
  const FeetRig rig;
  Session session(rig.choice(RuntimeClock::virtual_time, "none"));
  session.lever().set_driver({}, {}, {.clutch = true});
  session.advance(0.5);
  CHECK(session.car().pedals.clutch == 1.0);
  session.apply(ChooseCar{"diesel"});
  session.advance(2.0 * kCycle);
  CHECK(session.car().pedals.clutch == 1.0);
  DriverControls pad;
  pad.pedals.brake = 0.7;
  session.lever().set_driver({}, pad, {.brake = true});
  session.advance(0.1);
  CHECK(session.car().pedals.brake == 0.7);
  session.advance(0.4);
  CHECK(session.car().pedals.brake == 1.0);
}

TEST_CASE("on the real clock a pedal moves even while no frame is drawn") {
  const FeetRig rig;
  SessionChoice choice = rig.choice(RuntimeClock::real_time, "none");
  Session session(choice);
  session.lever().set_driver({}, {}, {.brake = true});
  session.advance(0.0);
  std::set<double> brakes;
  std::this_thread::sleep_for(std::chrono::milliseconds(400));  // no frame is drawn in this time
  for (const DriveSample& cycle : session.runtime().read_frame().cycles) brakes.insert(cycle.controls.pedals.brake);
  CHECK(brakes.size() > 20);  // if the pedal moved once per frame, there would be one or two positions
  CHECK(*brakes.rbegin() == 1.0);
}

TEST_CASE("on the real clock a keyboard clutch keeps its pace through a change of gate, while both levers run") {
  constexpr double kSlowly = 8.0;  // [s] time from bite to closed
  const FeetRig rig;
  SessionChoice choice = rig.choice(RuntimeClock::real_time, "none");
  choice.pedal_timing.slip_time = kSlowly;
  Session session(choice);
  session.lever().set_driver({}, {}, {.clutch = true});
  session.advance(0.0);
  while (session.car().pedals.clutch < 1.0) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
    session.advance(0.0);
  }
  session.lever().set_driver({}, {}, {});
  while (session.car().pedals.clutch >= kBite) session.advance(0.0);
  using Steady = std::chrono::steady_clock;
  double passed = 0.0, went = 0.0;  // [s] elapsed; [1] pedal travel
  for (const char* gate : {"dog_leg_five", "five_speed_r_right_down", "dog_leg_five"}) {
    const Steady::time_point begin = Steady::now();
    session.advance(0.0);
    const double before = session.car().pedals.clutch;
    session.apply(ChooseGate{gate});
    session.advance(0.0);
    went += before - session.car().pedals.clutch;
    passed += std::chrono::duration<double>(Steady::now() - begin).count();
  }
  CHECK(went > 0.0);
  CHECK(went <=
        (passed + 0.03) * (kBite - kClosed) / kSlowly);  // + 0.03 s, because a snapshot may be several cycles old
}
