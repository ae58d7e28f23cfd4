// Tests loading a recorded drive in the background: the lever keeps running, loading can be cancelled, and a rejected
// file is reported.
#include <chrono>
#include <filesystem>
#include <thread>

#include <doctest/doctest.h>

#include "app/session/session.h"
#include "tests/support/temp_folder.h"
#include "tests/support/variable.h"

using namespace gearshift::engine;
using namespace gearshift::runtime;
using namespace gearshift::session;
using namespace gearshift::test;
using namespace gearshift::ui;
namespace fs = std::filesystem;

namespace {

struct OpeningRig {
  TempFolder folder;
  Variable config{"XDG_CONFIG_HOME", folder.path().c_str()};
  Variable data{"XDG_DATA_HOME", folder.path().c_str()};

  Session session(RuntimeClock clock) const {
    SessionChoice choice;
    choice.lesson = "none";
    choice.hand = "grip";
    choice.clock = clock;
    choice.sound = SoundOutput::none;
    return Session(choice);
  }
  // Records a drive of `seconds` seconds on the virtual clock, which runs faster than real time.
  fs::path recorded(double seconds) const {
    fs::path file = folder / "long.trace";
    Session driven = session(RuntimeClock::virtual_time);
    driven.runtime().start_recording(file);
    for (double time = 0.0; time < seconds; time += 0.5) driven.runtime().advance(0.5);
    CHECK_FALSE(driven.runtime().stop_recording().has_value());
    return file;
  }
};

// Runs frames until loading has ended, and returns the number of frames.
int wait(Session& session) {
  int frames = 0;
  for (; frames < 6000 && !session.panel_input().opening.empty(); ++frames) {
    session.advance(0.01);
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return frames;
}

}  // namespace

TEST_CASE("a long recording is loaded while frames continue, with a message") {
  const OpeningRig rig;
  const fs::path file = rig.recorded(60.0);
  Session session = rig.session(RuntimeClock::real_time);
  const auto begin = std::chrono::steady_clock::now();
  session.apply(OpenShift{file.string(), 0.0});
  const double asked = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  CHECK(session.panel_input().opening == "long.trace");
  CHECK_FALSE(session.is_replaying());
  const int frames = wait(session);
  CHECK(session.is_replaying());
  CHECK(frames >= 2);
  CHECK(asked < 0.1);
  MESSAGE("60 s of a drive: requested in " << 1e3 * asked << " ms, loaded after " << frames << " frames of 10 ms");
}

TEST_CASE("loading can be cancelled, and a change of gate cancels it too") {
  const OpeningRig rig;
  const fs::path file = rig.recorded(60.0);
  Session session = rig.session(RuntimeClock::real_time);
  session.apply(OpenShift{file.string(), 0.0});
  session.apply(CloseReplay{});
  CHECK(session.panel_input().opening.empty());
  CHECK(session.message().empty());
  session.apply(OpenShift{file.string(), 0.0});
  session.apply(ChooseGate{"dog_leg_five"});
  CHECK(session.panel_input().opening.empty());
  session.advance(0.01);
  CHECK_FALSE(session.is_replaying());
}

TEST_CASE("a file that is no recording is reported in one sentence after it was read") {
  const OpeningRig rig;
  Session session = rig.session(RuntimeClock::real_time);
  session.apply(OpenShift{"nowhere.trace", 0.0});
  wait(session);
  CHECK_FALSE(session.is_replaying());
  CHECK(session.message().find("nowhere.trace") != std::string::npos);
  CHECK(session.message().find("opening") == std::string::npos);
}
