// A recorded drive is read beside the frames: the lever goes on, it may be given up, and what is refused is told.
#include <chrono>
#include <filesystem>
#include <thread>

#include <doctest/doctest.h>

#include "app/train/session.h"
#include "tests/support/temp_folder.h"
#include "tests/support/variable.h"

using namespace gearshift;
namespace fs = std::filesystem;

namespace {

struct OpeningRig {
  TempFolder folder;
  Variable config{"XDG_CONFIG_HOME", folder.path().c_str()};
  Variable data{"XDG_DATA_HOME", folder.path().c_str()};

  Session session(TrainerClock clock) const {
    SessionChoice choice;
    choice.lesson = "none";
    choice.hand = "grip";
    choice.clock = clock;
    choice.sound = SoundOutput::none;
    return Session(choice);
  }
  // So long a drive, recorded in no time.
  fs::path recorded(double seconds) const {
    fs::path file = folder / "long.trace";
    Session driven = session(TrainerClock::virtual_time);
    driven.trainer().start_recording(file);
    for (double time = 0.0; time < seconds; time += 0.5) driven.trainer().advance(0.5);
    CHECK_FALSE(driven.trainer().stop_recording().has_value());
    return file;
  }
};

void ask(Session& session, const ReplayRequests& look) {
  PanelRequests requests;
  requests.look = look;
  session.obey(requests);
}

ReplayRequests open(const fs::path& file) {
  ReplayRequests look;
  look.open = ReplayRequests::Shift{file.string(), 0.0};
  return look;
}

// Frames until nothing is read any more; how many.
int wait(Session& session) {
  int frames = 0;
  for (; frames < 6000 && !session.panel_input().opening.empty(); ++frames) {
    session.advance(0.01);
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return frames;
}

}  // namespace

TEST_CASE("a long recording is opened while frames go on, and is said to be opened") {
  const OpeningRig rig;
  const fs::path file = rig.recorded(60.0);
  Session session = rig.session(TrainerClock::real_time);
  const auto begin = std::chrono::steady_clock::now();
  ask(session, open(file));
  const double asked = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  CHECK(session.panel_input().opening == "long.trace");
  CHECK_FALSE(session.replays());
  const int frames = wait(session);
  CHECK(session.replays());
  CHECK(frames >= 2);
  CHECK(asked < 0.1);
  MESSAGE("60 s of a drive: asked for in " << 1e3 * asked << " ms, there after " << frames << " frames of 10 ms");
}

TEST_CASE("what is being opened can be given up, and another gate does so too") {
  const OpeningRig rig;
  const fs::path file = rig.recorded(60.0);
  Session session = rig.session(TrainerClock::real_time);
  ask(session, open(file));
  ReplayRequests close;
  close.close = true;
  ask(session, close);
  CHECK(session.panel_input().opening.empty());
  CHECK(session.message().empty());
  ask(session, open(file));
  PanelRequests other;
  other.gate = "dog_leg_five";
  session.obey(other);
  CHECK(session.panel_input().opening.empty());
  session.advance(0.01);
  CHECK_FALSE(session.replays());
}

TEST_CASE("a file that is no recording is told in one sentence when it has been looked into") {
  const OpeningRig rig;
  Session session = rig.session(TrainerClock::real_time);
  ask(session, open("nowhere.trace"));
  wait(session);
  CHECK_FALSE(session.replays());
  CHECK(session.message().find("nowhere.trace") != std::string::npos);
  CHECK(session.message().find("opening") == std::string::npos);
}
