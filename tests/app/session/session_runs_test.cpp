// Tests which changes the session reports to the panel as a new run. Uses the virtual clock.
#include <cstdint>

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

TEST_CASE("a new lever and the start or end of a replay are new runs for the panel; tuning and recording are not") {
  const TempFolder folder;
  const Variable config{"XDG_CONFIG_HOME", folder.path().c_str()}, data{"XDG_DATA_HOME", folder.path().c_str()};
  SessionChoice choice;
  choice.hand = kAutomaticHand;
  choice.clock = RuntimeClock::virtual_time;
  choice.sound = SoundOutput::none;
  Session session(choice);
  const auto changes = [&](const PanelCommands& commands, int frames = 30) {
    const std::uint64_t before = session.panel_input().run;
    session.apply(commands);
    for (int i = 0; i < frames; ++i) session.advance(1.0 / 60.0);
    return session.panel_input().run != before;
  };
  CHECK_FALSE(changes({}));
  CHECK_FALSE(changes({ChangeTuning{HapticTuning{.wall_stiffness = 4000.0}}}));
  CHECK_FALSE(changes({ToggleRecording{}}));
  CHECK_FALSE(changes({ToggleRecording{}}));
  CHECK(changes({ReplayLastRecording{}}, 1));
  CHECK_FALSE(changes({}, 60));  // the replay reaches its end after 0.5 s, i.e. 30 frames
  CHECK(changes({SeekReplay{0.0}}, 1));
  CHECK(changes({CloseReplay{}}));
  CHECK(changes({ChooseGate{"four_speed"}}));
  CHECK(changes({ChoosePreset{"measured"}}));
  CHECK(changes({ChooseHand{"grip"}}));
  CHECK_FALSE(changes({ChooseGate{"no_such_gate"}}));
}
