// The panel's appearance at common screen sizes, drawn without a GPU.
#include <algorithm>
#include <string>
#include <string_view>

#include <doctest/doctest.h>

#include "app/ui/input/bindings.h"
#include "engine/ui/ui_style.h"
#include "tests/app/ui/panel/panel_pictures.h"

using namespace gearshift::engine;
using namespace gearshift::haptics;
using namespace gearshift::test;
using namespace gearshift::ui;

namespace {

// Sets the input of a lever that is pushed through a wall while the loop is late, so that the panel shows all its
// warnings at once.
void make_busy(PanelRig& rig) {
  rig.input.history = toured(rig.gate, 6.0);
  rig.input.now = rig.input.history.back();
  rig.input.now.lever += glm::dvec2(0.004, 0.006);
  rig.input.now.f_h = {12.0, 18.0};
  rig.input.now.f_a = -rig.input.now.f_h;
  rig.input.now.gear = 5;
  rig.input.now.wall_stiffness = 3800.0;
  rig.input.now.commanded = {-12.5, -17.0};
  rig.input.now.flags |= kFlagOverPush | kFlagSaturated;
  rig.input.now.guard = GuardState::released;
  rig.input.now.fault = GuardFault::limit_broken;
  rig.input.health.late_p99 = 120e-6;
  rig.input.health.stage_ns = {40, 25, 60, 45, 30, 5, 20, 15};
  rig.input.health.cycle_ns = 240;
  rig.input.car.engine_speed = 230.0;
  rig.input.car.road_speed = 13.4;
  rig.input.car.pedals.clutch = 0.7;
  rig.input.car.pedals.throttle = 0.3;
  rig.input.car.shift_advice = 1;
  rig.input.car.grinding = true;
  rig.input.events = {{EventKind::gear_engaged, 1200, 1'200'000'000, 1.0},
                      {EventKind::wall_contact, 2310, 2'310'000'000, 0.31},
                      {EventKind::gear_left, 2900, 2'900'000'000, 1.0},
                      {EventKind::over_push_begin, 3100, 3'100'000'000, 63.0},
                      {EventKind::guard_changed, 3200, 3'200'000'000, 5.0}};
  rig.input.message = "assets/presets/heavy.toml:4: wall_stiffness_n_per_m = 70000: must be between 0 and 20000";
  rig.input.frame_ms = 16.7;
}

// Whether nothing is drawn between the panel's two columns, above the status bar.
bool middle_is_free(const Screen& screen) {
  const ImDrawData& data = *ImGui::GetDrawData();
  const float low = 0.27f * static_cast<float>(screen.width), high = 0.73f * static_cast<float>(screen.width);
  for (int l = 0; l < data.CmdListsCount; ++l) {
    for (const ImDrawVert& v : data.CmdLists[l]->VtxBuffer)
      if (v.pos.x > low && v.pos.x < high && v.pos.y < 0.85f * static_cast<float>(screen.height)) return false;
  }
  return true;
}

}  // namespace

TEST_CASE("on every screen all texts fit, the middle is free and the controls are on the screen") {
  for (const Screen& screen : kScreens) {
    CAPTURE(screen.width);
    CAPTURE(screen.scale);
    PanelRig rig(1);
    show_on(rig, screen);
    make_busy(rig);
    rig.frame();
    rig.wait(10.0);  // waits until the long message over the cabin has disappeared
    rig.click("tab_tuning");
    show(rig, name_of(screen, "tuning"));
    CHECK(rig.panel.shortened_texts() == 0);
    CHECK(middle_is_free(screen));
    for (const char* name : {"stop", "arm", "record", "replay", "gate", "reset_view", "undo", "reset", "slot_b",
                             "wall_stiffness_n_per_m", "limit_damping_n_s_per_m", "tab_presets"}) {
      const ControlRect r = rig.rect(name);
      CHECK(r.min.x >= 0.0);
      CHECK(r.min.y >= 0.0);
      CHECK(r.max.x <= screen.width);
      CHECK(r.max.y <= screen.height);
    }
    for (const char* tab : {"tab_setup", "tab_loop", "tab_presets"}) {
      rig.click(tab);
      if (std::string_view(tab) == "tab_presets") {
        rig.click("compare");
        rig.click("compare: paper");
        rig.input.compared = read_preset(GEARSHIFT_ASSETS "/presets/paper.toml");
      }
      show(rig, name_of(screen, tab));
      CHECK(rig.panel.shortened_texts() == 0);
    }
  }
}

TEST_CASE("an unsafe value is marked red on its slider") {
  PanelRig rig(1);
  make_busy(rig);
  rig.click("tab_tuning");
  const auto red_pixels = [&] {
    const Image picture = picture_of(rig);
    const ControlRect r = rig.rect("wall_stiffness_n_per_m");
    int red = 0;
    for (int y = static_cast<int>(r.min.y); y < static_cast<int>(r.max.y); ++y) {
      for (int x = static_cast<int>(r.min.x); x < static_cast<int>(r.max.x); ++x) {
        const std::uint8_t* p = picture.pixel(x, y);
        red += p[0] > 160 && p[1] < 110 && p[2] < 110;
      }
    }
    return red;
  };
  CHECK(red_pixels() == 0);
  rig.drag("wall_stiffness_n_per_m", 0.25, 0.9);
  CHECK(red_pixels() > 50);
  show(rig, "refused.png");
}

TEST_CASE("the help for the shipped bindings has two columns: keys and actions") {
  // Counts bright pixels to the right of the screen's centre, where only the help's second column (the actions) has
  // text.
  const auto bright_pixels = [](const std::string& help, const std::string& name) {
    PanelRig rig;
    rig.panel.show_help(true, help);
    show(rig, name);
    const Image picture = picture_of(rig);
    int bright = 0;
    for (int y = picture.height / 4; y < picture.height / 2; ++y) {
      for (int x = picture.width / 2; x < picture.width / 2 + 100; ++x) {
        const std::uint8_t* p = picture.pixel(x, y);
        bright += p[0] > 160 && p[1] > 160 && p[2] > 160;
      }
    }
    return bright;
  };
  std::string help = help_text(read_bindings(GEARSHIFT_ASSETS "/bindings/default.toml"), {});
  CHECK(bright_pixels(help, "help.png") > 300);
  std::replace(help.begin(), help.end(), '\t', ' ');
  CHECK(bright_pixels(help, "help_without_tabs.png") == 0);
}
