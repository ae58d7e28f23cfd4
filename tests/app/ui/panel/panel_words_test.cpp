// The panel's texts and lamps for the loop, the warnings and a preset.
#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "app/ui/panel/palette.h"
#include "tests/app/ui/panel/drawn.h"
#include "tests/app/ui/panel/panel_rig.h"

using namespace gearshift;
using namespace gearshift::haptics;
using namespace gearshift::lessons;
using namespace gearshift::test;
using namespace gearshift::ui;

namespace {

void run_and_draw(PanelRig& rig) {
  for (int i = 0; i < 4; ++i) rig.frame();
}

// The names of the warning lamps that are lit if these flags are set.
std::set<std::string> lit(PanelRig& rig, std::uint32_t flags) {
  rig.input.now.flags = flags;
  run_and_draw(rig);
  std::set<std::string> names;
  const std::vector<DrawnText> texts = drawn_texts();
  for (const char* name : {"Over-push", "Saturated", "Past wall", "Softened", "Grinding", "Over-rev"}) {
    const DrawnText& text = the_text(texts, name);
    if (text.colour == ui::ink::kBad || text.colour == ui::ink::kWarn) names.insert(name);
  }
  return names;
}

}  // namespace

TEST_CASE("each warning lamp is lit by its own flag only") {
  PanelRig rig;
  using Names = std::set<std::string>;
  CHECK(lit(rig, 0).empty());
  CHECK(lit(rig, kFlagOverPush) == Names{"Over-push"});
  CHECK(lit(rig, kFlagSaturated) == Names{"Saturated"});
  CHECK(lit(rig, kFlagGhost) == Names{"Past wall"});
  CHECK(lit(rig, kFlagContact | kFlagPushEstimated | kFlagFresh).empty());
  rig.input.now.wall_stiffness = 0.5 * rig.input.admitted.tuning.wall_stiffness;
  CHECK(lit(rig, kFlagContact) == Names{"Softened"});
  rig.input.now.wall_stiffness = 0.0;
  rig.input.car.grinding = true;
  CHECK(lit(rig, 0) == Names{"Grinding"});
  rig.input.car = {};
  rig.input.car.over_revved = true;
  CHECK(lit(rig, 0) == Names{"Over-rev"});
}

TEST_CASE("for a stalled engine the engine speed is replaced by a red text") {
  PanelRig rig;
  rig.input.car.engine_speed = 240.0;
  run_and_draw(rig);
  CHECK(is_drawn("2292 rpm"));
  CHECK_FALSE(is_drawn("stalled"));
  rig.input.car.stalled = true;
  run_and_draw(rig);
  CHECK(the_text(drawn_texts(), "stalled").colour == ui::ink::kBad);
  CHECK_FALSE(is_drawn("2292 rpm"));
}

TEST_CASE("the shift light points up or down if it advises a higher or lower gear, and is dark otherwise") {
  PanelRig rig;
  const auto arrow = [&](int advice) {
    rig.input.car.shift_advice = advice;
    run_and_draw(rig);
    std::vector<glm::dvec2> corners = drawn_in(advice < 0 ? ui::ink::kWarn : ui::ink::kGood);
    std::erase_if(corners, [&](glm::dvec2 at) { return at.y < rig.panel.cabin_area().max.y || at.x > 100.0; });
    return corners;
  };
  CHECK(arrow(0).empty());
  const auto width_at = [](const std::vector<glm::dvec2>& corners, double y) {
    double low = 1e9, high = -1e9;
    for (const glm::dvec2 at : corners) {
      if (std::abs(at.y - y) > 1.0) continue;
      low = std::min(low, at.x);
      high = std::max(high, at.x);
    }
    return high - low;
  };
  for (const int advice : {1, -1}) {
    const std::vector<glm::dvec2> corners = arrow(advice);
    const PixelBox box = box_of(corners);
    const double head = width_at(corners, advice > 0 ? box.min.y : box.max.y);
    const double stem = width_at(corners, advice > 0 ? box.max.y : box.min.y);
    CHECK(head < 1.0);  // the arrow's tip
    CHECK(stem > 3.0);
    CHECK(box.max.x - box.min.x > 2.0 * stem);
  }
}

TEST_CASE("the over-push lamp is a red disc left of its name, and contact does not light it") {
  PanelRig rig;
  const auto red_discs = [&](std::uint32_t flags) {
    lit(rig, flags);
    const PixelBox name = the_text(drawn_texts(), "Over-push").box;
    std::size_t corners = 0;
    for (const glm::dvec2 at : drawn_in(ui::ink::kBad))
      corners += at.x < name.min.x && at.x > name.min.x - 20.0 && at.y > name.min.y - 8.0 && at.y < name.max.y + 8.0;
    return corners;
  };
  CHECK(red_discs(kFlagOverPush) > 8);
  CHECK(red_discs(kFlagContact) == 0);
}

TEST_CASE("handbrake and ignition have lamps, and a slope is shown in per cent") {
  PanelRig rig;
  run_and_draw(rig);
  const auto colour = [](const char* name) { return the_text(drawn_texts(), name).colour; };
  CHECK(colour("Ignition") == ui::ink::kGood);
  CHECK(colour("Handbrake") != ui::ink::kBad);
  for (const DrawnText& text : drawn_texts()) CHECK_FALSE(text.text.starts_with("Slope"));
  rig.input.car.ignition = false;
  rig.input.car.pedals.hand_brake = 1.0;
  rig.input.car.slope = -std::atan(0.08);
  run_and_draw(rig);
  CHECK(colour("Ignition") != ui::ink::kGood);
  CHECK(colour("Handbrake") == ui::ink::kBad);
  CHECK(is_drawn("Slope -8 %"));
}

TEST_CASE("the forces sent and wanted are shown correctly, and no zero has a minus sign") {
  PanelRig rig;
  rig.input.now.f_a = {-12.0, 3.0};
  rig.input.now.commanded = {-20.0, 0.0};
  rig.input.now.wall_force = {-31.7, 0.0};
  rig.input.now.f_j = {0.0, -0.01};
  rig.input.car.road_speed = -0.01;
  run_and_draw(rig);
  CHECK(is_drawn("sent 12.0 N"));
  CHECK(is_drawn("wanted 31.7 N"));
  CHECK(is_drawn("0 km/h"));
  for (const DrawnText& text : drawn_texts()) {
    CHECK(text.text.find("-0.0") == std::string::npos);
    CHECK_FALSE(text.text.starts_with("-0km/h"));
  }
}

TEST_CASE("the frame time is shown only if frames are counted") {
  PanelRig rig;
  rig.screen.width = 2600.0f;  // [px] wide enough for the whole status line
  const auto shows_frame_time = [&] {
    run_and_draw(rig);
    const std::vector<DrawnText> texts = drawn_texts();
    return std::any_of(texts.begin(), texts.end(),
                       [](const DrawnText& text) { return text.text.find("/frame") != std::string::npos; });
  };
  CHECK_FALSE(shows_frame_time());
  rig.input.frame_ms = 16.7;
  CHECK(shows_frame_time());
}

TEST_CASE("a lesson's own recording cannot be stopped with the button") {
  PanelRig rig;
  rig.input.recording = true;
  rig.input.coach.phase = LessonPhase::driving;
  run_and_draw(rig);
  CHECK(is_drawn("Recording lesson"));
  CHECK_FALSE(has<ToggleRecording>(rig.click("record")));
  rig.input.coach.phase = LessonPhase::none;
  run_and_draw(rig);
  CHECK(is_drawn("End recording"));
  CHECK(has<ToggleRecording>(rig.click("record")));
}

TEST_CASE("a path too long for its line is shortened in the middle") {
  PanelRig rig;
  rig.input.message =
      "recorded: /disk/somebody/with/a/long/name/.local/share/gearshift/recordings/reverse-20261121.trace";
  run_and_draw(rig);
  bool found = false;
  for (const DrawnText& text : drawn_texts()) {
    if (text.text.find("\u2026") == std::string::npos) continue;
    found = true;
    CAPTURE(text.text);
    CHECK(text.text.starts_with("/disk/"));
    CHECK(text.text.ends_with("reverse-20261121.trace"));
  }
  CHECK(found);
  CHECK(rig.panel.shortened_texts() == 0);
}

TEST_CASE("gates and cars are shown by readable names and requested by their file names") {
  PanelRig rig;
  run_and_draw(rig);
  CHECK(is_drawn("Hatchback"));
  rig.click("gate");
  CHECK(is_drawn("Dog-leg 5-speed"));
  CHECK(value(rig.click("gate: dog_leg_five"), &ChooseGate::name) == "dog_leg_five");
}

TEST_CASE("the loop's figures are next to their names") {
  PanelRig rig;
  rig.input.health.rate = 2000.0;
  rig.input.health.late_p50 = 11e-6;
  rig.input.health.late_p99 = 77e-6;
  rig.input.health.late_worst = 333e-6;
  rig.input.health.skipped = 5;
  rig.input.health.overruns = 2;
  rig.input.health.cycle_ns = 2500.0;
  rig.input.health.stage_ns = {101, 202, 303, 404, 505, 606, 707, 808};
  rig.input.now.wall_stiffness = 4321.0;
  rig.input.frame_ms = 16.7;
  rig.click("tab_loop");
  run_and_draw(rig);
  using Line = std::vector<std::string>;
  CHECK(right_of("Rate") == Line{without_blanks("2000 Hz, period 500 µs")});
  CHECK(right_of("Lateness median") == Line{"11µs"});
  CHECK(right_of("Lateness p99") == Line{"77µs"});
  CHECK(right_of("Lateness max") == Line{"333µs"});
  CHECK(right_of("Deadlines missed") == Line{"5"});
  CHECK(right_of("Cycle overruns") == Line{"2"});
  CHECK(right_of("Cycle") == Line{without_blanks("2.50 µs, 0.50 % of period")});
  CHECK(right_of("Frame") == Line{"16.7ms"});
  CHECK(right_of("Stiffness in use") == Line{"4321N/m"});
  const char* stages[] = {"read", "estimate", "proxy", "coupling", "feel", "load", "guard", "write"};
  for (int i = 0; i < 8; ++i) CHECK(right_of(stages[i]) == Line{std::to_string(101 * (i + 1)) + "ns"});
}

TEST_CASE("a preset is compared with the active values, not with the requested ones") {
  PanelRig rig(1);  // one cycle of delay limits the wall stiffness to less than the 20000 N/m requested here
  rig.input.haptics.tuning.wall_stiffness = 20000.0;
  rig.input.admitted = admit_tuning(rig.input.haptics, rig.device, paper_feel());
  const HapticTuning runs = rig.input.admitted.tuning;
  REQUIRE(runs.wall_stiffness < 20000.0);
  rig.click("tab_presets");
  rig.click("compare");
  rig.click("compare: paper");
  rig.input.compared.emplace();
  rig.input.compared->haptics = rig.input.haptics;
  rig.input.compared->haptics.tuning = runs;
  run_and_draw(rig);
  const auto counted = [] {
    for (const DrawnText& text : drawn_texts())
      if (text.text.ends_with("arethesame")) return text.text.substr(0, text.text.find("differ"));
    return std::string("nothing");
  };
  CHECK(counted() == "0settings");
  rig.input.compared->haptics.tuning.wall_stiffness = 1234.0;
  run_and_draw(rig);
  CHECK(counted() == "1setting");
  const std::string here = std::to_string(std::lround(runs.wall_stiffness)) + "N/m";
  CHECK(right_of("Wall stiffness") == std::vector<std::string>{here, "1234N/m"});
}
