// Tests which changes the session reports to the panel as a new run. Uses the virtual clock.
#include <cstdint>
#include <functional>

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
  const auto changes = [&](const std::function<void(PanelRequests&)>& request, int frames = 30) {
    PanelRequests requests;
    request(requests);
    const std::uint64_t before = session.panel_input().run;
    session.apply(requests);
    for (int i = 0; i < frames; ++i) session.advance(1.0 / 60.0);
    return session.panel_input().run != before;
  };
  CHECK_FALSE(changes([](PanelRequests&) {}));
  CHECK_FALSE(changes([](PanelRequests& r) { r.tuning = HapticTuning{.wall_stiffness = 4000.0}; }));
  CHECK_FALSE(changes([](PanelRequests& r) { r.record = true; }));
  CHECK_FALSE(changes([](PanelRequests& r) { r.record = true; }));
  CHECK(changes([](PanelRequests& r) { r.replay = true; }, 1));
  CHECK_FALSE(changes([](PanelRequests&) {}, 60));  // the replay reaches its end after 0.5 s, i.e. 30 frames
  CHECK(changes([](PanelRequests& r) { r.playback.seek = 0.0; }, 1));
  CHECK(changes([](PanelRequests& r) { r.playback.close = true; }));
  CHECK(changes([](PanelRequests& r) { r.gate = "four_speed"; }));
  CHECK(changes([](PanelRequests& r) { r.preset = "measured"; }));
  CHECK(changes([](PanelRequests& r) { r.hand = "grip"; }));
  CHECK_FALSE(changes([](PanelRequests& r) { r.gate = "no_such_gate"; }));
}
